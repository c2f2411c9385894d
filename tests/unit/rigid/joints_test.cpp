// Laws of bodies that are tied to each other or to the world.
#include <gtest/gtest.h>

#include <numbers>

#include "rigid/shapes/mass_properties.hpp"
#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::joints_test {
namespace {

using std::numbers::pi;
constexpr double g = 9.81;

/// A rod of 1 m that hangs from the origin, turned by an angle.
BodySpec<2> rod(double angle, double mass = 2) {
  BodySpec<2> spec = free_body<2>(mass, Inertia<2>(mass / 12));
  spec.surface.vertices.resize(2, 2);
  spec.surface.vertices << 0, 0, -0.5, 0.5;
  spec.pose.rotate(angle);
  spec.pose.translate(Vec<2>(0, -0.5));
  return spec;
}

Vec<2> top(const BodyState<2>& state) { return state.pose * Vec<2>(0, 0.5); }
Vec<2> bottom(const BodyState<2>& state) { return state.pose * Vec<2>(0, -0.5); }

double kinetic(const BodySpec<2>& spec, const Twist<2>& s) {
  return 0.5 * spec.mass * s.head<2>().squaredNorm() + 0.5 * spec.inertia(0, 0) * s[2] * s[2];
}

TEST(Hinge, holds_a_pendulum_with_its_period_to_second_order) {
  // Physical pendulum, small swing: T = 2 pi sqrt((I + m l^2) / (m g l)) (1 + a^2 / 16).
  const double swing = 0.02, l = 0.5,
               exact = 2 * pi * std::sqrt((1. / 12 + l * l) / (g * l)) * (1 + swing * swing / 16);
  std::vector<double> error;
  for (double dt : {0.02, 0.01, 0.005}) {
    Bodies<2> bodies({rod(swing)}, pull<2>({0, -g}), {{.point = {0, 0, 0}}});
    int crossings = 0;
    double first = 0, last = 0, farthest = 0, before = swing;
    for (int i = 0; bodies.time() < 10 * exact + dt; ++i) {
      step(bodies, i == 0 ? dt / 2 : dt, dt);
      const double now = angle(bodies.state(0).pose);
      if (before < 0 && now >= 0) {
        const double crossed = bodies.time() - dt * now / (now - before);
        (crossings++ == 0 ? first : last) = crossed;
      }
      before = now;
      farthest = std::max(farthest, top(bodies.state(0)).norm());
    }
    error.push_back((last - first) / (crossings - 1) / exact - 1);
    // The arc's sagitta of one step at the fastest: l (w dt)^2 / 2, w = swing 2 pi / T.
    EXPECT_LE(farthest, 1.1 * l * std::pow(swing * 2 * pi / exact * dt, 2) / 2);
  }
  EXPECT_NEAR(error[0] / error[1], 4, 0.4);
  EXPECT_NEAR(error[1] / error[2], 4, 0.4);
  EXPECT_LE(std::abs(error[2]), 1e-4);
}

TEST(Hinge, neither_gains_nor_loses_energy_over_a_hundred_swings) {
  const BodySpec<2> spec = rod(1.5);
  Bodies<2> bodies({spec}, pull<2>({0, -g}), {{.point = {0, 0, 0}}});
  const double dt = 2e-3, brought = spec.mass * g * spec.pose.translation().y();
  double least = 0, most = 0;
  Twist<2> before = spec.velocity;
  for (int i = 0; i < 80000; ++i) {
    const double height = bodies.state(0).pose.translation().y();
    step(bodies, i == 0 ? dt / 2 : dt, dt);
    const double now = kinetic(spec, 0.5 * (before + bodies.state(0).velocity)) + spec.mass * g * height - brought;
    before = bodies.state(0).velocity;
    if (i > 400 && i < 8000) least = std::min(least, now), most = std::max(most, now);
    if (i >= 8000) {
      EXPECT_GE(now, 1.5 * least - 1e-9) << i;
      EXPECT_LE(now, 1.5 * most + 1e-9) << i;
    }
  }
  EXPECT_LE(most - least, 1e-3 * std::abs(brought));
}

TEST(Hinge, between_bodies_in_flight_keeps_their_momenta) {
  BodySpec<2> upper = rod(0), lower = rod(0, 2e-3);  // 1000 : 1
  lower.pose.pretranslate(Vec<2>(0, -1));
  upper.velocity << 0.3, 0, 2;
  lower.velocity << 1.8, 0, -40;
  Bodies<2> bodies({upper, lower}, {}, {{.body = 0, .other = 1, .point = {0, -1, 0}}});
  const auto momenta = [&] {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t b : {0u, 1u}) {
      const auto& spec = bodies.spec(b);
      const auto& [pose, s] = bodies.state(b);
      const Vec<2> x = pose.translation(), p = spec.mass * s.head<2>();
      sum += Eigen::Vector3d(p.x(), p.y(), x.x() * p.y() - x.y() * p.x() + spec.inertia(0, 0) * s[2]);
    }
    return sum;
  };
  const double dt = 1e-3;
  const auto step = [&](Bodies<2>& both, double kick, double by) {
    both.begin(kick, by);
    both.solve(std::vector<Wrench<2>>(2, Wrench<2>::Zero()));
    both.commit();
  };
  step(bodies, dt / 2, dt);
  const auto start = momenta();
  for (int i = 0; i < 5000; ++i) {
    step(bodies, dt, dt);
    ASSERT_TRUE(bodies.state(1).velocity.allFinite());
    // Its error of position is an arc's sagitta, r (w dt)^2 / 2 with w = 42 rad/s.
    EXPECT_LE((bottom(bodies.state(0)) - top(bodies.state(1))).norm(), 0.5 * std::pow(45 * dt, 2));
  }
  EXPECT_NEAR((momenta() - start).head<2>().norm(), 0, 1e-10);
  EXPECT_NEAR(momenta()[2], start[2], 1e-10 * std::abs(start[2]));
}

