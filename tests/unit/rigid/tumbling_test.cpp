#include <gtest/gtest.h>

#include "tests/unit/rigid/scenes.hpp"

namespace splashdown::rigid::tumbling_test {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d turned(const Vector3d& v) { return Eigen::AngleAxisd(v.norm(), v.normalized()).toRotationMatrix(); }

struct Spin {
  double energy;
  Vector3d momentum;
};

/// At t_{n+1/2}, from the pose at t_{n+1} that the half-step velocity led to.
Spin spin(const BodyState<3>& state, const Matrix3d& inertia, double dt) {
  const Vector3d w = state.velocity.tail<3>();
  const Matrix3d r = turned(-dt / 2 * w) * state.pose.linear();
  const Vector3d l = r * inertia * r.transpose() * w;
  return {w.dot(l) / 2, l};
}

/// Pose after the time 1 of a body that spins and is turned by a torque fixed to it.
Isometry<3> driven(int n) {
  BodySpec<3> spec = skew_body();
  spec.velocity.tail<3>() << 1, -2, 1.5;
  Bodies<3> bodies = alone(spec);
  const double dt = 1. / n;
  for (int i = 0; i < n; ++i) {
    Wrench<3> load = Wrench<3>::Zero();
    load.tail<3>() = bodies.state(0).pose.linear() * Vector3d(3, 1, -2);
    step<3>(bodies, i == 0 ? dt / 2 : dt, dt, load);
  }
  return bodies.state(0).pose;
}

}  // namespace

TEST(Tumbling, keeps_energy_and_angular_momentum) {
  BodySpec<3> spec = skew_body();
  spec.velocity.tail<3>() << 0.1, 2, 0.2;  // near the unstable axis
  Bodies<3> bodies = alone(spec);
  const double dt = 1e-3;
  step(bodies, dt / 2, dt);
  const Spin start = spin(bodies.state(0), spec.inertia, dt);
  double energy_drift = 0, momentum_drift = 0;
  for (int i = 1; i < 10000; ++i) {
    step(bodies, dt, dt);
    const Spin now = spin(bodies.state(0), spec.inertia, dt);
    energy_drift = std::max(energy_drift, std::abs(now.energy / start.energy - 1));
    momentum_drift = std::max(momentum_drift, (now.momentum - start.momentum).norm() / start.momentum.norm());
  }
  EXPECT_LT(energy_drift, 1e-6);
  EXPECT_LT(momentum_drift, 10000 * 10 * eps);
}

TEST(Tumbling, keeps_energy_in_the_mean_at_large_steps) {
  BodySpec<3> spec = skew_body();
  spec.velocity.tail<3>() << 0.1, 2, 0.2;
  Bodies<3> bodies = alone(spec);
  const double dt = 0.1;
  step(bodies, dt / 2, dt);
  const auto mean_energy = [&] {
    double sum = 0;
    for (int i = 0; i < 1000; ++i) {
      step(bodies, dt, dt);
      sum += spin(bodies.state(0), spec.inertia, dt).energy / 1000;
    }
    return sum;
  };
  const double first = mean_energy();
  for (int i = 0; i < 9; ++i) mean_energy();
  // (w dt)^2 / 12 = 0.3 % is the size of the reversible oscillation; a drift would add up over 2000 rad.
  EXPECT_NEAR(mean_energy() / first, 1, 1e-3);
}

TEST(Tumbling, is_reversible) {
  BodySpec<3> spec = skew_body();
  spec.velocity.tail<3>() << 0.3, 1.2, -0.5;
  Bodies<3> there = alone(spec);
  const double dt = 0.05;
  for (int i = 0; i < 50; ++i) step(there, i == 0 ? dt / 2 : dt, dt);
  // Back from there with the angular momentum reversed: the start's convention is w at t_0, with J(R_0).
  const Spin last = spin(there.state(0), spec.inertia, dt);
  BodySpec<3> reversed = spec;
  reversed.pose = there.state(0).pose;
  const Matrix3d& r = reversed.pose.linear();
  reversed.velocity.tail<3>() = -(r * spec.inertia * r.transpose()).inverse() * last.momentum;
  Bodies<3> back = alone(reversed);
  for (int i = 0; i < 50; ++i) step(back, i == 0 ? dt / 2 : dt, dt);
  EXPECT_NEAR((back.state(0).pose.linear() - spec.pose.linear()).norm(), 0, 1e-12);
}

TEST(Tumbling, about_a_principal_axis_of_a_skew_body_is_steady) {
  BodySpec<3> spec = skew_body();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(spec.inertia);
  const Vector3d w = 3 * principal.eigenvectors().col(2);
  spec.velocity.tail<3>() = w;
  Bodies<3> bodies = alone(spec);
  for (int i = 0; i < 1000; ++i) step(bodies, 1e-2, 1e-2);
  EXPECT_NEAR((bodies.state(0).velocity.tail<3>() - w).norm(), 0, 1e-11);
  EXPECT_NEAR((bodies.state(0).pose.linear() - turned(10 * w)).norm(), 0, 1e-11);
}

TEST(Tumbling, under_torque_is_second_order) {
  const Matrix3d exact = driven(8192).linear();
  const double coarse = (driven(64).linear() - exact).norm();
  const double fine = (driven(128).linear() - exact).norm();
  EXPECT_GT(std::log2(coarse / fine), 1.8);
  EXPECT_LT(fine, 1e-3);
}

TEST(Tumbling, does_not_depend_on_the_frame) {
  const Matrix3d q = turned(Vector3d(0.4, -1.1, 0.8));
  BodySpec<3> spec = skew_body();
  spec.velocity << 1, 2, 3, 0.7, 1.8, -0.3;
  BodySpec<3> other = spec;
  other.pose.linear() = q;
  other.velocity << q * spec.velocity.head<3>(), q * spec.velocity.tail<3>();
  Bodies<3> a = alone(spec), b = alone(other);
  Wrench<3> load, turned_load;
  load << 1, -2, 0.5, 0.3, 0.1, -0.8;
  turned_load << q * load.head<3>(), q * load.tail<3>();
  for (int i = 0; i < 100; ++i) {
    step<3>(a, 1e-2, 1e-2, load);
    step<3>(b, 1e-2, 1e-2, turned_load);
  }
  EXPECT_NEAR((b.state(0).pose.matrix() - (Isometry<3>(q) * a.state(0).pose).matrix()).norm(), 0, 1e-12);
}

TEST(Tumbling, at_an_absurd_step_stays_finite_and_keeps_its_momentum) {
  BodySpec<3> spec = skew_body();
  spec.velocity.tail<3>() << 10, 200, 30;
  Bodies<3> bodies = alone(spec);
  for (int i = 0; i < 100; ++i) step(bodies, 0.1, 0.1);
  EXPECT_TRUE(bodies.state(0).pose.matrix().allFinite());
  EXPECT_TRUE(bodies.state(0).pose.linear().isUnitary(1e-12));
  EXPECT_LT(bodies.state(0).velocity.tail<3>().norm(), 2.6 * 210);
}

}  // namespace splashdown::rigid::tumbling_test
