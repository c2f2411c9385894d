// Light bodies that joints and contacts hold, in water.
#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "coupling/accelerators/quasi_newton.hpp"
#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

namespace scenes = coupling::scenes;
using scenes::g;
using scenes::water;
using Vec = Eigen::Vector2d;

void run_evenly(coupling::scenes::Watched<2>& stepper, int steps, double dt) {
  for (int i = 0; i < steps; ++i) {
    const auto report = stepper.attempt(dt);
    ASSERT_TRUE(report.ok()) << report.cause;
    stepper.commit();
  }
}

void run_in_one_pass_a_step(coupling::scenes::Watched<2>& stepper, int steps, double dt) {
  for (int i = 0; i < steps; ++i) {
    const auto report = stepper.attempt(dt);
    ASSERT_TRUE(report.ok()) << report.cause;
    EXPECT_EQ(report.passes, 1);
    EXPECT_LE(report.residual, 1e-10);
    stepper.commit();
  }
}

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
      SCOPED_TRACE(std::to_string(ratio) + " of water's density, " + std::to_string(dt) + " s");
      const auto stepper = scenes::coupled(hinged(ratio));
      run_in_one_pass_a_step(*stepper, 5, dt);
      EXPECT_LE((held_end(*stepper) - Vec(0, -1.8)).norm(), 1e-6);
    }
}

