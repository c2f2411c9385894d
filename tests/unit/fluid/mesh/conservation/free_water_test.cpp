#include "fluid/pfem/mesh/conservation/free_water.hpp"

#include <gtest/gtest.h>

#include "fluid/pfem/mesh/recognition/recognise.hpp"
#include "tests/unit/fluid/contact/contact.hpp"

namespace splashdown::fluid::free_water_test {
namespace {

template <class D>
class FreeWaters : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(FreeWaters, Dimensions);

/// A block in uneven motion, whose nodes have carried other volumes than its cells have now.
template <int d>
struct Block : scenes::Lattice<d> {
  std::vector<double> now;

  Block() : scenes::Lattice<d>(4) {
    auto& at = this->nodes;
    at.tie.assign(at.size(), {});
    now = nodal_volumes(this->mesh, at.x);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double phase = static_cast<double>(i);
      at.volume[i] = now[i] * (1 + 0.5 * std::sin(3 * phase));
      for (int k = 0; k < d; ++k) at.v[i][k] = 10 + std::cos(phase + k);
    }
  }

  VelocityMoments<d> sum(const std::vector<double>& volumes) const {
    VelocityMoments<d> sum;
    for (std::size_t i = 0; i < volumes.size(); ++i) sum += VelocityMoments<d>::of(volumes[i], this->nodes.v[i]);
    return sum;
  }
};

TYPED_TEST(FreeWaters, has_its_momentum_back_whatever_its_volumes_are_now) {
  constexpr int d = TypeParam::value;
  Block<d> block;
  const auto carried = block.sum(block.nodes.volume);
  const FreeWater<d> free(block.mesh, block.nodes, {});
  free.give_back(free.moments(block.nodes.volume, block.nodes.v), block.now, block.nodes.v);
  const auto has = block.sum(block.now);
  EXPECT_LT((has.momentum - carried.momentum).norm(), 1e3 * scenes::eps * carried.momentum.norm());
  EXPECT_LE(has.inner_energy(), carried.inner_energy() * (1 + 1e3 * scenes::eps));
}

TYPED_TEST(FreeWaters, gains_no_energy_where_fast_nodes_grow) {
  constexpr int d = TypeParam::value;
  Block<d> block;
  for (std::size_t i = 0; i < block.nodes.size(); ++i) {
    const bool fast = block.nodes.v[i][0] > 10.5;
    block.nodes.volume[i] = block.now[i] * (fast ? 0.2 : 1.0);
  }
  const auto carried = block.sum(block.nodes.volume);
  ASSERT_GT(block.sum(block.now).inner_energy(), carried.inner_energy());
  const FreeWater<d> free(block.mesh, block.nodes, {});
  free.give_back(free.moments(block.nodes.volume, block.nodes.v), block.now, block.nodes.v);
  const double energy = carried.inner_energy();
  // Cancellation: the energy of the mean motion is a hundred times as large.
  EXPECT_NEAR(block.sum(block.now).inner_energy(), energy, 1e6 * scenes::eps * energy);
}

// One part has lost what others have gained: it comes with the velocity that it had.
TYPED_TEST(FreeWaters, volume_that_changes_parts_takes_its_momentum_along) {
  constexpr int d = TypeParam::value;
  Nodes<d> nodes;
  Mesh<d> mesh;
  std::vector<double> now;
  for (int part = 0; part < 3; ++part) {
    std::array<int, d + 1> cell;
    for (int k = 0; k <= d; ++k) {
      cell[k] = static_cast<int>(nodes.size());
      Vec<d> x = Vec<d>::Constant(2 * part);
      if (k < d) x[k] += 1;
      nodes.add(x, Vec<d>::Constant(part == 0 ? 5 : -5 - part), 0, {}, true);
      nodes.volume.back() = part == 0 ? 1.0 : 0.5;
      now.push_back(part == 0 ? 0.9 : 0.55);
    }
    mesh.cells.push_back(cell);
  }
  const auto sum = [&](const std::vector<double>& volumes) {
    VelocityMoments<d> all;
    for (std::size_t i = 0; i < nodes.size(); ++i) all += VelocityMoments<d>::of(volumes[i], nodes.v[i]);
    return all;
  };
  const auto before = sum(nodes.volume);
  const FreeWater<d> water(mesh, nodes, {});
  water.give_back(water.moments(nodes.volume, nodes.v), now, nodes.v);
  const auto after = sum(now);
  EXPECT_LT((after.momentum - before.momentum).norm(), 100 * scenes::eps * before.momentum.norm());
  EXPECT_LT(after.energy, before.energy);
  EXPECT_NEAR(nodes.v[0][0], 5, 100 * scenes::eps);
  EXPECT_NEAR(nodes.v[d + 1][0], (0.5 * -6 + 0.05 * 5) / 0.55, 100 * scenes::eps);
}

TYPED_TEST(FreeWaters, counts_what_nodes_have_inherited) {
  constexpr int d = TypeParam::value;
  Block<d> block;
  Nodes<d>& nodes = block.nodes;
  const auto carried = block.sum(nodes.volume);
  nodes.bequeath(0, 1);
  EXPECT_EQ(nodes.volume[0], 0);
  const FreeWater<d> free(block.mesh, nodes, {});
  const auto moments = free.moments(nodes.volume, nodes.v, nodes.inherited);
  const auto& all = moments[free.part()[0]];
  EXPECT_NEAR(all.volume, carried.volume, 1e3 * scenes::eps * carried.volume);
  EXPECT_LT((all.momentum - carried.momentum).norm(), 1e3 * scenes::eps * carried.momentum.norm());
  EXPECT_NEAR(all.energy, carried.energy, 1e3 * scenes::eps * carried.energy);
}

/// A plate on which the block stands, and one beside it, turned and away from the origin.
template <int d>
scenes::Walls<d> plates() {
  scenes::Walls<d> walls;
  const Isometry<d> at = scenes::elsewhere<d>();
  const Vec<d> origin = at.translation();
  walls.add_wall(scenes::box<d>(scenes::point<d>(-9, -1) - origin, scenes::point<d>(9, 0) - origin), at);
  Vec<d> far = Vec<d>::Constant(9);
  far[0] = 0;
  walls.add_wall(scenes::box<d>(Vec<d>::Constant(-9), far));
  return walls;
}

TYPED_TEST(FreeWaters, keeps_its_momentum_along_flat_walls_and_gives_the_rest_to_them) {
  constexpr int d = TypeParam::value;
  const auto walls = plates<d>();
  for (const int touched : {1, 2}) {
    Block<d> block;
    auto& nodes = block.nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      // Of a node at both the second one.
      for (int w = 0; w < touched; ++w)
        if (nodes.x[i][w == 0 ? d - 1 : 0] == 0) {
          Vec<d> beside = nodes.x[i];
          beside[w == 0 ? 0 : d - 1] += 0.5;
          nodes.tie[i] = scenes::tie_at<d>(walls.walls[w], walls.pose[w], beside, w);
        }
    }
    const auto carried = block.sum(nodes.volume);
    const auto v = nodes.v;
    const FreeWater<d> water(block.mesh, nodes, walls.at());
    EXPECT_FALSE(water.has(0));
    water.give_back(water.moments(nodes.volume, nodes.v), block.now, nodes.v);
    const Vec<d> change = nodes.v[0] - v[0];
    EXPECT_NEAR(change[d - 1], 0, 100 * scenes::eps);
    for (std::size_t i = 0; i < v.size(); ++i)
      EXPECT_LE((nodes.v[i] - v[i] - change).norm(), 100 * scenes::eps) << "strains nothing";
    // Where no plate pushes none of it is missing, elsewhere nothing is changed.
    const Vec<d> missing = block.sum(block.now).momentum - carried.momentum;
    for (int k = 0; k + 1 < d; ++k) {
      const bool is_kept = k > 0 || touched == 1;
      if (is_kept)
        EXPECT_NEAR(missing[k], 0, 1e3 * scenes::eps * carried.momentum.norm()) << k;
      else
        EXPECT_NEAR(change[k], 0, 100 * scenes::eps);
    }
    EXPECT_EQ(change.isZero(), d == 2 && touched == 2);
  }
}

