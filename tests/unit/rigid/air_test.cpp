// Loads of the air against closed solutions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/geometry.hpp"
#include "rigid/forces/aero/aero.hpp"
#include "rigid/forces/applied/applied.hpp"
#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::air_test {
namespace {

constexpr double g = 9.81, air = 1.225;

Curve<1> constant(double value) { return Curve<1>({{0, Eigen::Matrix<double, 1, 1>(value)}}); }
Curve<1> line(double slope) {
  return Curve<1>({{-1, Eigen::Matrix<double, 1, 1>(-slope)}, {1, Eigen::Matrix<double, 1, 1>(slope)}});
}

template <int d>
using Forces = std::vector<std::unique_ptr<Force<d>>>;

template <int d>
Forces<d> in_air(const AeroSpec<d>& spec, std::optional<Wind<d>> wind = {}, double pull_down = g) {
  Forces<d> forces = pull<d>(-pull_down * Vec<d>::Unit(d - 1));
  forces.push_back(std::make_unique<Aero<d>>(std::vector{spec}, wind));
  return forces;
}

/// Goes where forces push it and does not turn.
template <int d>
BodySpec<d> shot(double mass, const Vec<d>& velocity) {
  auto spec = free_body<d>(mass, Inertia<d>::Identity());
  std::fill(spec.free.begin() + d, spec.free.end(), false);
  spec.velocity.template head<d>() = velocity;
  return spec;
}

/// Speeds of t_n, which a fall that is given at t_{n-1/2} passes half a step later.
template <int d>
Vec<d> velocity_after_half(const Bodies<d>& bodies, const Vec<d>& before) {
  return 0.5 * (before + bodies.state(0).velocity.template head<d>());
}

template <int d>
Wrench<d> wrench(const Force<d>& force, const BodySpec<d>& spec, const BodyState<d>& state, double share = 0,
                 double time = 0) {
  std::vector<Wrench<d>> sums(1, Wrench<d>::Zero());
  const std::vector specs{spec};
  const std::vector states{state};
  const std::vector shares{share};
  force.add({.specs = specs, .states = states, .wetted_share = shares, .time = time}, sums);
  return sums[0];
}

}  // namespace

TEST(Air, a_fall_with_drag_is_the_logarithm_of_a_cosh_to_second_order) {
  const double k = 0.5 * air * 0.47 * 0.02 / 0.3;  // drag over mass and speed squared
  const double terminal = std::sqrt(g / k), end = 2.56;
  AeroSpec<2> spec{.area = 0.02};
  spec.drag = constant(0.47);
  std::vector<double> errors;
  for (const double dt : {0.04, 0.02, 0.01}) {
    auto bodies = alone<2>(shot<2>(0.3, {0, 0}), in_air(spec));
    run(bodies, static_cast<int>(std::lround(end / dt)), dt);
    const double fallen = terminal * terminal / g * std::log(std::cosh(g * end / terminal));
    errors.push_back(std::abs(-bodies.state(0).pose.translation().y() / fallen - 1));
  }
  EXPECT_LT(errors.back(), 1e-4);
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8);
  EXPECT_GT(std::log2(errors[1] / errors[2]), 1.8);
}

TEST(Air, a_body_falls_at_its_terminal_speed_in_the_end) {
  AeroSpec<3> spec{.area = 0.7};
  spec.drag = constant(1.2);
  auto bodies = alone<3>(shot<3>(80, {10, 3, 0}), in_air(spec));
  run(bodies, 6000, 1e-2);
  const double terminal = std::sqrt(2 * 80 * g / (air * 0.7 * 1.2));
  EXPECT_NEAR(bodies.state(0).velocity[2], -terminal, 1e-6 * terminal);
  EXPECT_NEAR(bodies.state(0).velocity.head<2>().norm(), 0, 1e-6 * terminal);
}

