#include "fluid/pfem/mesh/drops/sheets.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "fluid/pfem/mesh/conservation/field_energy.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::sheets_test {
namespace {

template <class D>
class Sheets : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Sheets, Dimensions);

template <int d>
struct Pool : scenes::Lattice<d> {
  FlatCells<d> flat_cells;

  Pool() : scenes::Lattice<d>(5) { this->nodes.volume = nodal_volumes(this->mesh, this->nodes.x); }
};

// Water whose nodes are all on free surfaces as far as x = `length`, in random motion.
template <int d>
Pool<d> pool_with_sheet(double length = 0.4) {
  Pool<d> pool;
  Nodes<d>& nodes = pool.nodes;
  std::mt19937 random(7);
  for (auto& v : nodes.v) v = scenes::random_vector<Vec<d>>(random, {});
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes.x[i].x() < length + 1e-9) nodes.surface[i] = 1, nodes.tie[i] = {};
  for (auto& f : pool.mesh.boundary)
    if (std::ranges::all_of(f.nodes, [&](int n) { return nodes.surface[n]; })) f.wall = -1;
  return pool;
}

template <int d>
VelocityMoments<d> carried(const Nodes<d>& nodes) {
  VelocityMoments<d> all;
  for (std::size_t i = 0; i < nodes.size(); ++i) all += nodes.carried(i);
  return all;
}

/// Volume times place.
template <int d>
Vec<d> moment(const Nodes<d>& nodes) {
  Vec<d> sum = Vec<d>::Zero();
  for (std::size_t i = 0; i < nodes.size(); ++i) sum += nodes.volume[i] * nodes.x[i];
  return sum;
}

template <int d>
double volume_of_cells(const scenes::Lattice<d>& p) {
  return std::accumulate(p.mesh.cells.begin(), p.mesh.cells.end(), 0.0,
                         [&](double sum, const auto& cell) { return sum + volume<d>(corners(p.nodes.x, cell)); });
}

const auto any_node = [](int) { return true; };

// It counts to no node yet: those that stay would have to give the volume of other water away.
TYPED_TEST(Sheets, water_that_has_just_closed_a_gap_stays) {
  constexpr int d = TypeParam::value;
  auto p = pool_with_sheet<d>();
  for (std::size_t i = 0; i < p.nodes.size(); ++i) p.nodes.part[i] = static_cast<int>(i);
  let_sheets_fly<d>(p.nodes, p.mesh, p.flat_cells, any_node);
  EXPECT_EQ(std::ranges::count(p.nodes.spray, 1), 0);
}

// Most of the water would fly, and come back to what hardly could take it up.
TYPED_TEST(Sheets, water_of_which_most_would_fly_stays_whole) {
  constexpr int d = TypeParam::value;
  auto p = pool_with_sheet<d>(0.8);
  let_sheets_fly<d>(p.nodes, p.mesh, p.flat_cells, any_node);
  EXPECT_EQ(std::ranges::count(p.nodes.spray, 1), 0);
  // All of it: a shred in the air.
  auto shred = pool_with_sheet<d>(1);
  for (auto& tie : shred.nodes.tie) tie = {};
  let_sheets_fly<d>(shred.nodes, shred.mesh, shred.flat_cells, any_node);
  EXPECT_TRUE(shred.mesh.cells.empty());
}

TYPED_TEST(Sheets, nodes_whose_cells_all_lie_between_free_surfaces_fly) {
  constexpr int d = TypeParam::value;
  auto p = pool_with_sheet<d>();
  Nodes<d>& nodes = p.nodes;
  std::vector<char> stays(nodes.size(), 0);
  for (const auto& cell : p.mesh.cells)
    if (std::ranges::any_of(cell, [&](int n) { return !nodes.surface[n] || nodes.tie[n].wall >= 0; }))
      for (int n : cell) stays[n] = 1;
  let_sheets_fly<d>(nodes, p.mesh, p.flat_cells, any_node);
  EXPECT_GT(std::ranges::count(nodes.spray, 1), 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_EQ(nodes.spray[i], !stays[i]) << i;
  for (const auto& cell : p.mesh.cells)
    for (int n : cell) EXPECT_FALSE(nodes.spray[n]);
}

TYPED_TEST(Sheets, they_take_their_volume_place_and_momentum_along_and_no_energy) {
  constexpr int d = TypeParam::value;
  auto p = pool_with_sheet<d>();
  const auto before = carried(p.nodes);
  const auto place = moment(p.nodes);
  let_sheets_fly<d>(p.nodes, p.mesh, p.flat_cells, any_node);
  const auto after = carried(p.nodes);
  EXPECT_LE((moment(p.nodes) - place).norm(), 1000 * scenes::eps);  // nothing is lifted
  EXPECT_NEAR(after.volume, before.volume, 1000 * scenes::eps);
  EXPECT_LE((after.momentum - before.momentum).norm(), 1000 * scenes::eps);
  EXPECT_LT(after.energy, before.energy);
  const auto left = nodal_volumes(p.mesh, p.nodes.x);
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (p.nodes.spray[i]) continue;
    EXPECT_NEAR(p.nodes.volume[i], left[i], 1000 * scenes::eps) << i;
  }
}

