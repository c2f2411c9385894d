// Elements on and beside a hull, by how far it is wetted.
#pragma once

#include <algorithm>
#include <limits>

#include "apps/scene/outlook/motion_guess.hpp"
#include "apps/scene/scene.hpp"

namespace splashdown::apps {

/// Elements on a hull whose wetted facets have that length [m].
inline double size_on_hull(const Scene& scene, const Body& body, double length) {
  return std::max(body.size, scene.fluid->size.wetted_fraction * length);
}

template <int d>
double wetted_width(const WettedEnds<d>& ends) {
  return (ends.template tail<d - 1>() - ends.template head<d - 1>()).maxCoeff();
}

/// Elements that are asked for at the root of its jet [m]; none: as large as they like.
template <int d>
double size_at_root(const Scene& scene, const Body& body, double half) {
  const auto& size = scene.fluid->size;
  const auto jet = size.hollow ? jet_thickness<d>(body, half) : std::nullopt;
  return jet ? std::max(size.hollow_min, *size.hollow * *jet) : std::numeric_limits<double>::max();
}

}  // namespace splashdown::apps
