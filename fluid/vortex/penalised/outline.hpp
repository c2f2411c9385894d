// Where a closed outline covers the faces of a grid, and what it encloses.
//
// Sharp: a face is inside or not. Smoothed over a width e on either side, with the distance phi to the outline
// (Peskin's cosine, Acta Numerica 11, 2002, integrated): chi = (1 - x - sin(pi x)/pi)/2 where |x| < 1, x = phi/e + 1/3.
#pragma once

#include <vector>

#include "core/types.hpp"
#include "fluid/vortex/grid.hpp"

namespace splashdown::vortex {

/// Of a polygon, about the origin of its frame; negative where it is turned inside out.
struct OutlineMoments {
  double area = 0;                                 ///< [m^2]
  Vec<2> centroid = Vec<2>::Zero();                ///< [m]
  double polar = 0;                                ///< int r^2 [m^4]
  double length = 0;                               ///< of the outline [m]
  bool is_inside_out() const { return area < 0; }  ///< solid outside, as a tank is
};
/// Exact for polygons.
OutlineMoments moments_of(const Surface<2>& outline);

/// A rectangle of nodes (i0 + i, j0 + j), 0 <= i < width, 0 <= j < height, and of the faces between them.
struct FaceBox {
  int i0 = 0, j0 = 0, width = 0, height = 0;
  std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }  ///< nodes
  /// Index of its node (i, j).
  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i);
  }
  /// The same nodes.
  bool operator==(const FaceBox&) const = default;
};

/// The box around an outline at a pose with `margin` nodes on each side, its sizes multiples of eight; it may reach
/// out of the grid.
FaceBox box_around(const Grid& grid, const Surface<2>& outline, const Isometry<2>& pose, double width, int margin);

/// chi on the faces of a box, by indices of the box. `width`: of the smoothing [m], 0: sharp. `inside_out`: of what
/// lies outside.
void cover(const Grid& grid, const FaceBox& box, const Surface<2>& outline, const Isometry<2>& pose, double width,
           bool inside_out, FaceField& chi);

}  // namespace splashdown::vortex
