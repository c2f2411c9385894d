// Which facets of a closed boundary share an edge (3D) or meet between two nodes (2D: the facet itself).
#pragma once

#include <algorithm>
#include <vector>

#include "fluid/pfem/mesh/mesh.hpp"

namespace splashdown::fluid {

/// Of each node the boundary facets around it.
template <int d>
class BoundaryEdges {
 public:
  /// `nodes`: how many there are. O(facets + nodes).
  BoundaryEdges(const std::vector<Facet<d>>& boundary, std::size_t nodes) : start_(nodes + 1, 0) {
    for (const auto& f : boundary)
      for (int n : f.nodes) ++start_[n + 1];
    for (std::size_t n = 0; n < nodes; ++n) start_[n + 1] += start_[n];
    facet_.resize(start_.back());
    std::vector<int> next(start_.begin(), start_.end() - 1);
    for (std::size_t f = 0; f < boundary.size(); ++f)
      for (int n : boundary[f].nodes) facet_[next[n]++] = static_cast<int>(f);
  }

  /// Whether the node is a corner of a boundary facet.
  bool on_boundary(int node) const { return start_[node + 1] > start_[node]; }

  /// Calls visit(facet index) for the facets that hold both nodes.
  template <class Visit>
  void around(const std::vector<Facet<d>>& boundary, int a, int b, Visit visit) const {
    for (int i = start_[a]; i < start_[a + 1]; ++i) {
      const auto& nodes = boundary[facet_[i]].nodes;
      if (std::find(nodes.begin(), nodes.end(), b) != nodes.end()) visit(facet_[i]);
    }
  }

  /// Splits the facets at the edge's new node m. Right as long as neither node nor m was part of a split before.
  void split(std::vector<Facet<d>>& boundary, int a, int b, int m) const {
    around(boundary, a, b, [&](int f) {
      Facet<d> other = boundary[f];
      std::replace(boundary[f].nodes.begin(), boundary[f].nodes.end(), a, m);
      std::replace(other.nodes.begin(), other.nodes.end(), b, m);
      boundary.push_back(other);
    });
  }

 private:
  std::vector<int> start_, facet_;
};

}  // namespace splashdown::fluid
