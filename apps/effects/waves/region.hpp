// The water of a box under a wavy surface.
#pragma once

#include <functional>

#include "apps/scene/scene.hpp"
#include "core/types.hpp"

namespace splashdown::apps {

/// How finely a surface is drawn, and its heights over the box's top [m].
template <int d>
struct WavySurface {
  Eigen::Matrix<int, d - 1, 1> pieces;  ///< on each horizontal axis
  std::function<double(const Vec<d>&)> elevation;
};

/// The box with its top raised by the elevation less its mean, so that it holds as much water as below a flat one.
template <int d>
Surface<d> wavy_box(const BoxRegion& box, const WavySurface<d>& top);
template <>
Surface<2> wavy_box(const BoxRegion& box, const WavySurface<2>& top);
template <>
Surface<3> wavy_box(const BoxRegion& box, const WavySurface<3>& top);

}  // namespace splashdown::apps
