// A hull that may touch others: what of it is near a place, in its own frame. Made once a run; a search takes O(log n) and
// what it finds. Internal to the rigid-body room.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/facet_tree.hpp"
#include "rigid/types.hpp"

namespace splashdown::rigid {

/// A convex edge between two facets of a solid.
struct Edge {
  std::array<int, 2> vertices;
  Eigen::Vector3d out;                   ///< sum of the facets' normals
  std::array<Eigen::Vector3d, 2> into;   ///< unit, across the edge, along each facet
  std::vector<Eigen::Vector3d> normals;  ///< unit, from one facet's to the other's
};

/// The circle or sphere through a vertex on which its neighbours lie, too: what the facets there stand for.
template <int d>
struct Round {
  Vec<d> centre = Vec<d>::Zero();
  double radius = 0;  ///< 0: there is none, or the hull is hollow there
};

/// The surface of a body, searched in trees. Body frame. Const calls may come from all threads.
template <int d>
class Hull {
 public:
  /// Refers to the surface.
  explicit Hull(const Surface<d>& surface);
  ~Hull();
  /// Takes all over.
  Hull(Hull&&) noexcept;

  /// As it was made.
  const Surface<d>& surface() const { return *surface_; }
  /// Vertices joined to this one by an edge.
  const std::vector<int>& neighbours(int vertex) const { return neighbours_[static_cast<std::size_t>(vertex)]; }
  /// Of a vertex on a convex curve or on a sphere.
  const Round<d>& round(int vertex) const { return round_[static_cast<std::size_t>(vertex)]; }
  const std::vector<Edge>& edges() const { return edges_; }  ///< in 3D; none in 2D

  /// From the surface; infinity beyond `reach`.
  double distance(const Vec<d>& x, double reach) const;
  bool is_convex() const { return convex_; }  ///< in 3D; false in 2D
  /// Facets nearer than `reach`, and some that are hardly farther; ascending.
  std::vector<int> facets_near(const Vec<d>& x, double reach) const;
  std::vector<int> all_facets() const;  ///< their numbers, ascending
  /// Edges that may pass there.
  std::vector<int> edges_within(const Eigen::AlignedBox<double, d>& place) const;

 private:
  struct Boxes;
  void find_neighbours();
  void find_edges();
  void find_round_vertices();
  const Surface<d>* surface_;
  std::vector<std::vector<int>> neighbours_;  // of vertices
  std::vector<Edge> edges_;
  std::vector<Round<d>> round_;  // of vertices
  bool convex_ = false;
  FacetTree<d> tree_;
  std::unique_ptr<Boxes> boxes_;
};

}  // namespace splashdown::rigid