TEST(Hinged, accelerators_without_the_term_find_the_same_motion) {
  // To the corrections of the pressure, a part of the mesh's own error.
  const auto after = [](const std::unique_ptr<coupling::scenes::Watched<2>>& stepper) {
    run_evenly(*stepper, 4, 1e-3);
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
  beside.bodies[1].motion = BodyMotion::fixed;
  alone = beside;
  beside.joints[0].other = 1;
  const auto a = scenes::coupled(alone), b = scenes::coupled(beside);
  EXPECT_EQ(scenes::run(*a, 10), 1);
  EXPECT_EQ(scenes::run(*b, 10), 1);
  EXPECT_NEAR(a->bodies().state(0).velocity[2], b->bodies().state(0).velocity[2], 1e-9);
}

TEST(Sprung, bodies_of_any_density_on_any_spring_take_one_pass) {
  for (double ratio : {10.0, 1.0 / 3, 1e-3, 0.0})
    for (double stiffness : {1.0, 1e4, 1e10}) {
      auto scene = hinged(ratio);
      scene.joints[0].spring = rigid::Spring{stiffness, 0.01 * stiffness, 0.2};
      SCOPED_TRACE(std::to_string(ratio) + " of water's density, " + std::to_string(stiffness) + " N m/rad");
      const auto stepper = scenes::coupled(scene);
      run_in_one_pass_a_step(*stepper, 20, 1e-3);
      // Far stronger than anything else, spring and damper draw it to its rest like exp(-k t/c), k/c = 100/s.
      const double turned = Eigen::Rotation2Dd(stepper->bodies().state(0).pose.linear()).angle() - 0.5;
      if (stiffness == 1e10) {
        EXPECT_NEAR(turned, 0.2 * (1 - std::exp(-100 * stepper->time())), 0.05 * 0.2) << "k dt/c = 0.1";
      }
    }
}

/// A circle under water that moves up and down only, without gravity: nothing but what acts along y.
scenes::Scene guided() {
  scenes::Scene s;
  s.fluid = fluid::scenes::still_water(4, 3, 0.3);
  s.fluid.size = {.surface = 0.2, .far = 0.3, .growth = 0.2};
  s.gravity.setZero();
  const auto shape = rigid::circle(0.3, 48);
  s.add_body(shape, 0.2 * water * shape.at_unit_density.mass, {0, -1.5}, 0.08);
  s.joints.push_back({.type = rigid::JointType::slider, .axis = Eigen::Vector3d::UnitY()});
  return s;
}

class Push final : public rigid::Force<2> {
 public:
  static constexpr double force = 100;  // [N/m]
  std::string name() const override { return "push"; }
  void add(const rigid::BodiesAt<2>&, std::span<rigid::Wrench<2>> wrenches) const override {
    for (auto& wrench : wrenches) wrench[1] += force;
  }
};

// w^2 = k/(m + M_a): the mass is that which a force finds, F/a.
TEST(Sprung, body_swings_with_the_mass_of_water_that_a_force_finds) {
  auto pushed = guided();
  pushed.extra_force = [] { return std::make_unique<Push>(); };
  const auto by_force = scenes::coupled(pushed);
  constexpr double dt = 2e-3;
  run_evenly(*by_force, 10, dt);
  const double mass = Push::force * (by_force->time() - dt / 2) / by_force->bodies().state(0).velocity[1];
  for (double stiffness : {mass * 100, mass * 1600}) {
    auto sprung = guided();
    constexpr double way = 0.01;  // small: the water's mass does not change on it
    sprung.joints[0].spring = rigid::Spring{stiffness, 0, way};
    const auto stepper = scenes::coupled(sprung);
    const double period = 2 * std::numbers::pi * std::sqrt(mass / stiffness);
    const int steps = static_cast<int>(std::lround(0.5 * period / dt));
    run_evenly(*stepper, steps, dt);
    const double t = stepper->time(), w = std::sqrt(stiffness / mass);
    EXPECT_NEAR(stepper->bodies().state(0).pose.translation().y() + 1.5, way * (1 - std::cos(w * t)), 0.02 * 2 * way)
        << stiffness << ": half a period later it is on the other side";
  }
}

/// Pushes bodies towards x = 0 with 2 m/s^2.
class Press final : public rigid::Force<2> {
 public:
  std::string name() const override { return "press"; }
  void add(const rigid::BodiesAt<2>& at, std::span<rigid::Wrench<2>> wrenches) const override {
    for (std::size_t i = 0; i < wrenches.size(); ++i)
      wrenches[i][0] += (at.states[i].pose.translation().x() < 0 ? 2 : -2) * at.specs[i].mass;
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
INSTANTIATE_TEST_SUITE_P(Touching, Gap, ::testing::Range(0.0505, 0.15, 0.005));

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
  int passes_at_rest = 0;
  while (stepper->time() < 1.5) {
    dt = std::min({stepper->stable_dt(), 1.5 * dt, 5e-3});
    const auto report = scenes::attempt_halving(*stepper, dt, 9);
    ASSERT_TRUE(report.ok()) << stepper->time() << ": " << report.cause;
    if (stepper->time() > 1.2) passes_at_rest = std::max(passes_at_rest, report.passes);
    stepper->commit();
  }
  const auto& [pose, velocity] = stepper->bodies().state(0);
  EXPECT_NEAR(pose.translation().y(), -0.9, 1e-4);
  EXPECT_LE(std::abs(velocity[1]), 1e-6) << "it may glide, the floor is smooth, and neither lift nor turn";
  EXPECT_LE(std::abs(velocity[2]), 1e-6);
  EXPECT_EQ(passes_at_rest, 1) << "what lay on the floor lies there";
}

/// A box heavier than water that glides over the floor, under water.
scenes::Scene gliding(double friction) {
  scenes::Scene s;
  s.fluid = fluid::scenes::still_water(3, 0.8, 0.1);
  s.fluid.size = {.surface = 0.1, .far = 0.1, .growth = 0.2};
  const auto shape = rigid::box(0.4, 0.2);
  s.add_body(shape, 3 * water * 0.08, {-0.4, -0.7}, 0.05);
  s.set_velocity(0, {1, 0, 0});
  s.contacts = rigid::ContactSpec<2>{{{Vec(0, -0.8), Vec(0, 1)}}, {}, friction};
  return s;
}

TEST(Rubbing, stops_what_glides_under_water) {
  const auto stepper = scenes::coupled(gliding(0.5));
  double dt = 1e-5, start = 0;
  while (stepper->time() < 1) {
    dt = std::min({stepper->stable_dt(), 1.5 * dt, 5e-3});
    const auto report = scenes::attempt_halving(*stepper, dt, 9);
    ASSERT_TRUE(report.ok()) << stepper->time() << ": " << report.cause;
    stepper->commit();
    if (start == 0) start = stepper->bodies().state(0).velocity[0];
  }
  const auto& [pose, velocity] = stepper->bodies().state(0);
  EXPECT_NEAR(pose.translation().y(), -0.7, 1e-6);
  EXPECT_LE(velocity.norm(), 1e-9) << "what sticks does not move";
  // No water gets under it: the floor bears its weight and that of the water above it, as much again, 2 m g. The mass of
  // water that the start takes along, m/(m + M_a) = v_0 / 1 m/s, is slowed too: v_0^2 (m + M_a)/(2 mu 2 m g).
  EXPECT_NEAR(pose.translation().x() + 0.4, start / (2 * 0.5 * 2 * g), 0.1 * start / (2 * 0.5 * 2 * g))
      << "waves, drag";
}

TEST(Rubbing, is_the_same_to_accelerators_without_the_term) {
  const auto after = [](const std::unique_ptr<coupling::scenes::Watched<2>>& stepper) {
    run_evenly(*stepper, 20, 2e-3);
    return stepper->bodies().state(0).velocity[0];
  };
  const double smooth = after(scenes::coupled(gliding(0))), rough = after(scenes::coupled(gliding(0.5))),
               found = after(scenes::coupled(gliding(0.5), std::make_unique<coupling::NoTerm>(),
                                             std::make_unique<coupling::IqnIls>(1.0)));
  EXPECT_LT(rough, smooth);
  EXPECT_NEAR(found, rough, 0.02 * (smooth - rough)) << "to the corrections of the pressure";
}

}  // namespace
}  // namespace splashdown
