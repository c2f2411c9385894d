#include <gtest/gtest.h>

#include <complex>

#include "elastic/modes/modes.hpp"
#include "solids.hpp"

namespace splashdown::elastic::steps_test {
namespace {

using Make = std::function<std::unique_ptr<Scheme>(Dynamics)>;
struct Known {
  const char* name;
  Make make;
  int order;
};
const Known schemes[] = {
    {"generalised-alpha", [](Dynamics d) { return generalised_alpha(std::move(d), 0.8); }, 2},
    {"Newmark", [](Dynamics d) { return newmark(std::move(d)); }, 2},
    {"shifted Crank-Nicolson", [](Dynamics d) { return shifted_crank_nicolson(std::move(d), 0.1); }, 2},
    {"fractional-step theta", [](Dynamics d) { return fractional_step_theta(std::move(d)); }, 2},
    {"midpoint", [](Dynamics d) { return midpoint(std::move(d)); }, 2},
    {"implicit Euler", [](Dynamics d) { return implicit_euler(std::move(d)); }, 1},
};

double energy(const System& system, const SolidState& motion) {
  return system.strain_energy(motion.u) + 0.5 * motion.v.dot(system.mass() * motion.v);
}

SolidState moved(Scheme& scheme, SolidState motion, double end, int steps) {
  EXPECT_TRUE(scheme.accelerate(motion).ok());
  SolidState next;
  for (int k = 0; k < steps; ++k) {
    const auto status = scheme.step(motion, end / steps, next);
    EXPECT_TRUE(status.ok()) << status.cause;
    std::swap(motion, next);
  }
  return motion;
}

/// A short cantilever that a growing weight bends far.
struct Cantilever {
  Solid<2> solid{box_mesh<2>({4, 1}, {4, 1}), st_venant_kirchhoff<2>(soft), 1};
  Dynamics dynamics;
  Cantilever() {
    solid.clamp([](const Vec<2>& X) { return X.x() < 1e-9; });
    const Field weight = solid.mass() * solid.uniform({0, -0.002});
    dynamics = {.system = &solid, .load = [weight](double t) -> Field { return (1 + std::sin(t / 5)) * weight; }};
  }
};

TEST(Steps, schemes_have_their_orders) {
  const Cantilever bent;
  const double end = 20;
  const auto fine = moved(*fractional_step_theta(bent.dynamics), at_rest(bent.solid), end, 2560);
  for (const auto& scheme : schemes) {
    const auto error = [&](int steps) {
      return (moved(*scheme.make(bent.dynamics), at_rest(bent.solid), end, steps).u - fine.u).norm();
    };
    const int steps = scheme.order == 1 ? 640 : 320;
    const double order = std::log2(error(steps) / error(2 * steps));
    EXPECT_NEAR(order, scheme.order, 0.15) << scheme.name;
  }
}

/// One mode of a linear solid, from rest.
struct Mode {
  Solid<2> solid{box_mesh<2>({4, 1}, {4, 1}), small_strain<2>(soft), 1};
  SolidState start;
  double w = 0;
  Field shape;
  Mode() {
    solid.clamp([](const Vec<2>& X) { return X.x() < 1e-9; });
    const auto modes = lowest_modes(solid, 2, Field::Zero(solid.size()));
    w = modes.angular_frequencies[1];
    shape = modes.shapes.col(1);
    start = at_rest(solid);
    start.u = 1e-3 * shape;
  }
  Dynamics dynamics(Rayleigh damping = {}) const {
    return {.system = &solid, .damping = damping, .load = unloaded(solid)};
  }
  /// w u + i v of the mode.
  std::complex<double> amplitude(const SolidState& motion) const {
    const Field p = solid.mass() * shape;
    return {w * p.dot(motion.u), p.dot(motion.v)};
  }
};

TEST(Steps, thetas_amplify_a_mode_as_theory_says) {
  const Mode mode;
  using Complex = std::complex<double>;
  const double x = 0.7, theta = 1 - std::sqrt(0.5), weight = (1 - 2 * theta) / (1 - theta), dt = x / mode.w;
  const auto part = [x](double share, double end) {
    const Complex z(0, -share * x);  // d/dt (w u + i v) = -i w (w u + i v)
    return (1. + (1 - end) * z) / (1. - end * z);
  };
  const struct {
    Make make;
    Complex factor;
  } rows[] = {{schemes[5].make, part(1, 1)},
              {[](Dynamics d) { return shifted_crank_nicolson(std::move(d), 0.01); }, part(1, 0.5 + 0.01 * dt)},
              {schemes[3].make, part(theta, weight) * part(1 - 2 * theta, 1 - weight) * part(theta, weight)},
              {schemes[4].make, part(1, 0.5)}};
  for (const auto& [make, factor] : rows) {
    const int steps = 50;
    const auto end = moved(*make(mode.dynamics()), mode.start, steps * dt, steps);
    const Complex expected = mode.amplitude(mode.start) * std::pow(factor, steps);
    EXPECT_LT(std::abs(mode.amplitude(end) - expected), 1e-9 * std::abs(mode.amplitude(mode.start)));
  }
}

TEST(Steps, newmark_keeps_energy_over_10000_periods_and_is_late_as_theory_says) {
  const Mode mode;
  const double x = 2, dt = x / mode.w;
  const int steps = 40000;  // four a period: it takes 2 pi dt/(2 atan(w dt/2)) (Hughes 2000, section 9.2)
  const auto end = moved(*newmark(mode.dynamics()), mode.start, steps * dt, steps);
  EXPECT_NEAR(energy(mode.solid, end) / energy(mode.solid, mode.start), 1, 1e-8);
  const double phase = 2 * std::atan(x / 2) * steps;
  const auto turned = mode.amplitude(end) / mode.amplitude(mode.start);
  EXPECT_LT(std::abs(turned - std::polar(1., -phase)), 1e-5);  // the mode's w^2 is known to 1e-10
}

TEST(Steps, generalised_alpha_damps_what_is_fast_by_its_radius_and_no_more) {
  const Mode mode;
  for (const double radius : {0.5, 0.9}) {
    // Infinitely fast: all three roots are -radius, (E + radius)^3 a = 0 with the shift E to the next step.
    const double dt = 1e5 / mode.w;
    auto scheme = generalised_alpha(mode.dynamics(), radius);
    SolidState motion = mode.start, next;
    ASSERT_TRUE(scheme->accelerate(motion).ok());
    std::vector<double> a;
    for (int k = 0; k < 4; ++k) {
      a.push_back(motion.a.dot(mode.solid.mass() * mode.shape));
      ASSERT_TRUE(scheme->step(motion, dt, next).ok());
      std::swap(motion, next);
    }
    EXPECT_NEAR(a[3] + 3 * radius * a[2] + 3 * radius * radius * a[1] + std::pow(radius, 3) * a[0], 0,
                1e-6 * std::abs(a[0]));
    // Slow: energy is lost by (w dt)^3 only.
    const int steps = 100;
    const double x = 0.1;
    const auto end = moved(*generalised_alpha(mode.dynamics(), radius), mode.start, steps * x / mode.w, steps);
    const double left = energy(mode.solid, end) / energy(mode.solid, mode.start);
    EXPECT_LT(left, 1);
    EXPECT_GT(left, 1 - steps * x * x * x);
  }
}

TEST(Steps, rayleighs_damping_is_that_of_the_formula) {
  const Mode mode;
  const double ratio = 0.02;
  for (const Rayleigh damping : {Rayleigh{2 * ratio * mode.w, 0}, Rayleigh{0, 2 * ratio / mode.w}})
    for (const auto& scheme : schemes) {
      if (scheme.order < 2) continue;
      const int steps = 400;
      const double x = 0.05;
      const auto end = moved(*scheme.make(mode.dynamics(damping)), mode.start, steps * x / mode.w, steps);
      // |w u + i v| swings by the ratio within a period; schemes err by x^2 and the shift by 0.1 dt in place of x.
      const double left = std::abs(mode.amplitude(end)) / std::abs(mode.amplitude(mode.start));
      if (std::string(scheme.name) == "shifted Crank-Nicolson") continue;
      EXPECT_NEAR(std::log(left) / (-ratio * steps * x), 1, 0.06) << scheme.name;
    }
}

/// A beam that turns and flies, and vibrates as it is let go undeformed.
struct FreeBeam {
  Solid<2> solid{box_mesh<2>({6, 1}, {6, 1}), st_venant_kirchhoff<2>(soft), 1};
  SolidState start = at_rest(solid);
  FreeBeam() {
    for (int a = 0; a < solid.mesh().size(); ++a) {
      const Vec<2> r = solid.mesh().nodes.col(a) - Vec<2>(3, 0.5);
      start.v.segment<2>(2 * a) = Vec<2>(0.1, 0.05) + 0.04 * Vec<2>(-r.y(), r.x());
    }
  }
  Dynamics dynamics() const { return {.system = &solid, .load = unloaded(solid)}; }
};

TEST(Steps, free_flight_keeps_momentum_with_any_scheme) {
  const FreeBeam beam;
  const auto before = beam.solid.momenta(beam.start.u, beam.start.v);
  for (const auto& scheme : schemes) {
    const auto end = moved(*scheme.make(beam.dynamics()), beam.start, 100, 200);
    const auto after = beam.solid.momenta(end.u, end.v);
    EXPECT_LT((after.linear - before.linear).norm(), 1e-11 * before.linear.norm()) << scheme.name;
    const Vec<2> way = beam.solid.centre(end.u) - beam.solid.centre(beam.start.u);
    EXPECT_LT((way - 100 * Vec<2>(0.1, 0.05)).norm(), 1e-10) << scheme.name;
  }
}

/// Angular momentum about the centre: about the origin digits of the momentum's direction would be lost times the way flown.
double spin(const Solid<2>& solid, const SolidState& motion) {
  const auto momenta = solid.momenta(motion.u, motion.v);
  const Vec<2> x = solid.centre(motion.u);
  return momenta.angular[0] - (x.x() * momenta.linear.y() - x.y() * momenta.linear.x());
}

/// Largest relative change of the energy, and the change of angular momentum, over so many steps of the midpoint rule.
std::pair<double, double> changes_in_flight(int steps, double dt) {
  const FreeBeam beam;
  auto scheme = midpoint(beam.dynamics());
  SolidState motion = beam.start, next;
  const double energy_before = energy(beam.solid, motion);
  double worst = 0;
  for (int k = 0; k < steps; ++k) {
    const auto status = scheme->step(motion, dt, next);
    EXPECT_TRUE(status.ok()) << status.cause;
    std::swap(motion, next);
    worst = std::max(worst, std::abs(energy(beam.solid, motion) / energy_before - 1));
  }
  return {worst, std::abs(spin(beam.solid, motion) / spin(beam.solid, beam.start) - 1)};
}

TEST(Steps, midpoint_keeps_angular_momentum_and_bounds_the_energy_of_a_turning_beam) {
  const auto [energy_change, momentum_change] = changes_in_flight(3000, 0.5);  // ten turns
  EXPECT_LT(energy_change, 0.01) << "no drift: it swings with the strain energy, a few percent of the whole";
  EXPECT_LT(momentum_change, 1e-9);
}

TEST(StepsNightly, midpoint_keeps_them_over_10000_periods) {
  // The first bending takes 33 s in plane strain: 22.4 sqrt(E' I/(rho A L^4)).
  const auto [energy_change, momentum_change] = changes_in_flight(330000, 1);
  EXPECT_LT(energy_change, 0.02);
  EXPECT_LT(momentum_change, 1e-7);
}

TEST(Steps, a_solid_that_is_crushed_is_refused_with_a_cause) {
  Solid<2> solid(box_mesh<2>({1, 1}, {2, 2}), neo_hookean<2>(soft), 1);
  solid.clamp([](const Vec<2>& X) { return X.x() < 1e-9; });
  const Field crush = solid.traction([](const Vec<2>& X, const Vec<2>&) -> Vec<2> {
    return {X.x() > 0.99 ? -1e4 : 0., 1e3};
  });
  SolidState end;
  EXPECT_FALSE(implicit_euler({.system = &solid, .load = always(crush)})->step(at_rest(solid), 1, end).ok());
}

TEST(Steps, parameters_out_of_range_are_refused) {
  const Mode mode;
  EXPECT_THROW(generalised_alpha(mode.dynamics(), 1.1), std::invalid_argument);
  EXPECT_THROW(newmark(mode.dynamics(), 0.25, 0.4), std::invalid_argument);
  EXPECT_THROW(shifted_crank_nicolson(mode.dynamics(), -1), std::invalid_argument);
}

}  // namespace
}  // namespace splashdown::elastic::steps_test
