// Bodies that will meet a wall, or each other, where nothing holds them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/scene.hpp"

namespace splashdown::apps {

/// Where a body is guessed to go through a wall first.
struct WallMeeting {
  std::size_t body;
  std::string wall;  ///< "the tank's floor", "body.NAME"
  double time = 0;   ///< [s]
};

/// Displacements only, without turning: (m + M_a) v keeps its momentum but for weight and buoyancy, M_a and the displaced volume
/// growing with the share of the hull's height that is under water (von Karman 1929); M_a of the whole hull is twice what a plate of
/// its plan area meets at the surface (`impact_mass`). No drag. Bodies that joints tie are left out. Nothing with [contact].
template <int d>
std::optional<WallMeeting> guessed_meeting(const Scene& scene);

/// The question about it; none if there is none.
template <int d>
std::vector<std::string> questions_about_walls(const Scene& scene);

}  // namespace splashdown::apps
