// Integrals over simplices in any dimension. Internal to the rigid-body room.
#pragma once

#include <array>

#include "rigid/types.hpp"

namespace splashdown::rigid {

/// Corners of one facet of a surface.
template <int d>
using FacetCorners = std::array<Vec<d>, static_cast<std::size_t>(d)>;

/// In the surface's frame and orientation [m].
template <int d>
FacetCorners<d> facet_corners(const Surface<d>& surface, Eigen::Index facet) {
  FacetCorners<d> corners;
  for (int k = 0; k < d; ++k) corners[static_cast<std::size_t>(k)] = surface.vertices.col(surface.facets(k, facet));
  return corners;
}

/// Moments of a facet, or of the cone over it from the origin: (sum x, sum x x^T) up to the measure.
template <int d>
struct CornerSums {
  Vec<d> first = Vec<d>::Zero();
  Eigen::Matrix<double, d, d> second = Eigen::Matrix<double, d, d>::Zero();
  /// Of a facet's corners [m].
  explicit CornerSums(const FacetCorners<d>& corners) {
    for (const Vec<d>& x : corners) {
      first += x;
      second += x * x.transpose();
    }
    second += first * first.transpose();
  }
};

/// Signed measure of the cone from the origin: det(corners) / d!.
template <int d>
double cone_measure(const FacetCorners<d>& corners) {
  Eigen::Matrix<double, d, d> m;
  double factorial = 1;
  for (int k = 0; k < d; ++k) {
    m.col(k) = corners[static_cast<std::size_t>(k)];
    factorial *= k + 1;
  }
  return m.determinant() / factorial;
}

}  // namespace splashdown::rigid
