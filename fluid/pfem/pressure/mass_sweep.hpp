// One sweep of the consistent mass matrix's iteration, as a sparse matrix of the nodes: half the memory traffic of sums over
// cells in 2D, a third in 3D, and each step makes some forty sweeps.
#pragma once

#include <span>
#include <vector>

#include "fluid/pfem/mesh/node_cells.hpp"
#include "fluid/pfem/types.hpp"

namespace splashdown::fluid {

/// S = 1 - M_L^-1 M_C, with M_C,ij the sum over cells of m (1 + delta_ij) / ((d + 1) (d + 2)), and M_L heavier than its sums
/// where nodes are lighter than they may be.
template <int d>
class MassSweep {
 public:
  /// `share`: m / (d + 2) of each cell [kg]; `per_mass`: 1 / ((d + 1) M_L) of each node [1/kg]; `keeps`: of each node 1 less its
  /// cells' mass / ((d + 2) M_L).
  void build(const std::vector<std::array<int, d + 1>>& cells, const NodeCells<d>& around,
             std::span<const double> share, std::span<const double> per_mass, std::span<const double> keeps);
  /// (S u)_i
  Vec<d> operator()(std::size_t i, std::span<const Vec<d>> u) const {
    Vec<d> sum = own_[i] * u[i];
    for (int e = start_[i]; e < start_[i + 1]; ++e) sum -= weight_[e] * u[node_[e]];
    return sum;
  }
  /// S u, on all threads.
  void operator()(std::span<const Vec<d>> u, std::vector<Vec<d>>& out) const;

 private:
  std::vector<int> start_, node_;
  std::vector<double> weight_, own_;
};

}  // namespace splashdown::fluid
