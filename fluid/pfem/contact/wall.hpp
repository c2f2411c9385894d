// A wall in motion: closest points and sides of its surface, its sharp vertices. Which facets and edges are smooth, flat, convex
// is that of the surface as it was made.
#pragma once

#include <algorithm>
#include <numbers>
#include <vector>

#include "core/facet_tree.hpp"
#include "fluid/pfem/nodes.hpp"
#include "fluid/pfem/spec.hpp"
#include "fluid/pfem/wall_place.hpp"

namespace splashdown::fluid {

/// cos 30 degrees. Facets, and lines, that turn by more meet at a crease or a corner; by less they follow a curve.
constexpr double least_smooth_cosine = 0.5 * std::numbers::sqrt3;

/// The surface of a wall, searched in trees: O(log n) a query. `pose`: where it is. Const calls may come from
/// all threads.
template <int d>
class Wall {
 public:
  /// Finds patches, creases, corners and bends of its surface; copies the spec.
  explicit Wall(const WallSpec<d>& spec);

  /// Where it was made.
  WallPlace<d> place() const;
  /// The velocity that it was made with.
  WallVelocity<d> velocity() const;
  /// Where it is after `dt` [s] with velocity s.
  WallPlace<d> moved(const WallPlace<d>& from, const WallVelocity<d>& s, double dt) const;
  /// Its surface with the vertices there [m], world frame. Of a wall that deforms.
  WallPlace<d> shaped(AtVertices<d> vertices) const;
  /// Where a point on or near its surface is that was at `made`, wall frame, in the surface as it was made.
  Vec<d> carried(const WallPlace<d>& pose, const Vec<d>& made) const;
  /// Where a point x around which the wall lies is carried by it.
  Vec<d> carried(const WallPlace<d>& from, const WallPlace<d>& to, const Vec<d>& x) const;

  /// The closest point of the wall, and what it lies on.
  struct Near {
    Vec<d> point;     ///< closest point of the wall, world frame
    Vec<d> normal;    ///< of the facet it lies on, out of the solid
    double distance;  ///< signed: negative inside the solid
    int patch;        ///< smooth patch the point lies on
    int vertex;       ///< corner that is the closest point, -1: none
    int crease = -1;  ///< crease that the closest point lies on, -1: none; corners lie on none
    /// Whether it is a corner or lies on a crease.
    bool sharp() const { return vertex >= 0 || crease >= 0; }
  };

