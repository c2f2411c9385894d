// The nodes of a fluid as people look at them, one array per quantity. What a method keeps about its nodes besides is its own.
#pragma once

#include <vector>

#include "core/types.hpp"

namespace splashdown {

/// A node is free, or slides on a smooth patch of a wall or (3D) along one of its creases, or sits on one of its corners.
struct WallTie {
  int wall = -1;    ///< index of the wall, -1: none
  int patch = -1;   ///< smooth patch of its surface the node slides on
  int vertex = -1;  ///< corner of its surface the node is fixed to, -1: slides
  int crease = -1;  ///< crease of its surface the node slides along
  /// Whether the node is at a corner or on a crease.
  bool sharp() const { return vertex >= 0 || crease >= 0; }
  /// Equal in all four.
  bool operator==(const WallTie&) const = default;
};

/// Positions, velocities and pressures of all nodes, world frame. All arrays are as long as `x`.
template <int d>
struct Nodes {
  std::vector<Vec<d>> x;       ///< position at t_n [m]
  std::vector<Vec<d>> v;       ///< velocity at t_{n-1/2} [m/s]
  std::vector<double> p;       ///< pressure they carry: at t_{n-1}, or where they were made [Pa]
  std::vector<WallTie> tie;    ///< wall contact
  std::vector<char> surface;   ///< 1: on the free surface (p = 0)
  std::vector<double> volume;  ///< share of the cells around it after the last move; drops keep their own [m^d]

  /// Number of nodes.
  std::size_t size() const { return x.size(); }

  /// Appends a node without volume; returns its index.
  int add(const Vec<d>& position, const Vec<d>& velocity, double pressure, WallTie t, bool on_surface) {
    x.push_back(position);
    v.push_back(velocity);
    p.push_back(pressure);
    tie.push_back(t);
    surface.push_back(on_surface);
    volume.push_back(0);
    return static_cast<int>(x.size()) - 1;
  }
};

}  // namespace splashdown
