// Afloat at rest for long, drawn in another frame, a chain let go: cases whose laws need no reference.
#include <gtest/gtest.h>

#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

namespace scenes = coupling::scenes;
using Vec = Eigen::Vector2d;
using scenes::g;
using scenes::water;

// Archimedes' draft is a solution of the discrete equations; a push of 1e-8 of the draft may not grow.
TEST(Afloat, for_ten_seconds_a_box_drifts_by_less_than_a_thousandth_of_its_draft) {
  const double draft = 0.24;
  for (double push : {0.0, 1e-8}) {
    scenes::Scene s;
    s.fluid = fluid::scenes::still_water(3, 1, 0.2);
    s.fluid.size = {.surface = 0.1, .far = 0.2};
    s.add_body(rigid::box(0.8, 0.6), draft * 0.8 * water, {0, 0.3 - draft + push * draft}, 0.1);
    const auto stepper = scenes::coupled(s);
    double dt = 1e-3;
    while (stepper->time() < 10) {
      dt = std::min(stepper->stable_dt(), 1.5 * dt);
      ASSERT_TRUE(stepper->attempt(dt).ok()) << stepper->time();
      stepper->commit();
    }
    const Vec moved = stepper->bodies().state(0).pose.translation() - Vec(0, 0.3 - draft);
    EXPECT_LE(moved.norm(), 1e-3 * draft) << push;
    EXPECT_LE(stepper->bodies().state(0).velocity.norm(), 1e-3 * std::sqrt(g * draft)) << push;
  }
}

// The same box twice: drawn lying and not turned, drawn upright and turned by 90 degrees.
TEST(Drawn, in_another_frame_a_body_moves_the_same_way) {
  const auto after = [](double width, double height, double pitch) {
    scenes::Scene s;
    s.fluid = fluid::scenes::still_water(4, 2, 0.3);
    s.fluid.size = {.surface = 0.06, .far = 0.3, .growth = 0.2};
    s.add_body(rigid::box(width, height), 40, {0.1, 0.05}, 0.03, pitch + 0.2);
    s.set_velocity(0, {0.3, -1, 0.5});
    const auto stepper = scenes::coupled(s);
    EXPECT_GE(scenes::run(*stepper, 60, 1e-3), 1);
    return std::pair(stepper->time(), stepper->bodies().state(0).velocity);
  };
  const auto [time, lying] = after(0.5, 0.25, 0);
  const auto [same_time, upright] = after(0.25, 0.5, std::numbers::pi / 2);
  const double push = (lying.head<2>() - Vec(0.3, -1 - g * time)).norm();
  EXPECT_GT(push, 0.1) << "the water acts";
  // As for turned scenes: ties of the triangulation, the scatter of the loads. Steps follow the meshes.
  EXPECT_NEAR(same_time, time, 0.02 * time);
  EXPECT_LE((upright - lying).head<2>().norm(), 0.02 * push + g * std::abs(same_time - time));
}

// Rods of a third of water's density, hinged to each other, hanging upward from nothing: let go they rise.
TEST(Riser, let_go_under_water_rises_and_holds_together) {
  scenes::Scene s;
  s.fluid = fluid::scenes::still_water(4, 4, 0.3);
  s.fluid.size = {.surface = 0.3, .far = 0.3, .growth = 0.2};
  const int rods = 5;
  const double length = 0.5, thickness = 0.1;
  for (int i = 0; i < rods; ++i)
    s.add_body(rigid::box(thickness, 0.8 * length), water / 3 * thickness * 0.8 * length, {0, -3.5 + i * length}, 0.05);
  for (int i = 0; i + 1 < rods; ++i)
    s.joints.push_back({.body = static_cast<std::size_t>(i),
                        .other = static_cast<std::size_t>(i + 1),
                        .point = {0, -3.5 + (i + 0.5) * length, 0}});
  const auto stepper = scenes::coupled(s);
  double dt = 1e-3;
  while (stepper->time() < 0.3) {
    dt = std::min(stepper->stable_dt(), 1.5 * dt);
    const auto report = stepper->attempt(dt);
    ASSERT_TRUE(report.ok()) << report.cause;
    EXPECT_EQ(report.passes, 1);
    stepper->commit();
  }
  const auto& bodies = stepper->bodies();
  for (std::size_t i = 0; i < rods; ++i) {
    // Lift over the least mass, that of the rod alone, is 2 g.
    EXPECT_GT(bodies.state(i).velocity[1], 0);
    EXPECT_LE(bodies.state(i).velocity.head<2>().norm(), 2 * g * stepper->time());
    if (i + 1 == rods) continue;
    const Vec top = bodies.state(i).pose * Vec(0, length / 2), bottom = bodies.state(i + 1).pose * Vec(0, -length / 2);
    EXPECT_LE((top - bottom).norm(), 1e-3 * length);
  }
}

}  // namespace
}  // namespace splashdown
