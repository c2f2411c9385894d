#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::motion_test {

TEST(HeldFreedoms, do_not_move) {
  for (std::size_t held = 0; held < 6; ++held) {
    BodySpec<3> spec = skew_body();
    spec.free[held] = false;
    const auto axis = static_cast<Eigen::Index>(held);
    Bodies<3> bodies = alone(spec);
    for (int i = 0; i < 200; ++i) {
      step<3>(bodies, 1e-2, 1e-2, Wrench<3>(Wrench<3>::Constant(3 + std::sin(i))));
      ASSERT_EQ(bodies.state(0).velocity(axis), 0);
      if (axis < 3) {
        ASSERT_EQ(bodies.state(0).pose.translation()(axis), 0);
      }
    }
  }
}

TEST(HeldFreedoms, keep_the_velocity_they_started_with) {
  BodySpec<2> spec = planar_body();
  spec.free = {false, true, false};
  spec.velocity << 1.5, 0, 0.25;
  Bodies<2> bodies = alone(spec);
  for (int i = 0; i < 100; ++i) step<2>(bodies, 1e-2, 1e-2, Wrench<2>(10, 20, 30));
  EXPECT_EQ(bodies.state(0).velocity(0), 1.5);
  EXPECT_EQ(bodies.state(0).velocity(2), 0.25);
  EXPECT_NEAR(bodies.state(0).pose.translation().x(), 1.5, 100 * eps);
}

TEST(HeldFreedoms, leave_one_free_axis_the_spin_of_its_own_moment) {
  // A skew body on a fixed axle: the moment about the axle is constant, the bearings take the rest.
  BodySpec<3> spec = skew_body();
  spec.free = {false, false, false, false, false, true};
  spec.velocity(5) = 2;
  Bodies<3> bodies = alone(spec);
  const double dt = 1e-2;
  for (int i = 0; i < 300; ++i) step<3>(bodies, i == 0 ? dt / 2 : dt, dt, Wrench<3>(Wrench<3>::Ones()));
  EXPECT_NEAR(bodies.state(0).velocity(5), 2 + (300 - 0.5) * dt / spec.inertia(2, 2), 1e-12);
  EXPECT_EQ(bodies.state(0).velocity(3), 0);
  EXPECT_EQ(bodies.state(0).velocity(4), 0);
}

TEST(PlanarBodies, stay_in_their_plane_as_rotations) {
  BodySpec<2> spec = planar_body();
  spec.velocity << 1, 2, 3;
  Bodies<2> bodies = alone(spec);
  for (int i = 0; i < 10000; ++i) step<2>(bodies, 1e-2, 1e-2, Wrench<2>(1, 2, std::sin(i)));
  EXPECT_TRUE(bodies.state(0).pose.linear().isUnitary(10 * eps));
}

TEST(SlowBodies, do_not_fall_asleep) {
  // Bullet's own thresholds are 0.8 m/s and 1 rad/s for 2 s.
  BodySpec<2> spec = planar_body();
  spec.velocity << 1e-6, 0, 1e-6;
  Bodies<2> bodies = alone(spec);
  for (int i = 0; i < 1000; ++i) step(bodies, 0.1, 0.1);
  EXPECT_NEAR(bodies.state(0).pose.translation().x(), 1e-4, 1e-17);
  EXPECT_NEAR(angle(bodies.state(0).pose), 1e-4, 1000 * eps);
  for (int i = 0; i < 10; ++i) step<2>(bodies, 0.1, 0.1, Wrench<2>(3, 0, 0));
  EXPECT_NEAR(bodies.state(0).velocity(0), 1 + 1e-6, 10 * eps);
}

TEST(FixedBodies, stay_whatever_pushes_them) {
  BodySpec<2> spec = planar_body();
  spec.motion = BodyMotion::fixed;
  spec.velocity << 1, 2, 3;
  Bodies<2> bodies = alone(spec);
  for (int i = 0; i < 10; ++i) step<2>(bodies, 0.1, 0.1, Wrench<2>(1e3, 1e3, 1e3));
  EXPECT_TRUE(identical(bodies.state(0), {Isometry<2>::Identity(), Twist<2>::Zero()}));
}

TEST(PrescribedBodies, follow_their_path_with_the_velocity_that_does) {
  BodySpec<3> spec = skew_body();
  spec.motion = BodyMotion::prescribed;
  const Eigen::Vector3d w(0.3, -0.8, 0.5), v(1, 2, 3);
  spec.path = [&](double t) {
    Isometry<3> pose = Isometry<3>::Identity();
    pose.linear() = Eigen::AngleAxisd(w.norm() * t, w.normalized()).toRotationMatrix();
    pose.translation() = v * t;
    return pose;
  };
  Bodies<3> bodies = alone(spec);
  for (int i = 1; i <= 50; ++i) {
    step<3>(bodies, 0.02, 0.02, Wrench<3>(Wrench<3>::Ones()));
    EXPECT_EQ(bodies.state(0).pose.matrix(), spec.path(bodies.time()).matrix());
    // Differences of numbers of size 1 and 3 over dt.
    EXPECT_NEAR((bodies.state(0).velocity.head<3>() - v).norm(), 0, 10 * eps / 0.02);
    EXPECT_NEAR((bodies.state(0).velocity.tail<3>() - w).norm(), 0, 10 * eps / 0.02);
  }
}

TEST(PrescribedBodies, are_fast_or_slow_at_second_order) {
  BodySpec<2> spec = planar_body();
  spec.motion = BodyMotion::prescribed;
  spec.path = [](double t) { return Isometry<2>(Eigen::Rotation2Dd(std::sin(t))); };
  Bodies<2> bodies = alone(spec);
  const double dt = 1e-2;
  for (int i = 0; i < 100; ++i) step(bodies, dt, dt);
  EXPECT_NEAR(bodies.state(0).velocity(2), std::cos(1 - dt / 2), dt * dt / 24);
}

TEST(SeveralBodies, do_not_know_of_each_other) {
  BodySpec<2> a = planar_body(), b = planar_body();
  a.velocity << 1, 0, 2;
  b.velocity << -1, 0, -30;
  Bodies<2> both({a, b}, {}), single({a}, {});
  for (int i = 0; i < 100; ++i) {
    both.begin(0.1, 0.1);
    both.solve(std::vector<Wrench<2>>{Wrench<2>(0, 1, 0), Wrench<2>(0, -1, 5)});
    both.commit();
    step<2>(single, 0.1, 0.1, Wrench<2>(0, 1, 0));
  }
  EXPECT_TRUE(identical(both.state(0), single.state(0)));
}

}  // namespace splashdown::rigid::motion_test
