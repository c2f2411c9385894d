#include "fluid/mesh/landing.hpp"

#include <gtest/gtest.h>

#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid {
namespace {

template <class D>
class Landing : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Landing, Dimensions);

template <int d>
scenes::Lattice<d> pool() {
  scenes::Lattice<d> pool(4);
  pool.nodes.volume = nodal_volumes(pool.mesh, pool.nodes.x);
  for (auto& v : pool.nodes.v) v = Vec<d>::Constant(0.5);
  return pool;
}

TYPED_TEST(Landing, a_drop_brings_its_own_momentum_and_no_more) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  auto& nodes = p.nodes;
  std::size_t drop = 0;
  while (!nodes.surface[drop]) ++drop;
  const double share = nodes.volume[drop];
  nodes.volume[drop] = share / 100;
  nodes.v[drop] = Vec<d>::Constant(-20);
  nodes.p[drop] = 1;
  absorb_droplets(nodes, p.mesh);
  // share * v = drop's momentum + the rest's
  const Vec<d> momentum = share / 100 * Vec<d>::Constant(-20) + 0.99 * share * Vec<d>::Constant(0.5);
  EXPECT_LE((share * nodes.v[drop] - momentum).norm(), 100 * scenes::eps * share);
  EXPECT_EQ(nodes.p[drop], 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i == drop) continue;
    EXPECT_EQ(nodes.v[i], Vec<d>::Constant(0.5));
  }
}

TYPED_TEST(Landing, changes_nothing_where_nothing_lands) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  std::mt19937 random(3);
  for (auto& v : p.nodes.v) v = scenes::random_vector<Vec<d>>(random, {});
  const auto before = p.nodes.v;
  absorb_droplets(p.nodes, p.mesh);
  EXPECT_EQ(p.nodes.v, before);
}

}  // namespace
}  // namespace splashdown::fluid