  /// Where a segment passes a crease.
  struct Crossing {
    int crease = -1;
    Vec<d> point = Vec<d>::Zero();  ///< of the crease, world frame
    double distance = 0;            ///< from there to the segment
    double share = 0;               ///< of the segment, from `from` to its point nearest to the crease
  };
  /// Closest point of the wall in the given pose; distance = +reach where nothing is nearer.
  Near nearest(const WallPlace<d>& pose, const Vec<d>& x, double reach) const;
  /// The same on one smooth patch alone, wherever x is.
  Near nearest_on_patch(const WallPlace<d>& pose, const Vec<d>& x, int patch) const;
  /// Closest point of a crease.
  Vec<d> nearest_on_crease(const WallPlace<d>& pose, const Vec<d>& x, int crease) const;
  /// Unit vector along the crease where it is nearest.
  Vec<d> crease_direction(const WallPlace<d>& pose, const Vec<d>& x, int crease) const;
  /// The crease of this wall that a segment passes nearest to; crease = -1 without any.
  Crossing nearest_crease(const WallPlace<d>& pose, const Vec<d>& from, const Vec<d>& to) const;
  /// Whether the solid is convex along this crease, or along one that ends at this corner: water flows around it. In hollow
  /// ones it stays.
  bool is_convex(const WallTie& sharp) const {
    return sharp.vertex >= 0 ? convex_corner_[sharp.vertex] != 0 : convex_crease_[sharp.crease] != 0;
  }
  /// Whether a node could be tied like this: to a patch, corner and crease that there are.
  bool has(const WallTie& tie) const {
    return tie.patch >= -1 && tie.patch < static_cast<int>(is_flat_.size()) && tie.vertex >= -1 &&
           tie.vertex < static_cast<int>(spec_.surface.vertices.cols()) && tie.crease >= -1 &&
           tie.crease < static_cast<int>(creases_.size());
  }
  /// Whether the solid is surely convex: what lies between points of it lies in it, and behind the plane of each facet. In 3D.
  bool is_convex() const { return is_convex_; }
  /// Whether a corner or a crease lies in the plane of symmetry, where it is none or turns to its own mirror image.
  bool is_in_mirror(int vertex, int crease) const {
    return vertex >= 0 ? in_mirror_[vertex] != 0 : crease >= 0 && mirrored_crease_[crease] != 0;
  }
  /// The crease in the plane of symmetry that is nearest to x; crease = -1 without any. In 3D.
  Crossing nearest_in_mirror(const WallPlace<d>& pose, const Vec<d>& x) const;
  /// Whether all facets of this smooth patch lie in one plane.
  bool is_flat(int patch) const { return is_flat_[patch] != 0; }
  /// Of a flat patch, out of the solid, world frame.
  Vec<d> flat_normal(const WallPlace<d>& pose, int patch) const {
    return pose.linear() * shape(pose).normal.col(patch_facets_[patch].front());
  }
  /// In 3D; false in 2D.
  bool has_creases() const { return !creases_.empty(); }
  /// False only where the point is surely farther than `margin` from the solid; cheap.
  bool may_touch(const WallPlace<d>& pose, const Vec<d>& x, double margin) const {
    const Vec<d> local = pose.linear().transpose() * (x - pose.translation());
    if (!turned_inside_out_) return shape(pose).box.squaredExteriorDistance(local) <= margin * margin;
    return basin_.empty() || std::any_of(basin_.begin(), basin_.end(), [&](const Plane& p) {
             return p.normal.dot(local) - p.offset <= margin + tiny_;
           });
  }
  /// Distance of x from the surface [m], on either side of it; `reach` where nothing is nearer. `slack`: relative error allowed.
  double distance_unsigned(const WallPlace<d>& pose, const Vec<d>& x, double reach, double slack = 0) const;
  /// The same, of a tank without its side in the plane of symmetry, which is no solid.
  double distance_of_solid(const WallPlace<d>& pose, const Vec<d>& x, double reach, double slack = 0) const;
  /// Whether a smooth patch is that side.
  bool is_mirror(int patch) const { return patch >= 0 && patch == mirror_patch_; }
  /// A tank that has a side there.
  bool ends_at_mirror() const { return turned_inside_out_ && spec_.mirror; }
  /// Vertex v of the surface, world frame [m].
  Vec<d> vertex(const WallPlace<d>& pose, int v) const {
    const Vec<d> x = pose * Vec<d>(shape(pose).vertices.col(v));
    return in_mirror_[v] && !turned_inside_out_ ? spec_.mirror->template onto<d>(x) : x;
  }
  /// Vertices that are corners, those included at which nothing but the plane of symmetry ends a patch: `is_smooth`.
  const std::vector<int>& corners() const { return corners_; }
  /// Whether nothing but the plane of symmetry makes this vertex a corner.
  bool is_smooth(int corner) const { return smooth_corner_[corner] != 0; }
  /// Whether water flows past the node as it does past a smooth face. In space such nodes move along the crease in the plane.
  bool is_smooth(const WallTie& tie) const {
    return !tie.sharp() || (d == 2 && tie.vertex >= 0 && is_smooth(tie.vertex));
  }
  /// As it was made.
  const WallSpec<d>& spec() const { return spec_; }
  /// A vertex of a smooth patch that is curved there.
  struct Bend {
    Vec<d> at;      ///< wall frame
    double radius;  ///< of curvature, the smallest along the edges that meet there [m]
  };
  /// All bends of its patches.
  const std::vector<Bend>& bends() const { return bends_; }
  /// Centre of the volume that the surface encloses, wall frame, and how deep in the solid it lies: negative outside of it.
  const Vec<d>& centre() const { return centre_; }
  /// The same in the world; in the plane of symmetry, if there is one.
  Vec<d> centre_at(const WallPlace<d>& pose) const {
    const Vec<d> x = pose.shape() ? centre_of(*pose.shape()) : pose * centre_;
    return spec_.mirror ? spec_.mirror->template onto<d>(x) : x;
  }
  double depth_of_centre() const { return depth_of_centre_; }  ///< [m]
  bool encloses_fluid() const { return turned_inside_out_; }   ///< a tank
  /// Box around the surface in the wall frame.
  const Eigen::AlignedBox<double, d>& box() const { return made_->box; }
  /// Diagonal of the box [m].
  double diameter() const { return box().diagonal().norm(); }

