// Water at walls, in the plane and in space, for the tests of contact.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <type_traits>
#include <vector>

#include "fluid/pfem/contact/wall.hpp"
#include "fluid/pfem/mesh/recognition/recognise.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::scenes {

using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

template <int d>
Surface<d> box(const Vec<d>& min, const Vec<d>& max) {
  if constexpr (d == 2)
    return rectangle(min, max);
  else
    return block(min, max);
}

/// A point whose last entry is given and whose others are all `across`.
template <int d>
Vec<d> point(double across, double up) {
  Vec<d> x = Vec<d>::Constant(across);
  x[d - 1] = up;
  return x;
}

/// Poses with their reference points away from the origin, so that lever arms count.
template <int d>
Isometry<d> elsewhere() {
  Isometry<d> pose = Isometry<d>::Identity();
  for (int k = 0; k < d; ++k) pose.translation()[k] = 0.7 - 0.4 * k;
  return pose;
}

/// The tie of a node that sits on a wall: of a corner or a crease, or of the patch that it slides on.
template <int d>
WallTie tie_at(const Wall<d>& wall, const WallPlace<d>& pose, const Vec<d>& x, int number) {
  const auto near = wall.nearest(pose, x, 1);
  return near.sharp() ? WallTie{number, -1, near.vertex, near.crease} : WallTie{number, near.patch, -1};
}

/// Walls with poses and velocities.
template <int d>
struct Walls {
  void add_wall(const Surface<d>& surface, const Isometry<d>& at = Isometry<d>::Identity()) {
    walls.emplace_back(wall<d>("wall", surface, 0.1));
    pose.push_back(at);
    velocity.push_back(Twist<d>::Zero());
  }
  WallsAt<d> at() const { return {walls, pose}; }
  std::vector<Wall<d>> walls;
  std::vector<WallPlace<d>> pose;
  std::vector<WallVelocity<d>> velocity;
};

/// A lattice in a tank twice as high, wall 0, whose reference point is elsewhere.
template <int d>
struct Tank : Lattice<d>, Walls<d> {
  explicit Tank(int n) : Lattice<d>(n) {
    const Isometry<d> at = elsewhere<d>();
    Vec<d> top = Vec<d>::Ones();
    top[d - 1] = 2;
    this->add_wall(turned_inside_out(box<d>(-at.translation(), top - at.translation())), at);
    for (std::size_t i = 0; i < this->nodes.size(); ++i) {
      const Vec<d>& x = this->nodes.x[i];
      bool on_wall = x[d - 1] == 0;
      for (int k = 0; k + 1 < d; ++k) on_wall = on_wall || x[k] == 0 || x[k] == 1;
      if (on_wall) this->nodes.tie[i] = tie_at<d>(this->walls[0], at, x, 0);
    }
  }
};

/// A cell with all of its facets, each wetted by the wall that all of its nodes are tied to.
template <int d>
void add_cell(const Nodes<d>& nodes, std::array<int, d + 1> cell, Mesh<d>& mesh) {
  if (volume<d>(corners(nodes.x, cell)) < 0) std::swap(cell[0], cell[1]);
  mesh.cells.push_back(cell);
  for (int k = 0; k <= d; ++k) {
    Facet<d> f;
    f.nodes = facet_nodes(cell, k);
    f.wall = nodes.tie[f.nodes[0]].wall;
    for (int n : f.nodes)
      if (nodes.tie[n].wall != f.wall) f.wall = -1;
    mesh.boundary.push_back(f);
  }
}

/// Each facet's side is another facet's, the other way round.
inline bool is_closed(const std::vector<Facet<2>>& boundary) {
  std::map<int, int> balance;
  for (const auto& f : boundary) ++balance[f.nodes[0]], --balance[f.nodes[1]];
  return std::all_of(balance.begin(), balance.end(), [](const auto& at) { return at.second == 0; });
}
inline bool is_closed(const std::vector<Facet<3>>& boundary) {
  std::map<std::pair<int, int>, int> balance;
  for (const auto& f : boundary)
    for (int k = 0; k < 3; ++k) {
      const int a = f.nodes[k], b = f.nodes[(k + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  return std::all_of(balance.begin(), balance.end(), [](const auto& at) { return at.second == 0; });
}

}  // namespace splashdown::fluid::scenes