TEST(Hinge, in_a_corner_that_two_boxes_share_is_no_contact) {
  BodySpec<2> a = rod(0), b = rod(0);
  for (BodySpec<2>* spec : {&a, &b}) {
    spec->surface.vertices.resize(2, 4);
    spec->surface.vertices << -0.5, 0.5, 0.5, -0.5, -0.5, -0.5, 0.5, 0.5;
    spec->surface.facets.resize(2, 4);
    spec->surface.facets << 0, 1, 2, 3, 1, 2, 3, 0;
  }
  b.pose.pretranslate(Vec<2>(1, 0));
  a.velocity << 0, -1, 0;
  Bodies<2> bodies({a, b}, {}, {{.body = 0, .other = 1, .point = {0.5, -1, 0}}}, ContactSpec<2>{});
  for (int i = 0; i < 200; ++i) {
    bodies.begin(1e-3, 1e-3);
    bodies.solve(std::vector<Wrench<2>>(2, Wrench<2>::Zero()));
    bodies.commit();
    ASSERT_LE(bodies.state(0).velocity.norm() + bodies.state(1).velocity.norm(), 5);
  }
}

TEST(Hinge, leaves_a_body_the_turn_about_the_point) {
  Bodies<2> bodies({rod(0.4)}, {}, {{.point = {0, 0, 0}}});
  bodies.begin(1e-3, 1e-3);
  const auto c = compliance(bodies);
  const Vec<2> x = bodies.state(0).pose.translation();
  const Eigen::Vector3d turn(-x.y(), x.x(), 1);
  const double about_point = 2. / 12 + 2 * x.squaredNorm();
  EXPECT_NEAR((c - turn * turn.transpose() / about_point).norm(), 0, 100 * eps);
}

TEST(Hinge, to_a_body_that_moves_on_a_path_follows_it) {
  BodySpec<2> driver = free_body<2>(1, Inertia<2>(1)), hung = rod(0);
  driver.motion = BodyMotion::prescribed;
  driver.path = [](double t) {
    Isometry<2> pose = Isometry<2>::Identity();
    pose.translation() = Vec<2>(0.3 * std::sin(t), 0);
    return pose;
  };
  Bodies<2> bodies({driver, hung}, pull<2>({0, -g}), {{.body = 1, .other = 0, .point = {0, 0, 0}}});
  for (int i = 0; i < 1000; ++i) {
    bodies.begin(5e-3, 5e-3);
    bodies.solve(std::vector<Wrench<2>>(2, Wrench<2>::Zero()));
    bodies.commit();
    EXPECT_LE((top(bodies.state(1)) - bodies.state(0).pose.translation()).norm(), 1e-4);
  }
}

