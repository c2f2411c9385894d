// Light bodies, small steps: acceleration (M_d - m) g / (m + M_a) and passes that do not grow.
#include <gtest/gtest.h>

#include "coupling/accelerators/quasi_newton.hpp"
#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

namespace scenes = coupling::scenes;
using scenes::g;
using scenes::water;

constexpr std::array ratios{10.0, 1.0, 1.0 / 3, 0.1, 1e-2, 1e-3, 1e-6};
// A circle without friction has no rotational added mass, its polygon one of O(h^4): without mass it would spin on
// the coarse hull of these tests. Hence a finer one for a body of no mass.
constexpr double no_mass = 1e-9;

struct Release {
  double acceleration;
  int passes;
  double residual;  // the largest
};

Release release(double ratio, double dt, int steps = 1) {
  const auto scene = scenes::submerged_circle(ratio);
  const auto stepper = scenes::coupled(scene);
  int passes = 0;
  double residual = 0;
  for (int i = 0; i < steps; ++i) {
    const auto report = stepper->attempt(dt);
    EXPECT_TRUE(report.ok()) << report.cause;
    passes = std::max(passes, report.passes);
    residual = std::max(residual, report.residual);
    stepper->commit();
  }
  const double kicks = (steps - 0.5) * dt;
  return {stepper->bodies().state(0).velocity[1] / kicks, passes, residual};
}

// Water that the mesh's hull displaces.
double displaced() {
  const fluid::Fluid<2> f(scenes::submerged_circle(1).fluid, fluid::scenes::no_effects());
  double hull = 0;
  for (const auto& facet : f.mesh().boundary)
    if (facet.wall == 0) hull -= f.nodes().x[facet.nodes[0]].dot(fluid::area_vector_of<2>(facet, f.nodes().x)) / 2;
  return water * hull;
}

// From the acceleration of a body of a hundredth of water's density.
double added_mass(double dt) {
  const double m = scenes::submerged_circle(0.01).bodies[0].mass;
  return (displaced() - m) * g / release(0.01, dt).acceleration - m;
}

class Density : public testing::TestWithParam<double> {};

TEST_P(Density, first_acceleration_is_buoyancy_over_mass_and_added_mass) {
  // One added mass for all bodies. dt so short that only the mesh of t = 0 counts; what is left are the
  // truncated corrections of the pressure, in which the body takes part.
  const double dt = 1e-6, M_d = displaced();
  const double M_a = added_mass(dt);
  EXPECT_NEAR(M_a, water * std::numbers::pi * 0.25, 0.25 * M_a) << "near that of open water";
  const double m = GetParam() * water * scenes::submerged_circle(1).bodies[0].mass / water;
  const double expected = (M_d - m) * g / (m + M_a);
  const double band = GetParam() < 1e-3 ? 1e-2 : 1e-3;  // roundoff of the load over a vanishing mass
  EXPECT_NEAR(release(GetParam(), dt).acceleration, expected, band * g);
}

TEST_P(Density, passes_do_not_grow_as_the_step_shrinks) {
  for (double dt : {1e-3, 1e-3 / 4, 1e-3 / 16}) {
    const auto found = release(GetParam(), dt, 4);
    EXPECT_LE(found.passes, 2) << dt;
    EXPECT_LE(found.residual, 1e-10) << dt << ": fluid and body agree to roundoff";
  }
}

TEST_P(Density, acceleration_does_not_depend_on_the_step) {
  // First order at most in the distance moved, g dt^2 / h ~ 1e-4.
  const double reference = release(GetParam(), 1e-6).acceleration;
  for (double dt : {1e-3, 1e-3 / 4, 1e-3 / 16})
    EXPECT_NEAR(release(GetParam(), dt).acceleration, reference, 1e-3 * g) << dt;
}

// The wedge falls from just above the surface; passes stay bounded and V between 0 and its first value.
void drop_wedge(double ratio) {
  const auto stepper = scenes::coupled(scenes::wedge_drop(ratio * 36, 0.001, 0.02));
  const int passes = scenes::run(*stepper, 25);
  EXPECT_GE(passes, 1) << "a step was refused";
  EXPECT_LE(passes, 2);
  const double V = stepper->bodies().state(0).velocity[1];
  EXPECT_LE(V, 0.05 * 6.15);
  EXPECT_GE(V, -6.15 * 1.001);
}

TEST_P(Density, a_body_dropped_on_water_is_stopped_not_thrown) { drop_wedge(GetParam()); }

TEST(NoMass, dropped_on_water_is_stopped_not_thrown) { drop_wedge(no_mass); }

TEST(NoMass, released_under_water_rises_with_the_water_around_it) {
  const auto rise = [](double ratio) {
    const auto stepper = scenes::coupled(scenes::submerged_circle(ratio, 0.03));
    std::vector<double> velocity;
    for (int i = 0; i < 10; ++i) {
      EXPECT_TRUE(stepper->attempt(1e-3).ok());
      stepper->commit();
      velocity.push_back(stepper->bodies().state(0).velocity[1]);
    }
    return velocity;
  };
  // a = g (1 - s) / (s + Ca): from s = 0.01 to none it changes by (0.99 Ca) / (0.01 + Ca) for Ca near 0.95.
  const auto light = rise(0.01), none = rise(no_mass);
  const double Ca = 0.95, gain = (0.01 + Ca) / Ca / 0.99;
  for (std::size_t i = 0; i < none.size(); ++i) EXPECT_NEAR(none[i], gain * light[i], 0.02 * none[i]) << i;
}