// Euler 1753: 1/v_x^2 + (k/g) F(tan angle) is constant, F(p) = p sqrt(1 + p^2) + asinh p.
TEST(Air, a_shot_with_drag_keeps_eulers_hodograph) {
  const double k = 0.02, dt = 1e-3;
  AeroSpec<2> spec{.density = 2 * k, .area = 1};
  spec.drag = constant(1);
  auto bodies = alone<2>(shot<2>(1, {25, 30}), in_air(spec));
  const auto kept = [&](const Vec<2>& v) {
    const double p = v.y() / v.x();
    return 1 / (v.x() * v.x()) + k / g * (p * std::sqrt(1 + p * p) + std::asinh(p));
  };
  const double at_first = kept({25, 30});
  const double scale = k / g * std::abs(25. / 30 * std::sqrt(1 + 25. / 30 * 25. / 30));
  for (int n = 0; n < 4000; ++n) {
    run(bodies, 1, dt, n == 0);
    if (n % 400 != 0) continue;
    EXPECT_NEAR(kept(bodies.state(0).velocity.head<2>()), at_first, 1e-3 * scale) << n * dt;
  }
  EXPECT_LT(bodies.state(0).velocity[1], -10) << "well beyond the apex";
}

// Lanchester 1908: with the lift of a constant angle and no drag, cos(angle) = z/(3 z_1) + C sqrt(z_1/z), z: what the speed falls
// from, z_1: that of level flight.
TEST(Air, a_phugoid_keeps_lanchesters_curve) {
  const double level = 20, dt = 1e-3;  // speed of level flight
  AeroSpec<2> spec{.area = 0.5};
  spec.lift = constant(2 * 1.5 * g / (air * 0.5 * level * level));
  for (const double speed : {15., 19., 30.}) {
    auto bodies = alone<2>(shot<2>(1.5, {speed, 0}), in_air(spec));
    const double z_1 = level * level / (2 * g), z_0 = speed * speed / (2 * g);
    const double C = (1 - z_0 / (3 * z_1)) * std::sqrt(z_0 / z_1);
    double worst = 0;
    for (int n = 0; n < 9000; ++n) {
      const Vec<2> before = bodies.state(0).velocity.head<2>();
      const double z = z_0 - bodies.state(0).pose.translation().y();
      run(bodies, 1, dt, n == 0);
      const Vec<2> v = velocity_after_half(bodies, before);
      worst = std::max({worst, std::abs(v.x() / v.norm() - z / (3 * z_1) - C * std::sqrt(z_1 / z)),
                        std::abs(v.squaredNorm() / (2 * g) / z - 1)});
    }
    EXPECT_LT(worst, 1e-3) << speed << " m/s, over a period and more";
  }
}

TEST(Air, a_small_phugoid_has_the_period_pi_sqrt_2_v_over_g) {
  const double level = 20, dt = 1e-3, period = std::numbers::pi * std::numbers::sqrt2 * level / g;
  AeroSpec<2> spec{.area = 0.5};
  spec.lift = constant(2 * 1.5 * g / (air * 0.5 * level * level));
  auto bodies = alone<2>(shot<2>(1.5, {level, 0.2}), in_air(spec));
  std::vector<double> upward;
  for (int n = 0; upward.size() < 2 && n < 30000; ++n) {
    const double before = bodies.state(0).velocity[1];
    run(bodies, 1, dt, n == 0);
    const double after = bodies.state(0).velocity[1];
    if (n > 10 && before < 0 && after >= 0) upward.push_back(n * dt - after / (after - before) * dt);
  }
  ASSERT_EQ(upward.size(), 2u);
  EXPECT_NEAR(upward[1] - upward[0], period, 1e-3 * period);
}

