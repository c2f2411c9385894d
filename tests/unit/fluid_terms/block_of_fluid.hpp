// A rectangular or cuboid block of fluid on a distorted lattice, and one effect acting on it without pressure.
#pragma once

#include <algorithm>
#include <cmath>

#include "tests/unit/fluid_terms/still_mesh.hpp"

namespace splashdown::fluid::testing {

/// Cells of a lattice: two triangles a square, six tetrahedra (Kuhn) a cube.
template <int d>
struct Block : StillMesh<d> {
  using StillMesh<d>::nodes;
  using StillMesh<d>::mesh;
  using StillMesh<d>::lumped_volume;
  using StillMesh<d>::walls;
  using StillMesh<d>::poses;
  std::vector<Twist<d>> wall_velocities;

  using Lattice = Eigen::Matrix<int, d, 1>;
  Lattice count;

  /// `distortion`: of inner nodes, over the spacing.
  Block(const Lattice& cells, double spacing, double distortion) : count(cells) {
    const int total = (cells.array() + 1).prod();
    for (int i = 0; i < total; ++i) {
      const Lattice at = place(i);
      Vec<d> x = spacing * at.template cast<double>();
      const bool inner = (at.array() > 0).all() && (at.array() < cells.array()).all();
      for (int k = 0; k < d && inner; ++k) x[k] += distortion * spacing * std::sin(12.9898 * i + 78.233 * k);
      nodes.add(x, Vec<d>::Zero(), 0, {}, false);
    }
    for (int i = 0; i < total; ++i)
      if ((place(i).array() < cells.array()).all()) fill_cube(place(i));
    lumped_volume.assign(nodes.size(), 0);
    for (const auto& cell : mesh.cells)
      for (int n : cell) lumped_volume[n] += volume<d>(corners(nodes.x, cell)) / (d + 1);
  }

  Lattice place(int i) const {
    Lattice at;
    for (int k = 0; k < d; ++k) at[k] = i % (count[k] + 1), i /= count[k] + 1;
    return at;
  }
  int index(const Lattice& at) const {
    int i = 0;
    for (int k = d - 1; k >= 0; --k) i = i * (count[k] + 1) + at[k];
    return i;
  }

  /// Makes the side at the low or high end of an axis a wall (d = 2).
  int add_wall(int axis, bool high, bool sticks, const Twist<d>& velocity = Twist<d>::Zero()) {
    const int w = static_cast<int>(walls.size());
    walls.emplace_back().sticks = sticks;
    poses.push_back(Isometry<d>::Identity());
    wall_velocities.push_back(velocity);
    const int along = 1 - axis, at = high ? count[axis] : 0;
    for (int i = 0; i < count[along]; ++i) {
      Lattice a, b;
      a[axis] = b[axis] = at;
      a[along] = i, b[along] = i + 1;
      Facet<d> f{{index(a), index(b)}, w};
      if (high == (axis == 1)) std::swap(f.nodes[0], f.nodes[1]);
      for (int n : f.nodes) nodes.tie[n].wall = w;
      mesh.boundary.push_back(f);
    }
    return w;
  }

  /// The low side of an axis becomes a wall that slips, in two dimensions and in three.
  int add_floor(int axis, const Twist<d>& velocity = Twist<d>::Zero()) {
    const int w = static_cast<int>(walls.size());
    walls.emplace_back();
    poses.push_back(Isometry<d>::Identity());
    wall_velocities.push_back(velocity);
    for (const auto& cell : mesh.cells)
      for (int k = 0; k <= d; ++k) {
        const auto corners_of_facet = facet_nodes(cell, k);
        if (!std::ranges::all_of(corners_of_facet, [&](int n) { return place(n)[axis] == 0; })) continue;
        mesh.boundary.push_back({corners_of_facet, w});
        for (int n : corners_of_facet) nodes.tie[n].wall = w;
      }
    return w;
  }

  /// One kick: returns the new velocities, and the impulses on walls.
  std::vector<Vec<d>> predict(Effect<d>& effect, std::vector<Wrench<d>>* impulses = nullptr) const {
    std::vector<Vec<d>> v = nodes.v;
    const std::vector<WallVelocity<d>> moving(wall_velocities.begin(), wall_velocities.end());
    std::vector<WallImpulse<d>> on_walls(walls.size());
    const bool is_done = this->with_view([&](const StepView<d>& view) {
      return effect.begin(view).ok() && effect.predict(view, {nodes.v, moving}, {v, on_walls}).ok();
    });
    if (!is_done) return {};
    if (impulses) impulses->clear();
    for (std::size_t w = 0; impulses && w < on_walls.size(); ++w) impulses->push_back(on_walls[w].rigid);
    return v;
  }

 private:
  void fill_cube(const Lattice& low) {
    std::array<int, d> axes;
    for (int k = 0; k < d; ++k) axes[k] = k;
    do {
      std::array<int, d + 1> cell;
      Lattice at = low;
      cell[0] = index(at);
      for (int k = 0; k < d; ++k) {
        ++at[axes[k]];
        cell[k + 1] = index(at);
      }
      if (volume<d>(corners(nodes.x, cell)) < 0) std::swap(cell[d - 1], cell[d]);
      mesh.cells.push_back(cell);
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
};

}  // namespace splashdown::fluid::testing