 private:
  /// In the frame of the place: as it was made, unless it deforms.
  const WallShape<d>& shape(const WallPlace<d>& pose) const { return pose.shape() ? *pose.shape() : *made_; }
  std::shared_ptr<WallShape<d>> shape_of(AtVertices<d> vertices) const;
  Vec<d> centre_of(const WallShape<d>& shape) const;
  void find_sides();
  void find_sides_of_mirror();
  bool lies_in_mirror(int f) const;
  void find_centre();
  void find_creases();
  void find_corners();
  void find_patches();
  void find_bends();
  void find_convexity();
  bool is_in_one_piece() const;
  void find_basin();
  bool is_crease(int f, int g) const;
  bool is_hollow(int f, int g) const;
  bool ends_patch(int f, int g) const { return is_crease(f, g) || side_[f] * side_[g] < 0; }
  struct OnCrease {
    Vec<d> point, along;  // in the wall's frame
  };
  struct Plane {
    Vec<d> normal;
    double offset;
  };
  OnCrease on_crease(const WallPlace<d>& pose, const Vec<d>& local, int crease) const;
  Near near_of(const WallPlace<d>& pose, const Vec<d>& local, const typename FacetTree<d>::Hit& hit, int facet) const;

  WallSpec<d> spec_;
  std::shared_ptr<WallShape<d>> made_;  // in its frame
  FacetTree<d> solid_tree_;             // only for tanks that end at a mirror
  std::vector<std::vector<int>> patch_facets_;
  std::vector<int> patch_of_;
  std::vector<char> is_flat_;  // of patches
  std::vector<std::vector<int>> facets_of_;
  Eigen::Matrix<int, d, Eigen::Dynamic> across_;          // 3D: facet beyond the edge from corner k to the next
  Eigen::Matrix<int, d, Eigen::Dynamic> crease_of_;       // 3D: crease that this edge is part of, -1: smooth
  std::vector<std::vector<std::array<int, 2>>> creases_;  // edges of each
  std::vector<int> corners_;
  std::vector<Bend> bends_;
  std::vector<char> is_corner_, is_sharp_;           // of vertices; sharp: a corner or on a crease
  std::vector<char> convex_corner_, convex_crease_;  // of vertices, of creases
  int mirror_patch_ = -1;                            // of a tank that ends at a plane of symmetry
  std::vector<signed char> side_;                    // of the plane of symmetry, of facets; 0: there is none
  std::vector<char> in_mirror_, mirrored_crease_, smooth_corner_;  // of vertices, of creases, of vertices
  bool turned_inside_out_;                                         // the solid is outside
  bool is_convex_ = false;
  std::vector<Plane> basin_;  // that bound a convex tank of few sides; otherwise none
  Vec<d> centre_;
  double depth_of_centre_;
  double tiny_;  // length below which points coincide
};

extern template class Wall<2>;
extern template class Wall<3>;

}  // namespace splashdown::fluid
