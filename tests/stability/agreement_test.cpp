// All coupling schemes are one: the same bits twice, the same motion, and energy that neither side makes.
#include <gtest/gtest.h>

#include "coupling/accelerators/quasi_newton.hpp"
#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

namespace scenes = coupling::scenes;
using coupling::Coupled;

struct Scheme {
  const char* name;
  std::function<std::unique_ptr<coupling::scenes::Watched<2>>(const scenes::Scene&, coupling::CouplingLimits)> couple;
};
template <class Term, class Made, class... Arguments>
Scheme scheme(const char* name, Arguments... arguments) {
  return {name, [=](const scenes::Scene& scene, coupling::CouplingLimits limits) {
            return scenes::coupled(scene, std::make_unique<Term>(), std::make_unique<Made>(arguments...), limits);
          }};
}
using None = coupling::NoTerm;
using Laplacian = coupling::LaplacianTerm;
using Robin = coupling::RobinTerm;
const Scheme schemes[] = {{"rigid", [](const auto& scene, auto) { return scenes::coupled(scene); }},
                          scheme<Laplacian, coupling::IqnIls>("laplacian_iqn_ils", 1.0),
                          scheme<Laplacian, coupling::Anderson>("laplacian_anderson", 1.0),
                          scheme<Robin, coupling::IqnIls>("robin_iqn_ils", 1.0),
                          scheme<Robin, coupling::Anderson>("robin_anderson", 1.0),
                          scheme<None, coupling::Aitken>("none_aitken", 0.1),
                          scheme<None, coupling::Anderson>("none_anderson", 1.0),
                          scheme<None, coupling::Broyden>("none_broyden", 1.0),
                          scheme<None, coupling::IqnIls>("none_iqn_ils", 1.0),
                          scheme<None, coupling::Probe>("none_probe", 1.0),
                          scheme<Laplacian, coupling::Probe>("laplacian_probe", 1.0),
                          scheme<Robin, coupling::Probe>("robin_probe", 1.0)};

void PrintTo(const Scheme& s, std::ostream* out) { *out << s.name; }

// A body that moves, sinks and turns in water at rest. Few steps from one start, on one mesh but for a node here and
// there: longer runs part at the first decision of remeshing that roundoff turns.
constexpr int steps = 8;
constexpr double dt = 1e-3, tolerance = 1e-8;

std::unique_ptr<coupling::scenes::Watched<2>> released(const Scheme& s, double ratio, double h = 0.12,
                                                       const fluid::Twist<2>& velocity = fluid::Twist<2>::Zero()) {
  auto scene = scenes::submerged_circle(ratio, h);
  scene.set_velocity(0, velocity);
  return s.couple(scene, {.tolerance = tolerance});
}

/// Velocities after each step.
std::vector<fluid::Twist<2>> velocities(coupling::scenes::Watched<2>& stepper, int count = steps) {
  std::vector<fluid::Twist<2>> out;
  for (int i = 0; i < count; ++i) {
    const auto report = stepper.attempt(dt);
    EXPECT_TRUE(report.ok()) << report.cause;
    if (!report.ok()) break;
    stepper.commit();
    out.push_back(stepper.bodies().state(0).velocity);
  }
  return out;
}

class Agreement : public testing::TestWithParam<Scheme> {};
INSTANTIATE_TEST_SUITE_P(All, Agreement, testing::ValuesIn(schemes),
                         [](const auto& each) { return std::string(each.param.name); });

TEST_P(Agreement, an_attempt_made_twice_gives_the_same_bits) {
  const auto stepper = released(GetParam(), 1.0 / 3, 0.12, {0.3, -0.2, 1});
  velocities(*stepper, 2);
  const auto first = stepper->attempt(dt);
  const auto velocity = stepper->trial()[0].velocity;
  const auto load = stepper->fluid().result().loads[0].total();
  const auto p = stepper->fluid().result().pressure;
  const auto again = stepper->attempt(dt);
  EXPECT_EQ(again.passes, first.passes);
  EXPECT_EQ(again.residual, first.residual);
  EXPECT_EQ(stepper->trial()[0].velocity, velocity);
  EXPECT_EQ(stepper->fluid().result().loads[0].total(), load);
  EXPECT_EQ(stepper->fluid().result().pressure, p);
}

