// What of a closed surface lies in a box.
#pragma once

#include <Eigen/Geometry>

#include "core/types.hpp"

namespace splashdown {

/// The boundary of the solid's part in the box, closed, normals outward; without facets: there is none. In 2D parts that hang together
/// by an edge of the box alone count as one. Throws std::invalid_argument for surfaces that cut themselves. World frame or any other [m].
template <int d>
Surface<d> clipped_to_box(const Surface<d>& surface, const Eigen::AlignedBox<double, d>& box);

template <>
Surface<2> clipped_to_box(const Surface<2>&, const Eigen::AlignedBox2d&);
template <>
Surface<3> clipped_to_box(const Surface<3>&, const Eigen::AlignedBox3d&);

}  // namespace splashdown
