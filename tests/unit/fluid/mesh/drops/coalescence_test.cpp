#include "fluid/pfem/mesh/drops/coalescence.hpp"

#include <gtest/gtest.h>

#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::coalescence_test {
namespace {

template <class D>
class Coalescence : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Coalescence, Dimensions);

template <int d>
scenes::Lattice<d> pool() {
  scenes::Lattice<d> pool(4);
  pool.nodes.volume = nodal_volumes(pool.mesh, pool.nodes.x);
  for (auto& v : pool.nodes.v) v = Vec<d>::Constant(0.5);
  return pool;
}

TYPED_TEST(Coalescence, a_drop_brings_its_own_momentum_and_no_more) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  auto& nodes = p.nodes;
  std::size_t drop = 0;
  while (!nodes.surface[drop]) ++drop;
  const double share = nodes.volume[drop];
  nodes.volume[drop] = share / 100;
  nodes.v[drop] = Vec<d>::Constant(-20);
  nodes.p[drop] = 1;
  mix_absorbed(nodes, p.mesh);
  // share * v = drop's momentum + the rest's
  const Vec<d> momentum = share / 100 * Vec<d>::Constant(-20) + 0.99 * share * Vec<d>::Constant(0.5);
  EXPECT_LE((share * nodes.v[drop] - momentum).norm(), 100 * scenes::eps * share);
  EXPECT_EQ(nodes.p[drop], 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i == drop) continue;
    EXPECT_EQ(nodes.v[i], Vec<d>::Constant(0.5));
  }
}

TYPED_TEST(Coalescence, facets_of_what_lands_come_before_those_of_its_pool) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  Nodes<d>& nodes = p.nodes;
  // The last nodes are a drop that had another number than they have now, and some are new.
  const std::size_t drop = nodes.size() - nodes.size() / 4;
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes.part[i] = i % 7 == 0 ? -1 : i < drop ? 0 : 1000;
  const auto sorted = smaller_parts_first<d>(p.mesh.boundary, nodes);
  ASSERT_EQ(sorted.size(), p.mesh.boundary.size());
  const auto rank = [&](const Facet<d>& f) {
    int part = -1;
    for (int n : f.nodes) part = std::max(part, nodes.part[n]);
    return part < 0 ? 2 : part == 0 ? 1 : 0;
  };
  EXPECT_TRUE(std::ranges::is_sorted(sorted, {}, rank));
  EXPECT_EQ(rank(sorted.front()), 0);
}

TYPED_TEST(Coalescence, changes_nothing_where_nothing_lands) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  std::mt19937 random(3);
  for (auto& v : p.nodes.v) v = scenes::random_vector<Vec<d>>(random, {});
  const auto before = p.nodes.v;
  mix_absorbed(p.nodes, p.mesh);
  EXPECT_EQ(p.nodes.v, before);
}

TYPED_TEST(Coalescence, water_between_parts_keeps_momentum_about_the_mean_and_makes_no_energy) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  auto& nodes = p.nodes;
  const std::size_t count = nodes.size();
  std::mt19937 random(5);
  const Vec<d> uniform = Vec<d>::Constant(7);
  for (auto& v : nodes.v) v = uniform + scenes::random_vector<Vec<d>>(random, {});
  const double middle = 0.5 * (nodes.x.front().x() + nodes.x.back().x());
  for (std::size_t i = 0; i < count; ++i) nodes.part[i] = nodes.x[i].x() < middle;
  std::vector<double> share(count, 0.0);
  for (const auto& cell : p.mesh.cells) {
    const bool between = std::ranges::any_of(cell, [&](int n) { return nodes.part[n] != nodes.part[cell[0]]; });
    for (int n : cell) share[n] += between * volume<d>(corners(nodes.x, cell)) / (d + 1);
  }
  for (std::size_t i = 0; i < count; ++i) nodes.volume[i] -= share[i];
  VelocityMoments<d> all;
  for (std::size_t i = 0; i < count; ++i) all += nodes.carried(i);
  const Vec<d> w = all.mean_velocity();
  const auto before = nodes.v;
  mix_joined<d>(p.mesh, std::vector<int>(count, 0), nodes);
  for (std::size_t i = 0; i < count; ++i) {
    const double V = nodes.volume[i], now = V + share[i];
    const Vec<d> momentum = now * (nodes.v[i] - w) - V * (before[i] - w);
    EXPECT_LE(momentum.norm(), 100 * scenes::eps * now * w.norm()) << i;
    EXPECT_LE(now * (nodes.v[i] - w).squaredNorm(), V * (before[i] - w).squaredNorm() + 100 * scenes::eps * now) << i;
    EXPECT_EQ(nodes.part[i], 0);
  }
}

TYPED_TEST(Coalescence, water_of_one_part_and_new_nodes_is_not_mixed) {
  constexpr int d = TypeParam::value;
  auto p = pool<d>();
  std::mt19937 random(5);
  for (auto& v : p.nodes.v) v = scenes::random_vector<Vec<d>>(random, {});
  const auto before = p.nodes.v;
  for (std::size_t i = 0; i < p.nodes.size(); ++i) p.nodes.part[i] = i % 3 == 0 ? -1 : 4;
  mix_joined<d>(p.mesh, std::vector<int>(p.nodes.size(), 0), p.nodes);
  EXPECT_EQ(p.nodes.v, before);
}

}  // namespace
}  // namespace splashdown::fluid::coalescence_test
