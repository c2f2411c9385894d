// Laws of bodies that touch.
#include <gtest/gtest.h>

#include "rigid/shapes/shapes.hpp"
#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::contacts_test {
namespace {

constexpr double g = 9.81;

const ContactSpec<2> floor_at_zero{{{Vec<2>(0, 0), Vec<2>(0, 1)}}};

TEST(Contact, stops_a_body_at_a_plane_and_lets_it_rest_there) {
  for (const auto& shape : {box(1, 0.5), circle(0.25)}) {
    Bodies<2> bodies({of_shape(shape, {0, 0.5})}, pull<2>({0, -g}), {}, floor_at_zero);
    run(bodies, 1000);
    const auto& [pose, s] = bodies.state(0);
    EXPECT_NEAR((pose.linear() * bodies.spec(0).surface.vertices).row(1).minCoeff() + pose.translation().y(), 0, 1e-9);
    EXPECT_NEAR(s.norm(), 0, 1e-9) << "no jitter";
  }
}

TEST(Contact, is_a_plastic_impact_that_keeps_momentum) {
  BodySpec<2> a = of_shape(box(1, 1), {0, 0}), b = of_shape(box(1, 1), {1.5, 0}, 3);
  a.velocity << 4, 0, 0;
  b.velocity << -1, 0, 0;
  Bodies<2> bodies({a, b}, {}, {}, ContactSpec<2>{});
  run(bodies, 200);
  const double common = (2 * 4 - 3 * 1) / 5.;
  for (std::size_t i : {0u, 1u}) {
    EXPECT_NEAR(bodies.state(i).velocity[0], common, 1e-9);
    EXPECT_NEAR(bodies.state(i).velocity.tail<2>().norm(), 0, 1e-9);
  }
  EXPECT_NEAR(bodies.state(1).pose.translation().x() - bodies.state(0).pose.translation().x(), 1, 1e-9)
      << "no gap, no overlap";
}

// Push them out at depth / dt, and a light body that overlaps a heavy one leaves with energy that nobody gave.
TEST(Contact, hulls_that_overlap_part_without_speed) {
  for (const double mass : {2.0, 2e-6}) {
    BodySpec<2> a = of_shape(box(1, 1), {0, 0}, mass), b = of_shape(box(1, 0.8), {0.99, 0}, 3);
    Bodies<2> bodies({a, b}, {}, {}, ContactSpec<2>{});
    run(bodies, 20);
    for (std::size_t i : {0u, 1u}) EXPECT_NEAR(bodies.state(i).velocity.norm(), 0, 1e-9) << mass;
    const double apart = bodies.state(1).pose.translation().x() - bodies.state(0).pose.translation().x();
    EXPECT_GT(apart, 1 - 1e-6) << mass;
    EXPECT_LT(bodies.state(1).pose.translation().x() - 0.99, 0.01 * mass / (mass + 3) + 1e-6) << "the heavy one least";
  }
}

TEST(Contact, looks_as_far_as_bodies_come) {
  // At rest at t_n it looks at what is near; a blow within the step throws it through the floor.
  Bodies<2> bodies({of_shape(box(1, 0.5), {0, 3})}, {}, {}, floor_at_zero);
  bodies.begin(1e-3, 1e-3);
  bodies.solve(std::vector<Wrench<2>>{Wrench<2>(0, -2 * 500 / 1e-3, 0)});
  EXPECT_TRUE(bodies.acceptable().ok()) << "half a metre";
  bodies.solve(std::vector<Wrench<2>>{Wrench<2>(0, -2 * 5000 / 1e-3, 0)});
  EXPECT_NE(bodies.acceptable().cause.find("passes through"), std::string::npos);
  bodies.solve(std::vector<Wrench<2>>{Wrench<2>(0, 0, 1e6)});
  EXPECT_NE(bodies.acceptable().cause.find("turns too far"), std::string::npos);
}

/// Two boxes that come from both sides at the same height, each at this speed from this distance of its inner face.
std::vector<BodySpec<2>> jaws(double from, double speed, double height) {
  std::vector<BodySpec<2>> both;
  for (const double side : {-1.0, 1.0}) {
    BodySpec<2> jaw = of_shape(box(0.2, 0.2), {0, 0});
    jaw.motion = BodyMotion::prescribed;
    jaw.path = [=](double t) {
      return Isometry<2>(Eigen::Translation<double, 2>(side * (from + 0.1 - speed * t), height));
    };
    jaw.pose = jaw.path(0);
    both.push_back(jaw);
  }
  return both;
}

TEST(Contact, refuses_a_step_that_leaves_a_body_no_room) {
  std::vector<BodySpec<2>> specs = jaws(0.5 + 1e-2, 1, 0);
  specs.push_back(of_shape(box(1, 1), {0, 0}));
  specs.back().name = "nut";
  Bodies<2> bodies(std::move(specs), {}, {}, ContactSpec<2>{});
  const double dt = 3e-3;
  const std::vector<Wrench<2>> none(3, Wrench<2>::Zero());
  while (bodies.time() + dt < 1e-2) {
    bodies.begin(dt, dt), bodies.solve(none);
    ASSERT_TRUE(bodies.acceptable().ok()) << bodies.time();
    bodies.commit();
  }
  bodies.begin(dt, dt), bodies.solve(none);
  EXPECT_NE(bodies.acceptable().cause.find("close in on \"nut\", which has no room"), std::string::npos)
      << bodies.acceptable().cause;
}

// Between jaws a seed of half angle a leaves 1/tan(a) times as fast as each of them comes. Hulls do not know small angles.
TEST(Contact, squeezes_seeds_out_unless_they_are_too_slim) {
  for (const double slope : {0.5, 0.1, 0.03}) {
    std::vector<BodySpec<2>> specs = jaws(0.6 * slope, 1, -0.5);  // their upper corners touch
    specs.push_back(of_shape(polygon(std::vector<Vec<2>>{{0, -1}, {slope, 0}, {-slope, 0}}), {0, -1 / 3.}));
    specs.back().name = "seed";
    Bodies<2> bodies(std::move(specs), {}, {}, ContactSpec<2>{});
    const double dt = 1e-5;
    bodies.begin(dt, dt), bodies.solve(std::vector<Wrench<2>>(3, Wrench<2>::Zero()));
    const auto& [pose, velocity] = bodies.trials()[2];
    EXPECT_NEAR(velocity[1] * slope, 1, 1e-6);
    EXPECT_EQ(bodies.acceptable().ok(), slope > 0.05) << slope << ": " << bodies.acceptable().cause;
  }
}

TEST(Contact, only_pushes) {
  BodySpec<2> a = of_shape(box(1, 1), {0, 0}), b = of_shape(box(1, 1), {1, 0});
  b.velocity << 1, 0, 0;
  Bodies<2> bodies({a, b}, {}, {}, ContactSpec<2>{});
  run(bodies, 100);
  EXPECT_NEAR(bodies.state(0).velocity.norm(), 0, 1e-12);
  EXPECT_NEAR(bodies.state(1).velocity[0], 1, 1e-12);
}

TEST(Contact, lets_equal_boxes_slide_along_each_other) {
  // Their corners meet at t = 0: there a corner must not catch the other box's top.
  BodySpec<2> a = of_shape(box(1, 1), {0, 0}), b = of_shape(box(1, 1), {1, 0});
  a.velocity << 0, -1, 0;
  Bodies<2> bodies({a, b}, {}, {}, ContactSpec<2>{});
  run(bodies, 500);
  EXPECT_NEAR(bodies.state(0).velocity[1], -1, 1e-9);
  EXPECT_NEAR(bodies.state(1).velocity.norm(), 0, 1e-9);
}

TEST(Contact, is_smooth_a_box_slides_down_a_slope) {
  const double slope = 0.3;
  BodySpec<2> spec = of_shape(box(0.4, 0.2), {0, 0});
  spec.pose.rotate(-slope);
  const Vec<2> up(std::sin(slope), std::cos(slope)), down(std::cos(slope), -std::sin(slope));
  spec.pose.translation() = 0.1 * up;
  Bodies<2> bodies({spec}, pull<2>({0, -g}), {}, ContactSpec<2>{{{Vec<2>(0, 0), up}}});
  run(bodies, 1000);
  const Vec<2> way = bodies.state(0).pose.translation() - 0.1 * up;
  EXPECT_NEAR(way.dot(down), 0.5 * g * std::sin(slope), 1e-6);
  EXPECT_NEAR(way.dot(up), 0, 1e-9);
}

TEST(Contact, holds_a_stack) {
  std::vector<BodySpec<2>> stack;
  for (int i = 0; i < 5; ++i) stack.push_back(of_shape(box(1, 0.2), {0.03 * i, 0.1 + 0.2 * i}, i % 2 == 0 ? 1 : 1000));
  Bodies<2> bodies(stack, pull<2>({0, -g}), {}, floor_at_zero);
  run(bodies, 1000);
  for (std::size_t i = 0; i < stack.size(); ++i) {
    EXPECT_NEAR((bodies.state(i).pose.matrix() - stack[i].pose.matrix()).norm(), 0, 1e-7) << i;
    EXPECT_NEAR(bodies.state(i).velocity.norm(), 0, 1e-7) << i;
  }
}

TEST(Contact, rolls_a_leaning_box_over_its_corner) {
  // It falls on the face that its centre of mass hangs over, and lies there.
  BodySpec<2> spec = of_shape(box(0.4, 0.2), {0, 0.5});
  spec.pose.rotate(0.6);
  Bodies<2> bodies({spec}, pull<2>({0, -g}), {}, floor_at_zero);
  run(bodies, 3000);
  EXPECT_NEAR(angle(bodies.state(0).pose), 0, 1e-6);
  EXPECT_NEAR(bodies.state(0).pose.translation().y(), 0.1, 1e-6);
}

TEST(Contact, keeps_turned_boxes_apart_however_they_meet) {
  for (int k = 0; k < 40; ++k) {
    BodySpec<2> a = of_shape(box(0.3, 0.3), {0, 0}), b = of_shape(box(0.3, 0.3), {0.5, 0.01 * k - 0.2});
    a.pose.rotate(0.13 * k);
    b.pose.rotate(-0.37 * k);
    a.velocity << 0.5, 0, 0.1 * k;
    b.velocity << -0.5, 0, -0.07 * k;
    Bodies<2> bodies({a, b}, {}, {}, ContactSpec<2>{});
    for (int i = 0; i < 800; ++i) {
      run(bodies, 1);
      for (std::size_t one : {0u, 1u}) {
        const auto &mine = bodies.state(one).pose, &other = bodies.state(1 - one).pose;
        const Eigen::Matrix2Xd x = (mine.inverse() * other) * Eigen::Matrix2Xd(b.surface.vertices);
        // A corner that turns on a face leaves the tangent by v^2 dt^2 / (2 r) a step: 1e-6 m here.
        for (Eigen::Index v = 0; v < 4; ++v)
          EXPECT_GE(x.col(v).cwiseAbs().maxCoeff(), 0.15 - 1e-4) << "pair " << k << ", step " << i;
      }
    }
  }
}

TEST(Contact, of_bodies_apart_changes_no_bit) {
  BodySpec<2> a = of_shape(box(1, 1), {0, 0}), b = of_shape(circle(0.3), {3, 0});
  a.velocity << 0, 1, 2;
  const auto after = [&](std::optional<ContactSpec<2>> contacts) {
    Bodies<2> bodies({a, b}, pull<2>({0, -g}), {}, contacts);
    run(bodies, 50);
    return std::pair(bodies.state(0), bodies.state(1));
  };
  const auto with = after(ContactSpec<2>{}), without = after({});
  EXPECT_TRUE(identical(with.first, without.first));
  EXPECT_TRUE(identical(with.second, without.second));
}

TEST(Contact, a_concave_hull_takes_a_body_in) {
  const std::vector<Vec<2>> cup{{-1, 0}, {1, 0}, {1, 1}, {0.8, 1}, {0.8, 0.2}, {-0.8, 0.2}, {-0.8, 1}, {-1, 1}};
  BodySpec<2> holder = of_shape(polygon(cup), {0, 0});
  holder.motion = BodyMotion::fixed;
  holder.pose.translation().setZero();
  const double floor = (holder.surface.vertices.row(1).minCoeff() + 0.2);
  Bodies<2> bodies({holder, of_shape(circle(0.2), {0.55, 1})}, pull<2>({0, -g}), {}, ContactSpec<2>{});
  run(bodies, 1500);
  EXPECT_NEAR(bodies.state(1).pose.translation().y(), floor + 0.2, 1e-4);
  EXPECT_NEAR(bodies.state(1).velocity.head<2>().norm(), 0, 1e-6);
}

}  // namespace
}  // namespace splashdown::rigid::contacts_test
