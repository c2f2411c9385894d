#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rigid/forces/gravity.hpp"
#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::flight_test {

TEST(Flight, without_load_is_x_equals_v_t) {
  BodySpec<2> spec = planar_body();
  spec.velocity << 1.25, -0.4, 0;
  Bodies<2> bodies = alone(spec);
  const double dt = 1e-3;
  const int n = 10000;
  for (int i = 0; i < n; ++i) step(bodies, i == 0 ? dt / 2 : dt, dt);
  EXPECT_EQ(bodies.state(0).velocity, spec.velocity);
  // n additions to a sum of size x: each rounds by eps/2 of it at most.
  const Vec<2> x = bodies.state(0).pose.translation();
  EXPECT_NEAR(x.x(), 1.25 * n * dt, n * eps * 12.5);
  EXPECT_NEAR(x.y(), -0.4 * n * dt, n * eps * 4);
}

TEST(Flight, plane_spin_turns_by_w_t) {
  for (const double w : {1e-10, 1e-6, 0.9e-3, 1.1e-3, 0.3, 25., -7.}) {
    BodySpec<2> spec = planar_body();
    spec.velocity << 0, 0, w;
    Bodies<2> bodies = alone(spec);
    const double dt = 2e-3;
    const int n = 1000;
    for (int i = 0; i < n; ++i) step(bodies, dt, dt);
    EXPECT_EQ(bodies.state(0).velocity(2), w);
    // Quaternion product and back: a few eps a step, whatever w.
    EXPECT_NEAR(std::remainder(angle(bodies.state(0).pose) - w * n * dt, 2 * std::numbers::pi), 0, 8 * n * eps);
  }
}

TEST(Flight, spin_faster_than_a_quarter_turn_a_step_is_not_slowed) {
  for (const double turn : {0.77, 0.79, 1.6, 3.0, 40.}) {
    BodySpec<2> spec = planar_body();
    spec.velocity << 0, 0, turn / 0.1;
    Bodies<2> bodies = alone(spec);
    for (int i = 0; i < 5; ++i) step(bodies, 0.1, 0.1);
    EXPECT_EQ(bodies.state(0).velocity(2), turn / 0.1);
    EXPECT_NEAR(std::remainder(angle(bodies.state(0).pose) - 5 * turn, 2 * std::numbers::pi), 0, 1e-13);
  }
}

TEST(Flight, under_a_constant_force_is_a_parabola) {
  BodySpec<2> spec = planar_body();
  spec.velocity << 2, 3, 0.5;
  Bodies<2> bodies = alone(spec);
  const Wrench<2> load(1.5, -6, 0.35);
  const Vec<2> a = load.head<2>() / spec.mass;
  const double dt = 1e-2;
  const int n = 200;
  for (int i = 0; i < n; ++i) step<2>(bodies, i == 0 ? dt / 2 : dt, dt, load);
  const double t = n * dt;
  const Vec<2> x = spec.velocity.head<2>() * t + a * t * t / 2;
  EXPECT_NEAR((bodies.state(0).pose.translation() - x).norm(), 0, n * eps * 10);
  EXPECT_NEAR(angle(bodies.state(0).pose), 0.5 * t + 0.5 * t * t / 2, 8 * n * eps);
}

TEST(Flight, parabola_is_exact_at_changing_steps_too) {
  BodySpec<2> spec = planar_body();
  Bodies<2> bodies = alone(spec);
  const Wrench<2> load(0, -spec.mass * 9.81, 0);
  double before = 0;
  for (const double dt : {0.01, 0.02, 0.005, 0.005, 0.03}) {
    step<2>(bodies, (before + dt) / 2, dt, load);
    before = dt;
  }
  const double t = bodies.time();
  // The kicks add up to t_n + dt_n / 2: the drift has the midpoint's velocity.
  EXPECT_NEAR(bodies.state(0).pose.translation().y(), -9.81 * t * t / 2, 100 * eps);
}

TEST(Flight, gravity_is_a_force_like_the_load) {
  const Vec<2> g(0.3, -9.81);
  std::vector<std::unique_ptr<Force<2>>> forces;
  forces.push_back(std::make_unique<Gravity<2>>(g));
  Bodies<2> heavy = alone(planar_body(), std::move(forces));
  Bodies<2> loaded = alone(planar_body());
  for (int i = 0; i < 100; ++i) {
    step<2>(heavy, 1e-2, 1e-2);
    step<2>(loaded, 1e-2, 1e-2, Wrench<2>(3 * g.x(), 3 * g.y(), 0));
  }
  EXPECT_NEAR((heavy.state(0).pose.translation() - loaded.state(0).pose.translation()).norm(), 0, 1000 * eps);
  EXPECT_NEAR(heavy.state(0).velocity.y(), -9.81, 1000 * eps);
}

}  // namespace splashdown::rigid::flight_test
