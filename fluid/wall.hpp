// A wall in motion: closest points and sides of its rigid surface, its sharp vertices.
#pragma once

#include <vector>

#include "fluid/facet_tree.hpp"
#include "fluid/spec.hpp"

namespace splashdown::fluid {

template <int d>
class Wall {
 public:
  explicit Wall(const WallSpec<d>& spec);

  struct Near {
    Vec<d> point;      ///< closest point of the wall, world frame
    Vec<d> normal;     ///< of the facet it lies on, out of the solid
    double distance;   ///< signed: negative inside the solid
    int patch;         ///< smooth patch the point lies on
    int vertex;        ///< sharp vertex that is the closest point, -1: none
  };

  /// Closest point of the wall in the given pose; distance = +reach where nothing is nearer.
  Near nearest(const Isometry<d>& pose, const Vec<d>& x, double reach) const;
  /// The same on one smooth patch alone, wherever x is.
  Near nearest_on_patch(const Isometry<d>& pose, const Vec<d>& x, int patch) const;
  /// False only where the point is surely farther than `margin` from the solid; cheap.
  bool may_touch(const Isometry<d>& pose, const Vec<d>& x, double margin) const {
    return turned_inside_out_ || box_.squaredExteriorDistance(pose.inverse() * x) <= margin * margin;
  }
  double distance_unsigned(const Isometry<d>& pose, const Vec<d>& x, double reach) const;
  Vec<d> vertex(const Isometry<d>& pose, int v) const { return pose * Vec<d>(spec_.surface.vertices.col(v)); }
  const std::vector<int>& sharp_vertices() const { return sharp_; }
  const WallSpec<d>& spec() const { return spec_; }
  /// A vertex of a smooth patch that is curved there.
  struct Bend {
    Vec<d> at;      ///< wall frame
    double radius;  ///< of curvature, the smallest along the edges that meet there [m]
  };
  const std::vector<Bend>& bends() const { return bends_; }
  /// Box around the surface in the wall frame.
  const Eigen::AlignedBox<double, d>& box() const { return box_; }

 private:
  void find_patches(double crease);
  void find_bends();
  Near near_of(const Isometry<d>& pose, const Vec<d>& local, const typename FacetTree<d>::Hit& hit, int facet) const;

  WallSpec<d> spec_;
  FacetTree<d> tree_;
  std::vector<FacetTree<d>> patch_tree_;
  std::vector<std::vector<int>> patch_facets_;
  std::vector<int> patch_of_;
  Eigen::Matrix<double, d, Eigen::Dynamic> normal_;         // of facets, unit
  Eigen::Matrix<double, d, Eigen::Dynamic> vertex_normal_;  // sum over the facets around a vertex
  std::vector<std::vector<int>> facets_of_;
  std::vector<int> sharp_;
  std::vector<Bend> bends_;
  std::vector<char> is_sharp_;
  Eigen::AlignedBox<double, d> box_;
  bool turned_inside_out_;  // a tank: the solid is outside the box
  double tiny_;  // length below which points coincide
};

extern template class Wall<2>;
extern template class Wall<3>;

}  // namespace splashdown::fluid