TEST(Air, a_glider_sinks_by_drag_over_lift) {
  AeroSpec<2> spec{.area = 0.5};
  const double lift = 0.8, drag = 0.1, mass = 1.5;
  spec.lift = constant(lift);
  spec.drag = constant(drag);
  auto bodies = alone<2>(shot<2>(mass, {14, 0}), in_air(spec));
  run(bodies, 200'000, 1e-3);
  const Vec<2> v = bodies.state(0).velocity.head<2>();
  EXPECT_NEAR(-v.y() / v.x(), drag / lift, 1e-5);
  EXPECT_NEAR(v.norm(), std::sqrt(2 * mass * g / (air * 0.5 * std::hypot(lift, drag))), 1e-4);
}

TEST(Air, a_stable_body_swings_into_the_wind_and_damping_slows_it) {
  const double speed = 12, inertia = 0.4, slope = -0.6, damping = -9, area = 0.3, length = 0.25, dt = 1e-3;
  AeroSpec<2> spec{.area = area, .length = length};
  spec.moment = line(slope);
  auto body = free_body<2>(1e6, Inertia<2>(inertia));  // heavy: it keeps its way
  body.velocity << speed, 0, 0;
  body.pose.linear() = splashdown::rotation(Rotation<2>(0.01));
  const double q = 0.5 * air * speed * speed,
               period = 2 * std::numbers::pi * std::sqrt(inertia / (-q * area * length * slope));
  auto swinging = alone<2>(body, in_air<2>(spec, {}, 0));
  run(swinging, static_cast<int>(std::lround(period / dt)), dt);
  EXPECT_NEAR(angle(swinging.state(0).pose), 0.01, 1e-3 * 0.01);
  spec.moment = {};
  spec.pitch_damping = damping;
  body.velocity[2] = 0.3;
  auto turning = alone<2>(body, in_air<2>(spec, {}, 0));
  const double rate = -damping * q * area * length * length / (2 * speed) / inertia;
  run(turning, 2000, dt);
  // The last velocity belongs to half a step before the end.
  EXPECT_NEAR(turning.state(0).velocity[2], 0.3 * std::exp(-rate * (2000 - 0.5) * dt), 1e-4 * 0.3);
}

TEST(Air, loads_turn_with_the_scene_and_shrink_with_the_wetted_share) {
  std::mt19937 random(7);
  std::normal_distribution<double> draw;
  const auto vector = [&] { return Vec<3>(draw(random), draw(random), draw(random)); };
  for (int n = 0; n < 50; ++n) {
    AeroSpec<3> spec{.area = 0.4, .length = 0.2, .span = 1.1, .point = 0.1 * vector()};
    spec.drag = constant(0.1), spec.lift = line(4), spec.moment = line(-0.5), spec.side = line(-0.3);
    spec.roll = line(-0.1), spec.yaw = line(0.2), spec.sideslip_drag = constant(0.03);
    spec.roll_damping = -0.4, spec.pitch_damping = -9, spec.yaw_damping = -0.2;
    const auto body = free_body<3>(1, Inertia<3>::Identity());
    BodyState<3> state{Isometry<3>::Identity(), Twist<3>::Zero()};
    state.pose.linear() = splashdown::rotation(Rotation<3>(vector()));
    state.velocity << 10 * vector(), vector();
    Wind<3> wind{.velocity = 3 * vector()}, turned_wind = wind;
    const Aero<3> force({spec}, wind);
    const Wrench<3> here = wrench(force, body, state);
    const Eigen::Matrix3d turn = splashdown::rotation(Rotation<3>(vector()));
    BodyState<3> turned = state;
    turned.pose.linear() = turn * state.pose.linear();
    turned.velocity << turn * state.velocity.head<3>(), turn * state.velocity.tail<3>();
    turned_wind.velocity = turn * wind.velocity;
    Wrench<3> expected;
    expected << turn * here.head<3>(), turn * here.tail<3>();
    EXPECT_LE((wrench(Aero<3>({spec}, turned_wind), body, turned) - expected).norm(), 1e-12 * here.norm());
    BodyState<3> carried = state;  // in air at rest
    carried.velocity.head<3>() -= wind.velocity;
    EXPECT_LE((wrench(Aero<3>({spec}, {}), body, carried) - here).norm(), 1e-12 * here.norm());
    EXPECT_LE((wrench(force, body, state, 0.25) - 0.75 * here).norm(), 1e-12 * here.norm());
    EXPECT_EQ(wrench(force, body, state, 1.0), Wrench<3>::Zero());
  }
}

TEST(Air, signs_are_those_of_flight) {
  const auto body = free_body<3>(1, Inertia<3>::Identity());
  BodyState<3> state{Isometry<3>::Identity(), Twist<3>::Zero()};
  AeroSpec<3> spec{.area = 1};
  spec.lift = line(5);
  state.velocity[0] = 10, state.velocity[2] = -1;  // comes from above: the angle of attack is positive
  EXPECT_GT(wrench(Aero<3>({spec}, {}), body, state)[2], 0);
  spec.lift = {};
  spec.moment = line(-1);
  EXPECT_GT(wrench(Aero<3>({spec}, {}), body, state)[4], 0) << "nose down, about y, which is to the left";
  spec.moment = {};
  state.velocity << 10, -1, 0, 0, 0, 0;  // slips to the right
  spec.side = line(-1);
  EXPECT_GT(wrench(Aero<3>({spec}, {}), body, state)[1], 0) << "pushed to the left";
  spec.side = {};
  spec.yaw = line(1);
  EXPECT_LT(wrench(Aero<3>({spec}, {}), body, state)[5], 0) << "turns its nose to the right";
  spec.yaw = {};
  spec.roll = line(-1);
  EXPECT_LT(wrench(Aero<3>({spec}, {}), body, state)[3], 0) << "lifts the wing on the right";
}

TEST(Air, steps_that_it_allows_do_not_gain_energy) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> draw;
  for (int n = 0; n < 30; ++n) {
    AeroSpec<2> spec{.area = draw(random), .length = 0.1 + draw(random)};
    spec.drag = constant(2 * draw(random)), spec.moment = line(-draw(random)), spec.pitch_damping = -20 * draw(random);
    auto body = free_body<2>(0.01 + draw(random), Inertia<2>(0.001 + 0.1 * draw(random)));
    body.velocity << 40 * draw(random), 40 * draw(random), 5 * draw(random);
    auto bodies = alone<2>(body, in_air<2>(spec, {}, 0));
    const double speed = body.velocity.head<2>().norm();
    for (int k = 0; k < 300; ++k) {
      const double dt = std::min(bodies.stable_dt(), 1.0);
      run(bodies, 1, dt, false);
      ASSERT_LE(bodies.state(0).velocity.head<2>().norm(), speed * (1 + 1e-12));
    }
    EXPECT_LT(std::abs(bodies.state(0).velocity[2]), 1e3);
  }
}

