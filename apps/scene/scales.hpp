// A scene's characteristic numbers, and which effects they call for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/scene.hpp"

namespace splashdown::apps {

struct Scales {
  double length = 0;   ///< largest extent of the first body, else of the first liquid region [m]
  double speed = 0;    ///< of the fastest thing, falls towards the water included [m/s]
  double gravity = 0;  ///< |g| [m/s^2]; 0 without gravity
  double density = 0;  ///< of the liquid [kg/m^3]; 0 without
  double level = 0;    ///< of still water [m]; 0 without
};

template <int d>
Scales scales(const Scene& scene);

/// Gravity that points straight down, along the last axis [m/s^2]; nothing for none, or another.
std::optional<double> straight_pull(const Scene& scene);

/// Highest point of the liquid at t = 0 on its largest region [m]; nothing without liquid.
template <int d>
std::optional<double> still_water_level(const Scene& scene);

/// An effect of the catalogue: at work in this scene, or absent, and the number that says why it matters.
struct EffectNote {
  std::string name;
  bool active = false;
  std::string reason;
};
/// Of all effects of the catalogue (effect_kind.hpp).
template <int d>
std::vector<EffectNote> effect_notes(const Scene& scene);

}  // namespace splashdown::apps
