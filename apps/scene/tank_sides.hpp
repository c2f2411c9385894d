// The sides of a tank that keep bodies in.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/geometry.hpp"

namespace splashdown::apps {

/// Inside the tank (x - point) . normal > 0.
template <int d>
struct TankSide {
  std::string name;  ///< as messages write it: "the tank's floor"
  rigid::Vec<d> point, normal;
  /// How far x is beyond it [m]; negative inside the tank.
  double depth(const rigid::Vec<d>& x) const { return normal.dot(point - x); }
};

/// All but the top, which is open unless liquid fills the tank up to there. None without a tank.
template <int d>
std::vector<TankSide<d>> tank_sides(const Scene& scene);

}  // namespace splashdown::apps
