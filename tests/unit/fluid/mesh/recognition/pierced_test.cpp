#include "fluid/pfem/mesh/recognition/pierced.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::pierced_test {
namespace {

using scenes::eps;

std::vector<Vec<3>> points(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> at(0.0, 1.0);
  std::vector<Vec<3>> x;
  for (int i = 0; i < count; ++i) x.emplace_back(at(random), at(random), at(random));
  return x;
}

double filled(const Delaunay<3>& mesh, const std::vector<Vec<3>>& x) {
  double sum = 0;
  for (const auto& cell : mesh.cells)
    if (cell[0] >= 0) sum += volume<3>(corners(x, cell));
  return sum;
}

// Every facet has the same nodes seen from both of its cells.
void expect_neighbours_meet(const Delaunay<3>& mesh) {
  auto facet = [&](int c, int k) {
    auto nodes = facet_nodes(mesh.cells[c], k);
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  };
  for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c)
    for (int k = 0; k < 4; ++k) {
      const int other = mesh.neighbours[c][k];
      if (mesh.cells[c][0] < 0 || other < 0) continue;
      bool back = false;
      for (int j = 0; j < 4; ++j) back = back || (mesh.neighbours[other][j] == c && facet(other, j) == facet(c, k));
      EXPECT_TRUE(back) << c << " " << k;
    }
}

TEST(Pierced, flips_fill_the_place_of_what_they_take) {
  const auto x = points(3, 60);
  Delaunay<3> mesh = delaunay<3>(x, {});
  const double whole = filled(mesh, x);
  int edges = 0, facets = 0;
  for (int c = 0; c < static_cast<int>(mesh.cells.size()); c += 3) {
    if (mesh.cells[c][0] < 0) continue;
    const auto cell = mesh.cells[c];
    Flip flip = without_edge(mesh, x, c, cell[0], cell[2]);
    if (!flip.fresh.empty()) {
      const std::size_t before = flip.cells.size();
      EXPECT_EQ(flip.fresh.size(), 2 * (before - 2));
      apply(flip, mesh);
      ++edges;
    } else if (flip = without_facet(mesh, x, c, 1); !flip.fresh.empty()) {
      apply(flip, mesh);
      ++facets;
    }
    EXPECT_NEAR(filled(mesh, x), whole, 1e4 * eps * whole);  // of some hundred cells
  }
  EXPECT_GT(edges, 5);
  EXPECT_GT(facets, 5);
  expect_neighbours_meet(mesh);
  for (const auto& cell : mesh.cells)
    if (cell[0] >= 0) {
      EXPECT_GT(volume<3>(corners(x, cell)), 0);
    }
}

TEST(Pierced, an_edge_that_is_removed_is_gone) {
  const auto x = points(5, 40);
  Delaunay<3> mesh = delaunay<3>(x, {});
  for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c) {
    const auto cell = mesh.cells[c];
    const Flip flip = without_edge(mesh, x, c, cell[1], cell[3]);
    if (flip.fresh.empty()) continue;
    apply(flip, mesh);
    for (const auto& left : mesh.cells)
      EXPECT_FALSE(std::count(left.begin(), left.end(), cell[1]) && std::count(left.begin(), left.end(), cell[3]));
    return;
  }
  FAIL() << "no edge could be removed";
}

}  // namespace
}  // namespace splashdown::fluid::pierced_test
