// Laws of friction on hulls on a block of fluid, without pressure.
#include "fluid/effects/skin_friction/skin_friction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "block_of_fluid.hpp"

namespace splashdown::fluid::skin_friction_test {
namespace {

using testing::Block;
constexpr double roundoff = 1e-12;  // sums over some hundred facets

// 0.8 m of plate in each direction along it; the flow's momentum thickness is far below half an element.
template <int d>
Block<d> over_a_plate(const Twist<d>& plate = Twist<d>::Zero()) {
  Block<d> fluid(Block<d>::Lattice::Constant(8), 0.1, 0.15);
  fluid.add_floor(d - 1, plate);
  return fluid;
}

template <int d>
SkinFriction<d> friction(FrictionLine line = FrictionLine::ittc1957, std::size_t hulls = 1) {
  return SkinFriction<d>({.line = line, .dynamic_viscosity = 1e-3, .hulls = hulls});
}

template <int d>
Vec<d> waves(const Vec<d>& x) {
  return (7 * x).array().sin() + x.prod();
}

template <int d>
Twist<d> some_motion() {
  Twist<d> s;
  for (int k = 0; k < freedoms<d>; ++k) s[k] = 0.4 - 0.3 * k;
  return s;
}

// waves_and_effects: ITTC's own values; Blasius.
TEST(FrictionLine, has_its_published_values) {
  const auto ittc = FrictionLine::ittc1957;
  EXPECT_NEAR(friction_coefficient(ittc, 1e6), 4.6875e-3, 5e-8);
  EXPECT_NEAR(friction_coefficient(ittc, 1e7), 3e-3, 5e-8);
  EXPECT_NEAR(friction_coefficient(ittc, 1e9), 1.5306e-3, 5e-8);
  EXPECT_NEAR(friction_coefficient(FrictionLine::flat_plate, 1e4), 0.0132823, 1e-9);
  EXPECT_NEAR(friction_coefficient(FrictionLine::flat_plate, 5e6), 0.074 * std::pow(5e6, -0.2) - 1742 / 5e6, 1e-9);
}

// Lines in three digits meet to their last one. The turbulent line takes over until Re = (5 * 1742 / 0.074)^(5/4) = 2.2e6.
TEST(FrictionLine, is_continuous_and_falls) {
  for (const auto line : {FrictionLine::ittc1957, FrictionLine::flat_plate})
    for (double re = 1; re < 1e10; re *= 1.01) {
      const double here = friction_coefficient(line, re), next = friction_coefficient(line, 1.000001 * re);
      EXPECT_NEAR(next / here, 1, 2e-3) << re;
      const bool in_transition = line == FrictionLine::flat_plate && re > 4.9e5 && re < 2.2e6;
      EXPECT_TRUE(in_transition || next < here) << re;
    }
}

template <class Dimension>
class SkinFrictionIn : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(SkinFrictionIn, Dimensions);

TYPED_TEST(SkinFrictionIn, uniform_flow_past_a_plate_has_the_force_of_the_line) {
  constexpr int d = TypeParam::value;
  for (const auto line : {FrictionLine::ittc1957, FrictionLine::flat_plate})
    for (const double speed : {0.01, 1.5, 40.0}) {
      auto fluid = over_a_plate<d>();
      fluid.set_velocity([&](const Vec<d>&) -> Vec<d> { return speed * Vec<d>::UnitX(); });
      auto effect = friction<d>(line);
      std::vector<Wrench<d>> impulses;
      fluid.predict(effect, &impulses);
      const double length = 0.8, area = std::pow(length, d - 1);
      const double force = 500 * friction_coefficient(line, speed * length / 1e-6) * area * speed * speed;
      const Vec<d> exact = force * Vec<d>::UnitX(), found = impulses[0].template head<d>() / fluid.kick;
      EXPECT_LT((found - exact).norm(), roundoff * force) << speed;
      EXPECT_NEAR(effect.diagnostics(fluid.nodes, {})[1].second, force, roundoff * force);
    }
}

TYPED_TEST(SkinFrictionIn, what_counts_is_the_velocity_past_the_hull) {
  constexpr int d = TypeParam::value;
  const Twist<d> along = 3 * Twist<d>::Unit(0);
  auto fluid = over_a_plate<d>(along), still = over_a_plate<d>();
  fluid.set_velocity([&](const Vec<d>& x) -> Vec<d> { return waves<d>(x) + 3 * Vec<d>::UnitX(); });
  still.set_velocity(waves<d>);
  auto effect = friction<d>();
  std::vector<Wrench<d>> moving, resting;
  fluid.predict(effect, &moving), still.predict(effect, &resting);
  EXPECT_LT((moving[0] - resting[0]).norm(), roundoff * resting[0].norm());
}

TYPED_TEST(SkinFrictionIn, water_that_goes_with_the_hull_has_hardly_any) {
  constexpr int d = TypeParam::value;
  auto fluid = over_a_plate<d>(some_motion<d>());
  fluid.set_velocity([](const Vec<d>& x) { return rigid_velocity<d>(some_motion<d>(), x); });
  auto effect = friction<d>();
  std::vector<Wrench<d>> impulses;
  fluid.predict(effect, &impulses);
  // Nodes off the hull are seen against the hull's velocity at the facet.
  auto faster = over_a_plate<d>();
  faster.set_velocity([](const Vec<d>&) -> Vec<d> { return Vec<d>::UnitX(); });
  std::vector<Wrench<d>> of_one;
  faster.predict(effect, &of_one);
  EXPECT_LT(impulses[0].norm(), 0.1 * of_one[0].norm());
}

TYPED_TEST(SkinFrictionIn, water_and_hull_keep_momentum_and_its_moment) {
  constexpr int d = TypeParam::value;
  auto fluid = over_a_plate<d>(some_motion<d>());
  fluid.set_velocity(waves<d>);
  auto effect = friction<d>();
  for (const double kick : {1e-3, 1.0, 1e4}) {
    fluid.kick = kick;
    std::vector<Wrench<d>> impulses;
    const auto v = fluid.predict(effect, &impulses);
    const Wrench<d> before = fluid.momentum(fluid.nodes.v), change = fluid.momentum(v) - before;
    EXPECT_LT((change + impulses[0]).norm(), roundoff * before.norm()) << kick;
  }
}

TYPED_TEST(SkinFrictionIn, takes_energy_at_any_kick_and_says_how_much) {
  constexpr int d = TypeParam::value;
  auto fluid = over_a_plate<d>(some_motion<d>());
  fluid.set_velocity(waves<d>);
  auto effect = friction<d>();
  const double before = fluid.kinetic_energy(fluid.nodes.v);
  for (const double kick : {1e-4, 1e-2, 1.0, 1e4}) {
    fluid.kick = kick;
    std::vector<Wrench<d>> impulses;
    const auto v = fluid.predict(effect, &impulses);
    const double gain = fluid.kinetic_energy(v) - before + impulses[0].dot(some_motion<d>());
    EXPECT_LT(gain, 0) << kick;
    EXPECT_NEAR(effect.diagnostics(fluid.nodes, {})[0].second * kick, gain, 1e-9 * before) << kick;
  }
}

TYPED_TEST(SkinFrictionIn, turns_with_water_and_hull) {
  constexpr int d = TypeParam::value;
  auto fluid = over_a_plate<d>(some_motion<d>());
  fluid.set_velocity(waves<d>);
  auto effect = friction<d>();
  std::vector<Wrench<d>> straight, turned;
  fluid.predict(effect, &straight);
  Mat<d> turn;
  if constexpr (d == 2)
    turn = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  else
    turn = Eigen::AngleAxisd(0.7, Vec<3>(1, -2, 0.5).normalized()).toRotationMatrix();
  for (auto* field : {&fluid.nodes.x, &fluid.nodes.v})
    for (auto& x : *field) x = turn * x;
  const auto rotated = [&](const Wrench<d>& w) {
    Wrench<d> out = w;
    out.template head<d>() = turn * w.template head<d>();
    if constexpr (d == 3) out.template tail<3>() = turn * w.template tail<3>();
    return out;
  };
  fluid.wall_velocities[0] = rotated(fluid.wall_velocities[0]);
  fluid.predict(effect, &turned);
  EXPECT_LT((turned[0] - rotated(straight[0])).norm(), 10 * roundoff * straight[0].norm());
}

TYPED_TEST(SkinFrictionIn, no_node_is_driven_against_the_hull) {
  constexpr int d = TypeParam::value;
  auto fluid = over_a_plate<d>();
  fluid.set_velocity([](const Vec<d>&) -> Vec<d> { return 5 * Vec<d>::UnitX(); });
  auto effect = friction<d>();
  for (const double kick : {0.1, 10.0, 1e5}) {
    fluid.kick = kick;
    for (const auto& v : fluid.predict(effect)) EXPECT_GE(v.x(), -roundoff) << kick;
  }
}

TEST(SkinFriction, walls_that_are_no_hulls_have_none) {
  auto fluid = over_a_plate<2>();
  fluid.set_velocity([](const Vec<2>&) { return Vec<2>(5, 0); });
  auto effect = friction<2>(FrictionLine::ittc1957, 0);
  std::vector<Wrench<2>> impulses;
  EXPECT_EQ(fluid.predict(effect, &impulses), fluid.nodes.v);
  EXPECT_EQ(impulses[0], Wrench<2>::Zero());
}

// A plate that is next to nothing goes with the water, one of some weight feels the whole friction.
TEST(SkinFriction, brings_no_body_beyond_the_water) {
  const double speed = 5;
  auto full = 0.0;
  for (const double mass : {1e3, 1e-1, 1e-6}) {
    auto fluid = over_a_plate<2>();
    fluid.set_velocity([&](const Vec<2>&) { return Vec<2>(speed, 0); });
    fluid.kick = 0.01;
    ModalInertia body{Eigen::MatrixXd::Zero(3, 1), Eigen::MatrixXd::Constant(1, 1, mass)};
    body.modes(0, 0) = 1;
    fluid.answers = &body;
    auto effect = friction<2>();
    std::vector<Wrench<2>> impulses;
    fluid.predict(effect, &impulses);
    if (full == 0) full = impulses[0][0];
    EXPECT_NEAR(impulses[0][0], std::min(full, mass * speed), 1e-9 * full) << mass;
  }
}

}  // namespace
}  // namespace splashdown::fluid::skin_friction_test