INSTANTIATE_TEST_SUITE_P(Ratios, Density, testing::ValuesIn(ratios));

TEST(NoTerm, amplifies_an_error_by_added_mass_over_mass_a_pass) {
  const double dt = 1e-6, kick = dt / 2;
  fluid::Fluid<2> f(scenes::submerged_circle(1).fluid, fluid::scenes::gravity({0, -g}));
  ASSERT_TRUE(f.begin(kick, dt, {}).ok());
  const auto load = [&](double s) {
    std::vector<fluid::Twist<2>> walls(2, fluid::Twist<2>::Zero());
    walls[0][1] = s;
    EXPECT_TRUE(f.solve(walls).status.ok());
    return f.result().loads[0].total()[1];
  };
  const double M_a = -kick * (load(1) - load(0));
  EXPECT_NEAR(M_a, added_mass(dt), 1e-3 * M_a);
  // Hence G' = -M_a / m: divergence for all bodies lighter than their added mass, whatever dt.
  for (double ratio : {0.1, 1.0 / 3, 0.9}) {
    const auto none = scenes::coupled(scenes::submerged_circle(ratio), std::make_unique<coupling::NoTerm>());
    for (double step : {1e-3, 1e-5}) EXPECT_FALSE(none->attempt(step).ok()) << ratio << ' ' << step;
  }
  const auto heavy = scenes::coupled(scenes::submerged_circle(3), std::make_unique<coupling::NoTerm>());
  const auto report = heavy->attempt(1e-3);
  EXPECT_TRUE(report.ok()) << report.cause;
  // Passes from the amplification: (M_a / m)^k = 1e-8.
  const double m = 3 * scenes::submerged_circle(1).bodies[0].mass;
  EXPECT_NEAR(report.passes, std::log(1e-8) / std::log(M_a / m), 4);
}

TEST(NoTerm, amplifies_a_residual_by_added_mass_over_mass_a_pass) {
  const double dt = 1e-4, M_a = added_mass(1e-6);
  for (double ratio : {1.0 / 3, 0.1}) {
    const auto residual_after = [&](int passes) {
      const auto stepper = scenes::coupled(scenes::submerged_circle(ratio), std::make_unique<coupling::NoTerm>(),
                                           std::make_unique<coupling::ConstantRelaxation>(1.0),
                                           {.tolerance = 1e-14, .max_passes = passes});
      return stepper->attempt(dt).residual;
    };
    const double m = ratio * scenes::submerged_circle(1).bodies[0].mass;
    EXPECT_NEAR(residual_after(4) / residual_after(3), M_a / m, 0.1 * M_a / m) << ratio;
  }
}

std::unique_ptr<coupling::Accelerator> accelerator(const std::string& name) {
  if (name == "aitken") return std::make_unique<coupling::Aitken>(0.1);
  if (name == "anderson") return std::make_unique<coupling::Anderson>(1.0);
  if (name == "broyden") return std::make_unique<coupling::Broyden>(1.0);
  if (name == "probe") return std::make_unique<coupling::Probe>(1.0);
  return std::make_unique<coupling::IqnIls>(1.0);
}

template <class Term>
std::pair<coupling::StepReport, fluid::Twist<2>> first_step(double ratio, double dt, const std::string& name,
                                                            double tolerance = 1e-6) {
  const auto stepper = scenes::coupled(scenes::submerged_circle(ratio), std::make_unique<Term>(), accelerator(name),
                                       {.tolerance = tolerance, .max_passes = 200});
  const auto report = stepper->attempt(dt);
  EXPECT_TRUE(report.ok()) << name << ' ' << ratio << ": " << report.cause;
  return {report, stepper->trial()[0].velocity};
}

TEST(Accelerators, make_plain_exchange_converge_to_one_state_for_light_bodies) {
  // Three freedoms: n + 2 = 5 passes on an affine map for the secant schemes, and one or two for its curvature.
  for (double ratio : {1.0 / 3, 0.1}) {
    const auto reference = first_step<coupling::NoTerm>(ratio, 1e-3, "iqn_ils", 1e-10).second;
    for (const char* name : {"aitken", "anderson", "broyden", "iqn_ils"}) {
      const auto [report, velocity] = first_step<coupling::NoTerm>(ratio, 1e-3, name);
      EXPECT_LE(report.passes, name == std::string("aitken") ? 30 : 7) << name << ' ' << ratio;
      EXPECT_LE((velocity - reference).norm(), 1e-5 * reference.norm()) << name << ' ' << ratio;
    }
  }
}

