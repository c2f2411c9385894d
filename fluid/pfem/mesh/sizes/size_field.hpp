// Element size h(x): the smallest of all sources' h_source + growth * distance, at most `far`.
#pragma once

#include <span>
#include <vector>

#include "fluid/pfem/mesh/recognition/recognise.hpp"
#include "fluid/pfem/mesh/sizes/size_sources.hpp"
#include "fluid/pfem/spec.hpp"

namespace splashdown::fluid {

/// Element size at a bend of a wall [m]: `curvature` times its radius, but no less than a quarter of the wall's own size.
double size_at_bend(const SizeSpec& spec, double wall_size, double radius);

/// Where elements are smaller than `wall_size`, that of the wall [m]: at its bends and, of hulls, at corners. In the wall's
/// frame.
template <int d>
std::vector<SizeSource<d>> spots_of(const SizeSpec& spec, const Wall<d>& wall, double wall_size);

/// h(x) of one mesh [m], world frame. Const calls may come from all threads.
template <int d>
class SizeField {
 public:
  /// `wetted`: wetted measure of each wall [m in 2D]; `mesh`: its free boundary is a source.
  SizeField(const SizeSpec& spec, const WallsAt<d>& walls, std::span<const double> wetted, std::span<const Vec<d>> x,
            const Mesh<d>& mesh);
  /// `on_wall`: the wall that the point is known to lie on, -1: none is. In 2D it is asked all the same.
  double operator()(const Vec<d>& point, int on_wall = -1) const;
  /// Element size on this wall away from bends and corners [m].
  double at_wall(std::size_t wall) const { return wall_size_[wall]; }

 private:
  using Source = SizeSource<d>;
  void find_spots();
  void find_hollows(std::span<const Vec<d>> x, const Mesh<d>& mesh);
  void add(std::vector<Source> found);

  SizeSpec spec_;
  WallsAt<d> walls_;
  std::vector<double> wall_size_;
  FacetTree<d> surface_;
  SizeSources<d> points_;  // bends and corners of walls, hollows
};

extern template class SizeField<2>;
extern template class SizeField<3>;

}  // namespace splashdown::fluid