TEST(Slider, lets_a_body_move_along_its_axis_only) {
  const Vec<2> along = Vec<2>(1, 1).normalized();
  Bodies<2> bodies({rod(0)}, pull<2>({0, -g}), {{.type = JointType::slider, .axis = {along.x(), along.y(), 0}}});
  const Vec<2> start = bodies.state(0).pose.translation();
  const double dt = 1e-2;
  for (int i = 0; i < 100; ++i) step(bodies, i == 0 ? dt / 2 : dt, dt);
  const Vec<2> way = bodies.state(0).pose.translation() - start;
  EXPECT_NEAR(way.dot(along), -0.5 * g * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(way.dot(Vec<2>(-along.y(), along.x())), 0, 1e-12);
  EXPECT_NEAR(angle(bodies.state(0).pose), 0, 1e-12);
}

TEST(Weld, makes_two_bodies_one) {
  BodySpec<2> a = rod(0), b = rod(0, 3);
  b.pose.pretranslate(Vec<2>(1, 0));
  Bodies<2> bodies({a, b}, {}, {{.type = JointType::weld, .body = 0, .other = 1, .point = {0.5, 0, 0}}});
  bodies.begin(1e-3, 1e-3);
  const auto c = compliance(bodies);
  // Of the whole: mass, centre, inertia by the parallel axes.
  const double m = 5, x = 3. / 5, inertia = 5. / 12 + 2 * x * x + 3 * (1 - x) * (1 - x);
  EXPECT_NEAR(c(1, 1), 1 / m + x * x / inertia, 100 * eps);
  EXPECT_NEAR(c(2, 2), 1 / inertia, 100 * eps);
  EXPECT_NEAR(c(1, 4), 1 / m - x * (1 - x) / inertia, 100 * eps);
  EXPECT_NEAR(c(2, 5), 1 / inertia, 100 * eps);
}

TEST(Hinge, in_space_leaves_the_turn_about_its_axis) {
  BodySpec<3> spec = skew_body();
  spec.pose.translation() = Vec<3>(0.3, 0.2, -0.4);
  const Vec<3> axis = Vec<3>(1, 2, 2) / 3;
  Bodies<3> bodies({spec}, {}, {{.point = {0, 0, 0}, .axis = axis}});
  const double instant = 1e-12;
  bodies.begin(instant, instant);
  const auto c = compliance(bodies);
  Twist<3> turn;
  turn << axis.cross(spec.pose.translation()), axis;
  const double about_axis =
      axis.dot(spec.inertia * axis) + spec.mass * axis.cross(spec.pose.translation()).squaredNorm();
  EXPECT_NEAR((c - turn * turn.transpose() / about_axis).norm(), 0, 1e3 * eps);
}

TEST(Joint, that_ties_nothing_is_refused) {
  const auto refused = [](const JointSpec& joint) {
    EXPECT_THROW(Bodies<2>({rod(0), rod(1)}, {}, {joint}), std::invalid_argument);
  };
  refused({.body = 2});
  refused({.body = 0, .other = 0});
  refused({.body = 0, .other = 5});
  refused({.body = 0, .axis = {0, 0, 0}});
}

TEST(Slider, does_not_turn_about_its_axis_from_the_first_step_on) {
  BodySpec<3> spec = free_body<3>(2, Inertia<3>::Identity());
  Bodies<3> bodies({spec}, {}, {{.type = JointType::slider, .axis = Eigen::Vector3d::UnitX()}});
  for (int i = 0; i < 3; ++i) {
    bodies.begin(1e-3, 1e-3);
    Wrench<3> load = Wrench<3>::Zero();
    if (i > 0) load << 1, 2, 3, 40, 50, 60;
    bodies.solve(std::vector{load});
    bodies.commit();
    EXPECT_LE(bodies.state(0).velocity.tail<5>().norm(), 1e-12) << i;
  }
}

}  // namespace
}  // namespace splashdown::rigid::joints_test
