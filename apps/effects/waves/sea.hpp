// The sea of a scene as a function of place and time.
#pragma once

#include <memory>

#include "apps/effects/waves/table.hpp"
#include "core/types.hpp"

namespace splashdown::fluid {
template <int d>
class WaveField;
template <int d>
struct WaveZones;
}  // namespace splashdown::fluid

namespace splashdown::apps {

/// The liquid region that [waves] acts on: a box over the tank's whole floor. Its number, -1 without.
int wavy_region(const Scene& scene);

/// The sea with its phases: those of the table, or those that let the body touch the water where it shall. Throws
/// std::invalid_argument for waves that break or that the current stops, and for bodies that do not fall into the water.
template <int d>
std::unique_ptr<fluid::WaveField<d>> sea_of(const Scene& scene);

/// Width of the zones at both ends of each axis, and their rate.
template <int d>
fluid::WaveZones<d> zones_of(const Scene& scene, const fluid::WaveField<d>& sea);

/// Where and when a body touches the sea first, without what the air does to it.
template <int d>
struct FirstContact {
  Vec<d> place;
  double time;
};
/// Nothing if it does not before `end`.
template <int d>
std::optional<FirstContact<d>> first_contact(const Scene& scene, const Body& body, const fluid::WaveField<d>& sea,
                                             double level, double end);

}  // namespace splashdown::apps
