// Light bodies that joints and contacts hold, in water.
#include <gtest/gtest.h>

#include "coupling/accelerators/quasi_newton.hpp"
#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

namespace scenes = coupling::scenes;
using scenes::g;
using scenes::water;
using Vec = Eigen::Vector2d;

/// An ellipse under water, held at its end.
scenes::Scene hinged(double ratio, double angle = 0.5) {
  scenes::Scene s;
  s.fluid = fluid::scenes::still_water(5, 3, 0.3);
  s.fluid.size = {.surface = 0.2, .far = 0.3, .growth = 0.2};
  const auto shape = rigid::ellipse(0.5, 0.25, 64);
  const Vec end(0, -1.8), centre = end + 0.5 * Vec(std::cos(angle), std::sin(angle));
  s.add_body(shape, ratio * water * shape.at_unit_density.mass, centre, 0.08, angle);
  s.joints.push_back({.point = {end.x(), end.y(), 0}});
  return s;
}

Vec held_end(const coupling::scenes::Watched<2>& stepper) { return stepper.bodies().state(0).pose * Vec(-0.5, 0); }

TEST(Hinged, bodies_of_any_density_take_one_pass_and_leave_roundoff) {
  for (double ratio : {10.0, 1.0, 1.0 / 3, 0.1, 1e-2, 1e-3, 1e-6, 1e-9, 0.0})
    for (double dt : {1e-3, 1e-3 / 4, 1e-3 / 16}) {
      const auto stepper = scenes::coupled(hinged(ratio));
      for (int i = 0; i < 5; ++i) {
        const auto report = stepper->attempt(dt);
        ASSERT_TRUE(report.ok()) << report.cause;
        EXPECT_EQ(report.passes, 1) << ratio << ' ' << dt;
        EXPECT_LE(report.residual, 1e-10) << ratio << ' ' << dt;
        stepper->commit();
      }
      EXPECT_LE((held_end(*stepper) - Vec(0, -1.8)).norm(), 1e-6) << ratio << ' ' << dt;
    }
}

TEST(Hinged, accelerators_without_the_term_find_the_same_motion) {
  // To the corrections of the pressure, a part of the mesh's own error.
  const auto after = [](const std::unique_ptr<coupling::scenes::Watched<2>>& stepper) {
    for (int i = 0; i < 4; ++i) {
      const auto report = stepper->attempt(1e-3);
      EXPECT_TRUE(report.ok()) << report.cause;
      stepper->commit();
    }
    return stepper->bodies().state(0).velocity[2];
  };
  for (double ratio : {1.0 / 3, 0.1}) {
    const double exact = after(scenes::coupled(hinged(ratio)));
    const double found = after(
        scenes::coupled(hinged(ratio), std::make_unique<coupling::NoTerm>(), std::make_unique<coupling::IqnIls>(1.0)));
    EXPECT_NEAR(found, exact, 0.02 * std::abs(exact)) << ratio;
  }
}

TEST(Hinged, pair_of_a_light_and_a_heavy_body_swings) {
  // 1000 : 1 in mass, one under the other, the heavy one below.
  scenes::Scene s;
  s.fluid = fluid::scenes::still_water(5, 3, 0.3);
  s.fluid.size = {.surface = 0.2, .far = 0.3, .growth = 0.2};
  const auto shape = rigid::box(0.2, 0.6);
  s.add_body(shape, 0.5, {0, -0.8}, 0.08);
  s.add_body(shape, 500, {0, -1.5}, 0.08);
  s.joints.push_back({.body = 0, .point = {0, -0.5, 0}});
  s.joints.push_back({.body = 0, .other = 1, .point = {0, -1.15, 0}});
  s.set_velocity(1, {0.3, 0, 0});
  const auto stepper = scenes::coupled(s);
  EXPECT_EQ(scenes::run(*stepper, 100), 1) << "passes of a step; -1: one was refused";
  const Vec upper = stepper->bodies().state(0).pose * Vec(0, -0.35),
            lower = stepper->bodies().state(1).pose * Vec(0, 0.35);
  EXPECT_LE((upper - lower).norm(), 1e-4);
}

TEST(Hinged, to_a_fixed_body_is_hinged_to_the_world) {
  auto alone = hinged(1.0 / 3), beside = hinged(1.0 / 3);
  beside.add_body(rigid::circle(0.1, 24), 10, {1.5, -1}, 0.1);
  beside.bodies[1].motion = rigid::Motion::fixed;
  alone = beside;
  beside.joints[0].other = 1;
  const auto a = scenes::coupled(alone), b = scenes::coupled(beside);
  EXPECT_EQ(scenes::run(*a, 10), 1);
  EXPECT_EQ(scenes::run(*b, 10), 1);
  EXPECT_NEAR(a->bodies().state(0).velocity[2], b->bodies().state(0).velocity[2], 1e-9);
}

