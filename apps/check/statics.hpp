// Numbers of a body at rest on still water: what `check` prints, and what a run's report sets beside its end.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/check/rest.hpp"
#include "apps/statistics/foreseen.hpp"
#include "rigid/shapes/hydrostatics.hpp"

namespace splashdown::apps {

/// Round-off of an angle that is meant to be zero is not shown.
double without_roundoff(double degrees);

/// Levers below this share of the extent are those of a round body's facets.
inline constexpr double facets_of_round = 1e-4;

template <int d>
double diagonal(const rigid::BodySpec<d>& spec);

/// The curve of righting levers of a body that floats alone: heeled about its length to starboard, free to sink and to trim.
struct Righting {
  std::vector<rigid::Heeled> curve;  ///< each 15 degrees, until 180 or where it ends
  bool ends = false;                 ///< before 180 degrees
  bool round = false;                ///< it keeps any heel
  bool rights = false;               ///< it comes back from a small heel
  double range = 0;                  ///< up to this heel [deg]
  double most = 0, most_at = 0;      ///< largest lever [m], and its heel [deg]
};
Righting righting_of(const Scene& scene, const Resting<3>& resting, double level);

/// GM in roll and in pitch [m]; 0 for what facets of a round body leave.
std::array<double, 2> metacentric_heights(const Resting<3>& resting);

/// What keeps a body from floating as if it were alone: "hinge to the world; touches what it meets".
template <int d>
std::string held_text(const Scene& scene, std::size_t number, const rigid::BodyAtRest<d>& rest);

/// By body; absent for those that at_rest leaves out. Cost: that of at_rest, and some 20 ms a body of 1000 facets for its levers.
template <int d>
std::vector<std::optional<AtRest>> statics_of(const Scene& scene);

}  // namespace splashdown::apps
