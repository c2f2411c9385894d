#include "fluid/mesh/free_water.hpp"

#include <gtest/gtest.h>

#include "fluid/mesh/recognise.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid {
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
    auto& nodes = this->nodes;
    nodes.tie.assign(nodes.size(), {});
    now = nodal_volumes(this->mesh, nodes.x);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double phase = static_cast<double>(i);
      nodes.volume[i] = now[i] * (1 + 0.5 * std::sin(3 * phase));
      for (int k = 0; k < d; ++k) nodes.v[i][k] = 10 + std::cos(phase + k);
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
  const FreeWater<d> free(block.mesh, block.nodes);
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
  const FreeWater<d> free(block.mesh, block.nodes);
  free.give_back(free.moments(block.nodes.volume, block.nodes.v), block.now, block.nodes.v);
  const double energy = carried.inner_energy();
  // Cancellation: the energy of the mean motion is a hundred times as large.
  EXPECT_NEAR(block.sum(block.now).inner_energy(), energy, 1e6 * scenes::eps * energy);
}

TYPED_TEST(FreeWaters, counts_what_nodes_have_inherited) {
  constexpr int d = TypeParam::value;
  Block<d> block;
  Nodes<d>& nodes = block.nodes;
  const auto carried = block.sum(nodes.volume);
  nodes.bequeath(0, 1);
  EXPECT_EQ(nodes.volume[0], 0);
  const FreeWater<d> free(block.mesh, nodes);
  const auto moments = free.moments(nodes.volume, nodes.v, nodes.inherited);
  const auto& all = moments[free.part()[0]];
  EXPECT_NEAR(all.volume, carried.volume, 1e3 * scenes::eps * carried.volume);
  EXPECT_LT((all.momentum - carried.momentum).norm(), 1e3 * scenes::eps * carried.momentum.norm());
  EXPECT_NEAR(all.energy, carried.energy, 1e3 * scenes::eps * carried.energy);
}

TYPED_TEST(FreeWaters, is_none_that_a_wall_touches) {
  constexpr int d = TypeParam::value;
  Block<d> block;
  block.nodes.tie[3].wall = 0;
  const auto v = block.nodes.v;
  const FreeWater<d> free(block.mesh, block.nodes);
  free.give_back(free.moments(block.nodes.volume, block.nodes.v), block.now, block.nodes.v);
  EXPECT_EQ(block.nodes.v, v);
}

}  // namespace
}  // namespace splashdown::fluid
