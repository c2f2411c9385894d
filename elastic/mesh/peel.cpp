#include "elastic/mesh/peel.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace splashdown::elastic {
namespace {

using Cell = std::array<int, 4>;

/// Corners of the side opposite to corner `k`, in ascending order.
std::array<int, 3> side_of(const Cell& cell, int k) {
  std::array<int, 3> side;
  for (int i = 0; i < 3; ++i) side[i] = cell[(k + 1 + i) % 4];
  std::ranges::sort(side);
  return side;
}

/// Out of a cell of any orientation, of unit length.
Vec<3> normal_of(const Points<3>& x, const Cell& cell, int k) {
  const auto side = side_of(cell, k);
  const Vec<3> n = (x.col(side[1]) - x.col(side[0])).cross(x.col(side[2]) - x.col(side[0])).normalized();
  return n.dot(x.col(cell[k]) - x.col(side[0])) > 0 ? Vec<3>(-n) : n;
}

/// Sides of cells that are on the boundary, and its edges.
struct Skin {
  std::vector<std::vector<int>> sides;  // of each cell: the corners opposite to them
  std::set<std::pair<int, int>> edges;
  explicit Skin(const Simplices<3>& cells) : sides(cells.size()) {
    std::map<std::array<int, 3>, int> count;
    for (const auto& cell : cells)
      for (int k = 0; k < 4; ++k) ++count[side_of(cell, k)];
    for (std::size_t c = 0; c < cells.size(); ++c)
      for (int k = 0; k < 4; ++k)
        if (const auto side = side_of(cells[c], k); count[side] == 1) {
          sides[c].push_back(k);
          for (int i = 0; i < 3; ++i) edges.insert(std::minmax(side[i], side[(i + 1) % 3]));
        }
  }
};

/// Whether the boundary stays a surface without this cell, and its edges stay where they are.
bool may_go(const Points<3>& x, const Cell& cell, const std::vector<int>& sides, Skin& skin) {
  constexpr double crease = std::numbers::pi / 6;  // facets of a hull that turn by more meet at an edge
  if (sides.size() != 2) return false;
  // Flat cells have no normals to speak of: both sides are on one side of the plane that the other two corners lie in.
  const int a = cell[sides[0]], b = cell[sides[1]];
  if (!skin.edges.insert(std::minmax(a, b)).second) return false;
  Vec<3> n = normal_of(x, cell, sides[0]);
  const Vec<3> m = normal_of(x, cell, sides[1]);
  return std::abs(n.dot(m)) > std::cos(crease);
}

}  // namespace

Simplices<3> peeled(const Points<3>& corners, Simplices<3> cells, double flat) {
  for (bool goes_on = true; goes_on;) {
    Skin skin(cells);
    Simplices<3> left;
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (mean_ratio<3>(corners, cells[c]) >= flat || !may_go(corners, cells[c], skin.sides[c], skin))
        left.push_back(cells[c]);
    goes_on = left.size() < cells.size();
    cells = std::move(left);
  }
  return cells;
}

}  // namespace splashdown::elastic