TYPED_TEST(FreeWaters, keeps_nothing_at_edges_and_curved_walls) {
  constexpr int d = TypeParam::value;
  auto walls = plates<d>();
  if constexpr (d == 2)
    walls.add_wall(scenes::ellipse(1, 1, 64));
  else
    walls.add_wall(scenes::cone(1, 1, 64));
  const WallTie edge{0, -1, 0};
  const WallTie curved = scenes::tie_at<d>(walls.walls[2], walls.pose[2], scenes::point<d>(0.4, 0.5), 2);
  ASSERT_GE(curved.patch, 0);
  for (const WallTie& tie : {edge, curved}) {
    Block<d> block;
    block.nodes.tie[3] = tie;
    const auto v = block.nodes.v;
    const FreeWater<d> water(block.mesh, block.nodes, walls.at());
    water.give_back(water.moments(block.nodes.volume, block.nodes.v), block.now, block.nodes.v);
    EXPECT_EQ(block.nodes.v, v);
  }
}

TYPED_TEST(FreeWaters, gives_what_a_part_leaves_to_other_water_and_not_to_a_drop_that_is_larger) {
  constexpr int d = TypeParam::value;
  Block<d> block;
  auto& nodes = block.nodes;
  const int drop = nodes.add(Vec<d>::Constant(5), Vec<d>::Unit(0), 0, {}, false, 1);
  nodes.spray[drop] = 1;
  nodes.volume[drop] = 100;
  block.now.push_back(100);
  const auto carried = block.sum(nodes.volume);
  const FreeWater<d> free(block.mesh, nodes, {});
  auto had = free.moments(nodes.volume, nodes.v);
  had[free.part()[0]].volume *= 0.5;  // half of it is drops by now, and has left its momentum
  free.give_back(had, block.now, nodes.v);
  EXPECT_LE((block.sum(block.now).momentum - carried.momentum).norm(), 1e3 * scenes::eps * carried.momentum.norm());
}

TYPED_TEST(FreeWaters, is_none_that_a_wall_touches) {
  constexpr int d = TypeParam::value;
  Block<d> block;
  block.nodes.tie[3].wall = 0;
  const auto v = block.nodes.v;
  const FreeWater<d> free(block.mesh, block.nodes, {});
  free.give_back(free.moments(block.nodes.volume, block.nodes.v), block.now, block.nodes.v);
  EXPECT_EQ(block.nodes.v, v);
}

}  // namespace
}  // namespace splashdown::fluid::free_water_test
