// Outlines of holes, divided into edges of the mesh: straight pieces and curves apart, corners kept.
#pragma once

#include <span>
#include <vector>

#include "fluid/ale/mesh/flow_mesh.hpp"

namespace splashdown::ale {

/// The closed outline of a hole, by arc length from its first point.
class HullLine {
 public:
  /// `points` counter-clockwise; `walls`: of the edge that begins at each.
  HullLine(std::vector<Vec<2>> points, std::vector<int> walls);
  /// Divides it: edges of `sizes[wall]` at most [m], and that turn by half a radian at most; towards corners that jut out they
  /// shrink to `spec.corner` of it, by `spec.growth`.
  void divide(std::span<const double> sizes, const MeshSpec& spec);
  /// Divides it at these arc lengths, ascending [m].
  void cut_at(std::vector<double> cuts) { cuts_ = std::move(cuts); }
  /// Divides it at its points.
  void cut_at_points() { cuts_.assign(starts_.begin(), starts_.end() - 1); }
  /// Arc lengths at which edges of the mesh begin, ascending [m].
  const std::vector<double>& cuts() const { return cuts_; }
  double length() const { return starts_.back(); }  ///< [m]
  /// The point at an arc length of any sign [m].
  Vec<2> at(double arc) const;
  /// The wall that an arc length lies on.
  int wall_at(double arc) const;
  /// Between two arc lengths, the shorter way around.
  double middle(double from, double to) const;
  /// Whether a point lies inside.
  bool holds(const Vec<2>& point) const;

 private:
  std::size_t edge_at(double& arc) const;
  double turn_at(std::size_t point) const;
  void divide_piece(std::size_t from, std::size_t to, double size, const MeshSpec& spec);

  std::vector<Vec<2>> points_;
  std::vector<int> walls_;
  std::vector<double> starts_;  // arc length of each point, and of the first one after a round
  std::vector<double> cuts_;
};

/// Outlines of the holes that hulls make together. Throws std::invalid_argument as core/surface/unite.hpp does.
std::vector<HullLine> hull_lines(const std::vector<Hole>& hulls);
/// The same of a mesh, divided into its edges; none without hulls.
std::vector<HullLine> divided_lines(const MeshSpec& spec);

}  // namespace splashdown::ale
