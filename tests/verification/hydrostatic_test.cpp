// Exact laws of fluids without free motion: pressures are linear, so linear elements are exact.
#include <gtest/gtest.h>

#include "tests/unit/coupling/scenes.hpp"

namespace splashdown::hydrostatic_test {
namespace {

namespace fs = fluid::scenes;
using coupling::scenes::g;
using coupling::scenes::water;
using fluid::Fluid;

TEST(Hydrostatic, a_column_at_rest_has_a_linear_pressure_and_stays) {
  const double depth = 1, dt = 0.01;
  coupling::scenes::Watched<2> stepper(
      std::make_unique<Fluid<2>>(fs::still_water(1.3, depth, 0.1), fs::gravity({0, -g})));
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(stepper.attempt(dt).ok());
    const auto& nodes = stepper.fluid().nodes();
    for (std::size_t n = 0; n < nodes.size(); ++n)
      EXPECT_NEAR(stepper.fluid().pressure()[n], -water * g * nodes.x[n].y(), 1e-8 * water * g * depth);
    stepper.commit();
    double speed = 0;
    for (const auto& v : stepper.fluid().nodes().v) speed = std::max(speed, v.norm());
    EXPECT_LE(speed, 1e-6 * std::sqrt(g * depth));
  }
  EXPECT_NEAR(stepper.fluid().ledger().volume, 1.3, 1e-10);
}

TEST(Hydrostatic, a_jump_of_the_step_leaves_the_pressure_alone) {
  coupling::scenes::Watched<2> stepper(std::make_unique<Fluid<2>>(fs::still_water(1, 1, 0.15), fs::gravity({0, -g})));
  for (double dt : {1e-2, 1e-5, 1e-2, 1e-7, 3e-3}) {
    ASSERT_TRUE(stepper.attempt(dt).ok());
    const auto& nodes = stepper.fluid().nodes();
    for (std::size_t n = 0; n < nodes.size(); ++n)
      EXPECT_NEAR(stepper.fluid().pressure()[n], -water * g * nodes.x[n].y(), 1e-6 * water * g);
    stepper.commit();
  }
}

TEST(Hydrostatic, walls_carry_the_weight_of_the_water) {
  coupling::scenes::Watched<2> stepper(std::make_unique<Fluid<2>>(fs::still_water(2, 1, 0.2), fs::gravity({0, -g})));
  ASSERT_TRUE(stepper.attempt(1e-2).ok());
  const auto& load = stepper.fluid().result().loads[0];
  EXPECT_NEAR(load.total()[1], -water * g * 2, 1e-8 * water * g);
  EXPECT_NEAR(load.total()[0], 0, 1e-8 * water * g);
  EXPECT_NEAR(load.wetted, 4, 1e-10);
  EXPECT_LE(load.repair.norm(), 1e-8 * water * g) << "nothing to repair";
}

// A tank that is lifted with acceleration a: p = rho (g + a) depth. The walls' twist is about their frame.
TEST(Hydrostatic, an_accelerated_column_weighs_more) {
  Fluid<2> f(fs::still_water(1, 1, 0.1), fs::gravity({0, -g}));
  const double a = 4, dt = 0.01;
  double velocity = 0, kick = 0.5 * dt;
  fluid::Isometry<2> pose = fluid::Isometry<2>::Identity();
  for (int i = 0; i < 10; ++i, kick = dt) {
    velocity += kick * a;
    const fluid::Twist<2> up(0, velocity, 0);
    ASSERT_TRUE(f.begin(kick, dt, {}).ok());
    ASSERT_TRUE(f.solve(std::vector{up}).status.ok());
    const double surface = pose.translation().y();
    for (std::size_t n = 0; n < f.nodes().size(); ++n)
      EXPECT_NEAR(f.pressure()[n], water * (g + a) * (surface - f.nodes().x[n].y()), 1e-8 * water * (g + a));
    EXPECT_NEAR(f.result().loads[0].total()[1], -water * (g + a), 1e-8 * water * g);
    pose = fluid::moved<2>(pose, up, dt);
    f.commit(std::vector{pose});
    for (const auto& v : f.nodes().v) EXPECT_LE((v - Eigen::Vector2d(0, velocity)).norm(), 1e-9);
  }
}

TEST(Hydrostatic, water_in_free_fall_weighs_nothing) {
  // No walls: a drop falls as a whole.
  fluid::FluidSpec<2> spec;
  spec.size = {.surface = 0.1, .far = 0.1};
  spec.liquids.push_back({fs::ellipse(0.5, 0.3, 40), {}});
  coupling::scenes::Watched<2> stepper(std::make_unique<Fluid<2>>(spec, fs::gravity({0, -g})));
  const auto lowest = [&] {
    double y = 1;
    for (const auto& x : stepper.fluid().nodes().x) y = std::min(y, x.y());
    return y;
  };
  const double start = lowest();
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(stepper.attempt(0.01).ok());
    for (double p : stepper.fluid().pressure()) EXPECT_NEAR(p, 0, 1e-9 * water * g);
    stepper.commit();
    const double half_step_velocity = -g * (stepper.time() - 0.005);
    for (const auto& v : stepper.fluid().nodes().v)
      EXPECT_LE((v - Eigen::Vector2d(0, half_step_velocity)).norm(), 1e-10);
  }
  EXPECT_NEAR(lowest(), start - 0.5 * g * 0.01, 1e-10) << "leapfrog is exact for a constant acceleration";
}

TEST(Hydrostatic, a_box_afloat_by_archimedes_is_at_rest) {
  for (double pitch : {0.0, std::numbers::pi / 2}) {
    coupling::scenes::Scene scene;
    scene.fluid = fs::still_water(3, 1, 0.2);
    scene.fluid.size = {.surface = 0.1, .far = 0.2};
    scene.add_body(rigid::box(0.8, 0.6), 0.4 * water * 0.48, {0, 0.1 * (pitch == 0 ? 0.6 : 0.8)}, 0.1, pitch);
    const auto stepper = coupling::scenes::coupled(scene);
    for (int i = 0; i < 5; ++i) {
      ASSERT_TRUE(stepper->attempt(0.005).ok());
      const double weight = 0.4 * water * 0.48 * g;
      EXPECT_LE((stepper->fluid().result().loads[0].total() - fluid::Wrench<2>(0, weight, 0)).norm(), 1e-8 * weight)
          << i;
      stepper->commit();
    }
    EXPECT_LE(stepper->bodies().state(0).velocity.norm(), 1e-8);
  }
}

}  // namespace
}  // namespace splashdown::hydrostatic_test