TEST_P(Agreement, work_of_the_fluid_is_the_energy_that_the_body_gains) {
  // Leapfrog: M (s_1 - s_0) = kick (f + f_g), times the mean of s_0 and s_1. The fluid books kick f . s with the mean s
  // of the wall velocities it used: what the two sides miss is kick f times the difference of the means, and no more.
  for (double ratio : {1.0 / 3, 0.1}) {
    const fluid::Twist<2> start(0.3, -0.2, 1);
    const auto stepper = released(GetParam(), ratio, 0.12, start);
    const auto& spec = stepper->bodies().spec(0);
    const Eigen::Vector3d M(spec.mass, spec.mass, spec.inertia(0, 0)), gravity(0, -scenes::g * spec.mass, 0);
    const double gyration = std::sqrt(M[2] / M[0]);
    fluid::Twist<2> used = start;  // by the fluid in the step before
    for (int i = 0; i < steps; ++i) {
      const double kick = i == 0 ? dt / 2 : dt, booked = stepper->fluid().ledger().work_on_walls;
      const fluid::Twist<2> before = stepper->bodies().state(0).velocity;
      ASSERT_TRUE(stepper->attempt(dt).ok());
      const fluid::Twist<2> after = stepper->trial()[0].velocity,
                            uses = stepper->fluid().result().wall_velocities[0].rigid;
      const auto f = stepper->fluid().result().loads[0].total();
      stepper->commit();
      const auto energy = [&](const fluid::Twist<2>& s) { return 0.5 * s.dot(M.cwiseProduct(s)); };
      const fluid::Twist<2> mean = 0.5 * (before + after);
      const double given = stepper->fluid().ledger().work_on_walls - booked;
      const double missed = given - (energy(after) - energy(before) - kick * gravity.dot(mean));
      const double roundoff = 100 * scenes::eps * std::max({energy(before), energy(after), std::abs(given)});
      EXPECT_NEAR(missed, kick * f.dot(0.5 * (used + uses) - mean), roundoff) << ratio << ' ' << i;
      // Both sides agree to the tolerance, relative to velocities that include rotations times the radius of gyration.
      const double force = std::hypot(f.head<2>().norm(), f[2] / gyration);
      const double speed = std::max(before.norm(), after.norm());
      EXPECT_LE(std::abs(missed), kick * force * tolerance * speed + roundoff) << ratio << ' ' << i;
      used = uses;
    }
  }
}

TEST(Accelerators, lead_to_one_motion) {
  // A step ends within tolerance / (1 - slope) of where its term's passes lead. Slopes of plain passes are negative,
  // those with a Laplacian below 6 mu / (1 + 6 mu), mu = M_a / m < 10 (docs/design-notes): eight steps of 60 * 1e-8.
  for (double ratio : {1.0 / 3, 0.1})
    for (const char* term : {"laplacian", "robin", "none"}) {
      std::vector<std::vector<fluid::Twist<2>>> found;
      for (const auto& s : schemes)
        if (std::string(s.name).starts_with(term)) found.push_back(velocities(*released(s, ratio)));
      for (const auto& each : found)
        for (std::size_t i = 0; i < each.size(); ++i)
          EXPECT_LE((each[i] - found[0][i]).norm(), 1e-5 * found[0][i].norm()) << term << ' ' << ratio << ' ' << i;
    }
}

TEST(InterfaceTerms, lead_to_one_motion_but_for_the_error_of_the_mesh) {
  // The corrections of the pressure are truncated, and what they leave depends on the term: a part of the error of the
  // mesh, gone with it, whatever the step. Below it lies what passes leave: 60 tolerances a step, as above.
  const auto rise = [](const Scheme& s, double h) -> Eigen::Vector2d {
    return velocities(*released(s, 0.1, h), 5).back().head<2>();
  };
  const auto& exact = schemes[0];
  const Eigen::Vector2d coarse = rise(exact, 0.12), middle = rise(exact, 0.06), fine = rise(exact, 0.03);
  for (const auto& s : {schemes[1], schemes[3], schemes[8]}) {
    const double at_coarse = (rise(s, 0.12) - coarse).norm(), at_middle = (rise(s, 0.06) - middle).norm();
    const double of_passes = 5 * 60 * tolerance * middle.norm();
    EXPECT_LE(at_coarse, (coarse - middle).norm()) << s.name;
    EXPECT_LE(at_middle, (middle - fine).norm()) << s.name;
    EXPECT_LE(at_middle, at_coarse / 4 + of_passes) << s.name << ": of second order";
  }
}

}  // namespace
}  // namespace splashdown