template <class Term>
void converges_where_plain_exchange_diverges() {
  // Three freedoms and six pieces: n + 2 = 11 passes on an affine map, whatever mass, mesh and step; the curvature
  // takes some more. Broyden's method ends within 2 n + 1.
  for (double ratio : {1.0 / 3, 0.1, 0.01})
    for (double dt : {1e-3, 1e-3 / 4, 1e-3 / 16}) {
      for (const char* name : {"anderson", "iqn_ils"})
        EXPECT_LE(first_step<Term>(ratio, dt, name).first.passes, 11 + 4) << ratio << ' ' << dt;
      const auto broyden = first_step<Term>(ratio, dt, "broyden").first;
      EXPECT_TRUE(broyden.ok()) << ratio << ' ' << dt;  // 2 n + 1 = 19 on an affine map; curvature has no bound
    }
}

TEST(LaplacianTerm, converges_where_plain_exchange_diverges) {
  converges_where_plain_exchange_diverges<coupling::LaplacianTerm>();
}

TEST(RobinTerm, converges_where_plain_exchange_diverges) {
  converges_where_plain_exchange_diverges<coupling::RobinTerm>();
}

TEST(RobinTerm, needs_no_relaxation_for_a_light_body_that_slams) {
  // 2 K + A > S on a hull between contact lines, for any mass: convergence, slower for lighter bodies (docs/design-notes).
  const auto most_passes = [](double ratio, std::unique_ptr<coupling::InterfaceTerm> term, int steps = 25) {
    const auto stepper =
        scenes::coupled(scenes::wedge_drop(ratio * 36, 0.001, 0.02), std::move(term),
                        std::make_unique<coupling::ConstantRelaxation>(1.0), {.tolerance = 1e-6, .max_passes = 500});
    return scenes::run(*stepper, steps);
  };
  for (double ratio : {1.0 / 3, 0.1, 0.01}) {
    EXPECT_GT(most_passes(ratio, std::make_unique<coupling::RobinTerm>()), 1) << ratio << ": a step was refused";
    // It diverges as soon as the wetted width, and with it M_a, has grown beyond m.
    EXPECT_EQ(most_passes(ratio, std::make_unique<coupling::NoTerm>(), 100), -1) << ratio;
  }
}

TEST(Probe, knows_what_other_schemes_have_to_learn) {
  // They take n + 2 passes on an affine map: 5 for three freedoms, 11 with six pieces more, and some for its
  // curvature. It has only the corrections of the pressure and the curvature to learn, at any mass.
  for (double ratio : {10.0, 1.0, 1.0 / 3, 0.1, 1e-2, 1e-3})
    for (double dt : {1e-3, 1e-3 / 16}) {
      // Roundoff of positions over dt, eps 3 m / dt, is 3e-8 of the speed g dt / 2; a pass amplifies it by M_a / m.
      if (ratio < 1e-2 && dt < 1e-3) continue;
      EXPECT_LE(first_step<coupling::NoTerm>(ratio, dt, "probe").first.passes, 5) << ratio << ' ' << dt;
      EXPECT_LE(first_step<coupling::LaplacianTerm>(ratio, dt, "probe").first.passes, 11) << ratio << ' ' << dt;
    }
}

TEST(Probe, after_two_passes_is_off_by_no_more_than_the_residual_it_reports) {
  // The pass has negative slopes -eta: the solution is r eta / (1 + eta) from the last image, hence nearer than r.
  // Relative to the speed of free flight; a coarse tolerance of the reference is a part of r.
  const double dt = 1e-3, free_flight = scenes::g * dt / 2;
  for (double ratio : {10.0, 1.0 / 3, 0.1}) {
    const auto reference = first_step<coupling::NoTerm>(ratio, dt, "iqn_ils", 1e-10).second;
    const auto stepper = scenes::coupled(scenes::submerged_circle(ratio), std::make_unique<coupling::NoTerm>(),
                                         accelerator("probe"), {.tolerance = 1e-14, .fixed_passes = 2});
    const auto report = stepper->attempt(dt);
    ASSERT_TRUE(report.ok()) << report.cause;
    EXPECT_EQ(report.passes, 2);
    EXPECT_GT(report.residual, 0);
    const fluid::Twist<2> off = stepper->trial()[0].velocity - reference;
    EXPECT_LE(off.head<2>().norm(), 1.01 * report.residual * free_flight) << ratio;
  }
}

TEST(LaplacianTerm, converges_with_aitken_too) {
  // One factor for all modes: slow where the Laplacian is stiff.
  for (double ratio : {1.0 / 3, 0.1})
    EXPECT_LE(first_step<coupling::LaplacianTerm>(ratio, 1e-3, "aitken", 1e-5).first.passes, 50) << ratio;
}

TEST(Aitken, makes_plain_exchange_converge_for_a_light_body) {
  for (double first : {0.3, 0.1, 0.02})
    for (double dt : {1e-3, 1e-3 / 16}) {
      const auto stepper = scenes::coupled(scenes::submerged_circle(0.1), std::make_unique<coupling::NoTerm>(),
                                           std::make_unique<coupling::Aitken>(first));
      const auto report = stepper->attempt(dt);
      EXPECT_TRUE(report.ok()) << report.cause;
      EXPECT_LE(report.passes, 30);
    }
}

}  // namespace
}  // namespace splashdown