/// Pushes bodies towards x = 0 with 2 m/s^2.
class Press final : public rigid::Force<2> {
 public:
  std::string name() const override { return "press"; }
  rigid::Wrench<2> wrench(const rigid::BodySpec<2>& body, const rigid::Isometry<2>& pose, const rigid::Twist<2>&,
                          double) const override {
    return {pose.translation().x() < 0 ? 2 * body.mass : -2 * body.mass, 0, 0};
  }
};

/// Two flat boxes of a third of water's density, afloat.
scenes::Scene pressed(double gap) {
  scenes::Scene s;
  s.fluid = fluid::scenes::still_water(3, 1, 0.2);
  s.fluid.size = {.surface = 0.04, .far = 0.2, .growth = 0.2};
  const auto shape = rigid::box(0.4, 0.2);
  for (double side : {-1.0, 1.0}) {
    s.add_body(shape, water / 3 * 0.08, {side * (0.2 + gap / 2), 0.1 - 0.2 / 3}, 0.03);
  }
  s.contacts.emplace();
  return s;
}

TEST(Touching, boxes_that_start_flush_and_still_stay_so) {
  const auto s = pressed(0);
  const auto stepper = scenes::coupled(s);
  ASSERT_NE(scenes::run(*stepper, 100, 1e-3), -1);
  for (std::size_t b : {0u, 1u}) {
    // Afloat in the draft of Archimedes: what moves them is the mesh's meniscus at the corners, a part of an element.
    EXPECT_LE(stepper->bodies().state(b).velocity.head<2>().norm(), 0.01) << b;
    EXPECT_NEAR(stepper->bodies().state(b).pose.translation().x(), b == 0 ? -0.2 : 0.2, 0.03 / 10);
  }
}

class Gap : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Touching, Gap, ::testing::Range(0.0505, 0.15, 0.0125));

TEST_P(Gap, boxes_that_close_it_do_not_enter_each_other) {
  auto s = pressed(GetParam());
  s.extra_force = [] { return std::make_unique<Press>(); };
  const auto stepper = scenes::coupled(s);
  double dt = 1e-3, nearest = 1;
  while (stepper->time() < 1.5) {
    dt = std::min(stepper->stable_dt(), 1.5 * dt);
    const auto report = scenes::attempt_halving(*stepper, dt, 9);
    ASSERT_TRUE(report.ok()) << report.cause;
    stepper->commit();
    for (std::size_t one : {0u, 1u}) {
      const auto &mine = stepper->bodies().state(one).pose, &other = stepper->bodies().state(1 - one).pose;
      const Eigen::Matrix2Xd x = (mine.inverse() * other) * Eigen::Matrix2Xd(s.bodies[0].surface.vertices);
      for (Eigen::Index v = 0; v < x.cols(); ++v)
        nearest = std::min(nearest, std::max(std::abs(x(0, v)) - 0.2, std::abs(x(1, v)) - 0.1));
    }
  }
  EXPECT_GE(nearest, -1e-4) << "a corner that turns on a face leaves the tangent by (w dt)^2 r / 2 a step";
  EXPECT_LE(nearest, 1e-6) << "they touch";
}

TEST(Touching, a_sunken_box_comes_to_rest_on_the_bottom) {
  scenes::Scene s;
  s.fluid = fluid::scenes::still_water(2, 1, 0.1);
  s.fluid.size = {.surface = 0.1, .far = 0.1, .growth = 0.2};
  const auto shape = rigid::box(0.4, 0.2);
  s.add_body(shape, 3 * water * 0.08, {0, -0.8}, 0.04);
  s.contacts = rigid::ContactSpec<2>{{{Vec(0, -1), Vec(0, 1)}}};
  const auto stepper = scenes::coupled(s);
  double dt = 1e-3;
  while (stepper->time() < 1.5) {
    dt = std::min({stepper->stable_dt(), 1.5 * dt, 5e-3});
    const auto report = scenes::attempt_halving(*stepper, dt, 9);
    ASSERT_TRUE(report.ok()) << stepper->time() << ": " << report.cause;
    stepper->commit();
  }
  const auto& [pose, velocity] = stepper->bodies().state(0);
  EXPECT_NEAR(pose.translation().y(), -0.9, 1e-4);
  EXPECT_LE(std::abs(velocity[1]), 1e-6) << "it may glide, the floor is smooth, and neither lift nor turn";
  EXPECT_LE(std::abs(velocity[2]), 1e-6);
}

}  // namespace
}  // namespace splashdown
