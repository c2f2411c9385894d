#include "fluid/pfem/water/collision_bound.hpp"

#include <gtest/gtest.h>

#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::collision_bound_test {
namespace {

template <class D>
class CollisionBound : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(CollisionBound, Dimensions);

constexpr double speed = 10, cfl = 0.5, never = 1e3;

/// Free water that flies along the last axis, its surface `gap` away from a wall there.
template <int d>
struct Flight {
  scenes::Lattice<d> water{4};
  std::vector<Wall<d>> walls;
  std::vector<WallPlace<d>> poses{Isometry<d>::Identity()};
  std::vector<WallVelocity<d>> velocity{Twist<d>::Zero()};

  explicit Flight(double gap) {
    water.nodes.h.assign(water.nodes.size(), 0.25);
    for (auto& v : water.nodes.v) v = speed * Vec<d>::Unit(d - 1);
    const Vec<d> size = Vec<d>::Constant(2);
    Surface<d> block;
    if constexpr (d == 2)
      block = scenes::rectangle(-size, size);
    else
      block = scenes::block(-size, size);
    walls.emplace_back(WallSpec<d>{"target", block, Isometry<d>::Identity(), Twist<d>::Zero(), 0.25});
    Isometry<d> pose = Isometry<d>::Identity();
    pose.translation().setConstant(0.5);
    pose.translation()[d - 1] = 1 + gap + size[d - 1];
    poses[0] = pose;
  }
  double dt(double longest) const {
    return collision_dt<d>(water.nodes, water.mesh, {walls, poses}, velocity, cfl, longest);
  }
};

TYPED_TEST(CollisionBound, half_of_the_way_to_a_wall_and_no_less_than_a_share_of_an_element) {
  constexpr int d = TypeParam::value;
  EXPECT_NEAR(Flight<d>(3).dt(never), 1.5 / speed, 1e-12);
  EXPECT_NEAR(Flight<d>(0.01).dt(never), cfl * 0.25 / speed, 1e-12);
}

TYPED_TEST(CollisionBound, short_steps_and_walls_that_fly_along_are_no_bound) {
  constexpr int d = TypeParam::value;
  EXPECT_EQ(Flight<d>(0.01).dt(0.02), 0.02);  // less than an element
  Flight<d> together(0.01);
  together.velocity[0].rigid[d - 1] = speed;
  EXPECT_EQ(together.dt(never), never);
}

TYPED_TEST(CollisionBound, other_water_counts_like_a_wall) {
  constexpr int d = TypeParam::value;
  Flight<d> flight(100);
  auto& water = flight.water;
  const scenes::Lattice<d> pool(4);
  const auto first = static_cast<int>(water.nodes.size());
  for (std::size_t i = 0; i < pool.nodes.size(); ++i) {
    // Upside down: its free surface faces what comes.
    Vec<d> x = pool.nodes.x[i];
    x[d - 1] = 3 - x[d - 1];
    water.nodes.add(x, Vec<d>::Zero(), 0, pool.nodes.tie[i], pool.nodes.surface[i], 0.25);
  }
  for (auto cell : pool.mesh.cells) {
    for (int& n : cell) n += first;
    water.mesh.cells.push_back(cell);
  }
  for (auto facet : pool.mesh.boundary) {
    for (int& n : facet.nodes) n += first;
    water.mesh.boundary.push_back(facet);
  }
  EXPECT_NEAR(flight.dt(never), 0.5 / speed, 1e-12);
}

/// Water between two walls, of which one comes nearer with the water behind it.
template <int d>
struct Gap {
  scenes::Lattice<d> water{4};

  explicit Gap(double thickness) {
    water.nodes.h.assign(water.nodes.size(), 0.25);
    for (std::size_t i = 0; i < water.nodes.size(); ++i) {
      double& height = water.nodes.x[i][d - 1];
      const bool below = height < 0.1, above = !below && height < 0.4;
      water.nodes.tie[i].wall = below ? 0 : above ? 1 : -1;
      if (above) height = thickness;
      water.nodes.v[i] = below ? Vec<d>::Zero() : Vec<d>(-speed * Vec<d>::Unit(d - 1));
    }
  }
  double time() const {
    WallSpec<d> any;
    if constexpr (d == 2)
      any.surface = scenes::rectangle({0, 0}, {1, 1});
    else
      any.surface = scenes::block({0, 0, 0}, {1, 1, 1});
    const std::vector<Wall<d>> walls{Wall<d>(any), Wall<d>(any)};
    const std::vector<WallPlace<d>> poses(2, Isometry<d>::Identity());
    return gap_time<d>(water.nodes, water.mesh, {walls, poses});
  }
};

TYPED_TEST(CollisionBound, a_gap_between_walls_has_the_time_until_it_is_closed) {
  constexpr int d = TypeParam::value;
  EXPECT_NEAR(Gap<d>(0.1).time(), 0.1 / speed, 1e-12);
  EXPECT_NEAR(Gap<d>(0.05).time(), 0.05 / speed, 1e-12);
  EXPECT_GT(Gap<d>(1e-9).time(), 1e-3 * 0.25 / speed) << "gaps end";
}

TYPED_TEST(CollisionBound, gaps_that_open_and_water_at_one_wall_are_no_bound) {
  constexpr int d = TypeParam::value;
  Gap<d> opens(0.1);
  for (auto& v : opens.water.nodes.v) v = -v;
  EXPECT_GT(opens.time(), never);
  Gap<d> of_one(0.1);
  for (auto& tie : of_one.water.nodes.tie)
    if (tie.wall == 1) tie.wall = -1;
  EXPECT_GT(of_one.time(), never);
}

}  // namespace
}  // namespace splashdown::fluid::collision_bound_test