TYPED_TEST(Sheets, any_node_may_be_told_to_fly_and_volume_place_and_momentum_stay) {
  constexpr int d = TypeParam::value;
  for (const std::size_t node : {0, 7, 12}) {  // at a corner, at a side, within
    Pool<d> p;
    std::mt19937 random(7);
    for (auto& v : p.nodes.v) v = scenes::random_vector<Vec<d>>(random, {});
    const auto before = carried(p.nodes);
    const auto place = moment(p.nodes);
    p.nodes.field_energy = field_energies(p.mesh, p.nodes);
    const double held = scenes::sum(p.nodes.field_energy);
    std::vector<char> flies(p.nodes.size(), 0);
    flies[node] = 1;
    let_fly<d>(p.nodes, p.mesh, p.flat_cells, flies);
    EXPECT_NEAR(scenes::sum(p.nodes.field_energy), held, 1000 * scenes::eps);
    // It is all of its cells, of which the field had more: Jensen.
    EXPECT_LE(p.nodes.carried(node).energy, p.nodes.field_energy[node]);
    EXPECT_LE((moment(p.nodes) - place).norm(), 1000 * scenes::eps);
    EXPECT_TRUE(p.nodes.spray[node]);
    const auto after = carried(p.nodes);
    EXPECT_NEAR(after.volume, before.volume, 1000 * scenes::eps);
    EXPECT_LE((after.momentum - before.momentum).norm(), 1000 * scenes::eps);
    EXPECT_LE(after.energy, before.energy);
    EXPECT_NEAR(enclosed_volume(p.mesh.boundary, p.nodes.x), volume_of_cells<d>(p), 1000 * scenes::eps);
  }
}

TYPED_TEST(Sheets, what_stays_is_enclosed_by_its_boundary) {
  constexpr int d = TypeParam::value;
  auto p = pool_with_sheet<d>();
  let_sheets_fly<d>(p.nodes, p.mesh, p.flat_cells, any_node);
  Vec<d> closure = Vec<d>::Zero();
  for (const auto& f : p.mesh.boundary) {
    closure += area_vector_of<d>(f, p.nodes.x);
    for (int n : f.nodes) EXPECT_FALSE(p.nodes.spray[n]);
  }
  EXPECT_LE(closure.norm(), 1000 * scenes::eps);
  EXPECT_NEAR(enclosed_volume(p.mesh.boundary, p.nodes.x), volume_of_cells<d>(p), 1000 * scenes::eps);
}

// Beside what flies it opens, and flat_cells beside it with it; elsewhere it stays closed.
TYPED_TEST(Sheets, a_crack_stays_closed_as_long_as_there_is_water_around_it) {
  constexpr int d = TypeParam::value;
  for (const bool beside : {true, false}) {
    Pool<d> p;
    std::vector<char> flies(p.nodes.size(), 0);
    auto& cells = p.mesh.cells;
    const auto is_within = [&](const auto& cell) {
      return std::ranges::all_of(
          cell, [&](int n) { return (p.nodes.x[n].array() > 0.1).all() && (p.nodes.x[n].array() < 0.9).all(); });
    };
    const auto shared = [](const auto& a, const auto& b) {
      return std::ranges::count_if(a, [&](int n) { return std::ranges::find(b, n) != b.end(); });
    };
    // Two cells that share a facet stand for flat ones.
    const auto first = std::ranges::find_if(cells, is_within);
    p.flat_cells.push_back(*first);
    cells.erase(first);
    const auto second = std::ranges::find_if(
        cells, [&](const auto& cell) { return is_within(cell) && shared(cell, p.flat_cells[0]) == d; });
    p.flat_cells.push_back(*second);
    cells.erase(second);
    if (beside) {
      const auto neighbour = std::ranges::find_if(cells, [&](const auto& cell) {
        return shared(cell, p.flat_cells[1]) == d && shared(cell, p.flat_cells[0]) < d;
      });
      const auto opposite = std::ranges::find_if(
          *neighbour, [&](int n) { return std::ranges::find(p.flat_cells[1], n) == p.flat_cells[1].end(); });
      flies[*opposite] = 1;
    } else {
      flies[0] = 1;
    }
    let_fly<d>(p.nodes, p.mesh, p.flat_cells, flies);
    EXPECT_EQ(p.flat_cells.size(), beside ? 0 : 2);
    double filled = volume_of_cells<d>(p);
    for (const auto& flat : p.flat_cells) filled += volume<d>(corners(p.nodes.x, flat));
    EXPECT_NEAR(enclosed_volume(p.mesh.boundary, p.nodes.x), filled, 1000 * scenes::eps);
  }
}

TYPED_TEST(Sheets, nodes_that_may_not_fly_do_so_only_without_cells) {
  constexpr int d = TypeParam::value;
  auto p = pool_with_sheet<d>();
  const auto cells = p.mesh.cells;
  let_sheets_fly<d>(p.nodes, p.mesh, p.flat_cells, [](int) { return false; });
  EXPECT_EQ(p.mesh.cells, cells);
  EXPECT_EQ(std::ranges::count(p.nodes.spray, 1), 0);
  // Every other one: the rest has cells, or flies too.
  let_sheets_fly<d>(p.nodes, p.mesh, p.flat_cells, [](int n) { return n % 2 == 0; });
  std::vector<char> has_cells(p.nodes.size(), 0);
  for (const auto& cell : p.mesh.cells)
    for (int n : cell) has_cells[n] = 1;
  for (std::size_t i = 0; i < p.nodes.size(); ++i) EXPECT_EQ(p.nodes.spray[i], !has_cells[i]) << i;
}

}  // namespace
}  // namespace splashdown::fluid::sheets_test