TEST(Air, wind_has_the_profile_and_the_gust_that_it_is_given) {
  Wind<2> wind{.velocity = {8, 0},
               .roughness = 1e-3,
               .height = 10,
               .level = 2,
               .gust = {5, 1},
               .gust_start = 1,
               .gust_duration = 4};
  EXPECT_NEAR(wind.at({0, 12}, 0).x(), 8, 1e-12);
  EXPECT_NEAR(wind.at({0, 3}, 0).x(), 8 * std::log(1e3) / std::log(1e4), 1e-12);
  EXPECT_EQ(wind.at({0, 2}, 0).x(), 0);
  EXPECT_NEAR((wind.at({0, 12}, 3) - Vec<2>(13, 1)).norm(), 0, 1e-12) << "the peak, halfway";
  EXPECT_NEAR((wind.at({0, 12}, 2) - Vec<2>(10.5, 0.5)).norm(), 0, 1e-12);
  EXPECT_EQ(wind.at({0, 12}, 5.1), Vec<2>(8, 0));
}

TEST(AppliedForce, gives_its_impulse_along_the_axes_that_it_names) {
  AppliedForceSpec<2> spec;
  spec.force = Curve<2>({{0, {3, 0}}, {0.5, {3, 0}}, {1, {0, 0}}});
  auto body = free_body<2>(2, Inertia<2>(1));
  body.pose.linear() = splashdown::rotation(Rotation<2>(std::numbers::pi / 2));
  for (const bool turns : {false, true}) {
    spec.turns_with_body = turns;
    Forces<2> forces;
    forces.push_back(std::make_unique<AppliedForces<2>>(std::vector{spec}));
    auto bodies = alone<2>(body, std::move(forces));
    run(bodies, 2000, 1e-3);
    const Vec<2> v = bodies.state(0).velocity.head<2>();
    EXPECT_NEAR((v - (turns ? Vec<2>(0, 1.125) : Vec<2>(1.125, 0))).norm(), 0, 1e-6);
  }
}

TEST(AppliedForce, at_a_point_turns_the_body_about_its_centre) {
  AppliedForceSpec<3> spec{.point = {0, 2, 0}};
  spec.force = Curve<3>({{0, {5, 0, 0}}});
  spec.moment = Curve<3>({{0, {0, 0, 4}}});
  const AppliedForces<3> force({spec});
  const BodyState<3> state{Isometry<3>::Identity(), Twist<3>::Zero()};
  const Wrench<3> expected = (Wrench<3>() << 5, 0, 0, 0, 0, -6).finished();
  EXPECT_EQ(wrench<3>(force, free_body<3>(1, Inertia<3>::Identity()), state), expected);
}

}  // namespace splashdown::rigid::air_test
