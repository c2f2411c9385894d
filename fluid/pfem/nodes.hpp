// The nodes of the PFEM, one array per quantity: what a step keeps about each of them.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "fluid/pfem/parallel.hpp"
#include "fluid/pfem/types.hpp"

namespace splashdown::fluid {

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

/// Of a compressible liquid (compression.hpp).
struct Compressed {
  std::array<double, 3> pressure{};  ///< at t_n, t_{n-1}, t_{n-2} [Pa]
  double rate = 0;                   ///< - div v at t_{n-1/2} [1/s]
  double density = 1;                ///< at t_n, over that at t = 0
};

/// Volume, momentum and kinetic energy, the latter two over the density.
template <int d>
struct VelocityMoments {
  double volume = 0;                 ///< [m^d]
  Vec<d> momentum = Vec<d>::Zero();  ///< [m^d m/s]
  double energy = 0;                 ///< [m^d m^2/s^2]

  /// Of a volume [m^d] that moves with v [m/s].
  static VelocityMoments of(double volume, const Vec<d>& v) {
    return {volume, volume * v, 0.5 * volume * v.squaredNorm()};
  }
  /// Adds all three.
  VelocityMoments& operator+=(const VelocityMoments& b) {
    volume += b.volume, momentum += b.momentum, energy += b.energy;
    return *this;
  }
  /// Subtracts all three.
  VelocityMoments& operator-=(const VelocityMoments& b) {
    volume -= b.volume, momentum -= b.momentum, energy -= b.energy;
    return *this;
  }
  /// momentum / volume [m/s]; zero without a volume.
  Vec<d> mean_velocity() const { return volume > 0 ? Vec<d>(momentum / volume) : Vec<d>::Zero(); }
  /// Of the motion about the centre of mass; zero where cancellation leaves less.
  double inner_energy() const { return std::max(0.0, energy - 0.5 * momentum.dot(mean_velocity())); }
};

/// All nodes, world frame. All arrays are as long as `x`.
template <int d>
struct Nodes {
  std::vector<Vec<d>> x;              ///< position at t_n [m]
  std::vector<Vec<d>> v;              ///< velocity at t_{n-1/2} [m/s]
  std::vector<double> p;              ///< pressure they carry: at t_{n-1}, or where they were made [Pa]
  std::vector<WallTie> tie;           ///< wall contact
  std::vector<char> surface;          ///< 1: on the free surface (p = 0)
  std::vector<double> volume;         ///< share of the cells around it after the last move; drops keep their own [m^d]
  std::vector<double> h;              ///< size that elements around it are to have [m]
  std::vector<double> wall_pressure;  ///< mean of late at a wall (fluid/pfem/contact/ventilation.hpp), elsewhere 0 [Pa]
  std::vector<char> separates;        ///< 1: at an edge of a wall where the flow leaves it
  std::vector<char> spray;            ///< 1: belongs to no cell, flies ballistically
  std::vector<int> vertex;            ///< number in the last triangulation, -1: was not there
  std::vector<double> owed;           ///< what the mesh around it has lost of its volume and has not got back yet [m^d]
  std::vector<int> part;              ///< which water of the last mesh it belonged to (parts_of), -1: was not there
  std::vector<VelocityMoments<d>> inherited;  ///< what nodes carried that have gone into it on the way to the next mesh
  std::vector<double> field_energy;           ///< over the density: what the field had around it (field_energy.hpp)
  std::vector<Compressed> compression;        ///< of a compressible liquid; of others, and at the start, empty

  /// Number of nodes.
  std::size_t size() const { return x.size(); }

  /// Appends a node without volume; `element_size`: h [m]. Returns its index.
  int add(const Vec<d>& position, const Vec<d>& velocity, double pressure, WallTie t, bool on_surface,
          double element_size = 0) {
    x.push_back(position);
    v.push_back(velocity);
    p.push_back(pressure);
    tie.push_back(t);
    surface.push_back(on_surface);
    volume.push_back(0);
    h.push_back(element_size);
    wall_pressure.push_back(0);
    separates.push_back(0);
    spray.push_back(0);
    vertex.push_back(-1);
    owed.push_back(0);
    part.push_back(-1);
    inherited.emplace_back();
    field_energy.push_back(0);
    if (!compression.empty()) compression.emplace_back();
    return static_cast<int>(x.size()) - 1;
  }

  /// Gives node `at` the mean compression of some, if there is any.
  template <class Indices>
  void compress_as(int at, const Indices& some) {
    if (compression.empty()) return;
    Compressed mean;
    if (std::size(some) > 0) mean.density = 0;
    for (int i : some) {
      for (std::size_t k = 0; k < mean.pressure.size(); ++k)
        mean.pressure[k] += compression[i].pressure[k] / std::size(some);
      mean.rate += compression[i].rate / std::size(some);
      mean.density += compression[i].density / std::size(some);
    }
    compression[at] = mean;
  }

  /// What node i carries.
  VelocityMoments<d> carried(std::size_t i) const { return VelocityMoments<d>::of(volume[i], v[i]); }

  /// Node `heir` gets what node `gone` has carried, inherited and been owed.
  void bequeath(std::size_t gone, std::size_t heir) {
    owed[heir] += volume[gone] + owed[gone];
    inherited[heir] += carried(gone);
    inherited[heir] += inherited[gone];
    field_energy[heir] += field_energy[gone];
    volume[gone] = owed[gone] = field_energy[gone] = 0;
    inherited[gone] = {};
  }

  /// Keeps the nodes named in `order`, in that order.
  void select(const std::vector<int>& order) {
    auto pick = [&](auto& values) {
      std::remove_reference_t<decltype(values)> picked(order.size());
      in_parallel(order.size(), [&](std::size_t i) { picked[i] = values[order[i]]; });
      values.swap(picked);
    };
    pick(x), pick(v), pick(p), pick(h), pick(tie), pick(wall_pressure), pick(surface), pick(separates), pick(spray),
        pick(vertex);
    pick(volume), pick(owed), pick(part), pick(inherited), pick(field_energy);
    if (!compression.empty()) pick(compression);
  }
};

}  // namespace splashdown::fluid
