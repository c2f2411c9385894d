// The paddle of [wavemaker] in its flume: where it stands, how it moves, what it sends out by theory.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "apps/effects/wavemaker/wavemaker.hpp"

namespace splashdown::fluid {
class PaddleSea;
}

namespace splashdown::apps {

/// The water that the paddle moves: a box from the paddle's face at rest to the tank's other end.
struct Flume {
  double face = 0;     ///< of the paddle at rest, along x [m]
  double inward = 1;   ///< 1: the water is at larger x; -1: at smaller
  double behind = 0;   ///< dry length of the tank [m]
  double depth = 0;    ///< [m]
  double free = 0;     ///< height of the tank above the still level [m]
  double gravity = 0;  ///< [m/s^2]
};

/// Nothing where the scene has no such box, or no gravity straight down.
std::optional<Flume> flume_of(const Scene& scene, const Wavemaker& table);

/// What the theory says of the table's waves.
struct Forecast {
  double wave_number = 0;  ///< of the waves, or of those at the spectrum's peak [1/m]
  double height = 0;       ///< far away, or the significant one [m]
  double highest = 0;      ///< of the waves that are to be expected [m]
  double stroke = 0;       ///< at the still level, from end to end; of an irregular sea four standard deviations [m]
  double length() const;   ///< [m]
};
Forecast forecast(const Wavemaker& table, const Flume& flume);

/// The irregular sea; null for regular waves.
std::shared_ptr<const fluid::PaddleSea> sea_of(const Wavemaker& table, const Flume& flume);

/// Of the paddle from the hinge or the floor up [m].
double paddle_height(const Wavemaker& table, const Flume& flume);
/// Share of the tank above the still level that the paddle fills.
inline constexpr double share_of_freeboard = 0.9;

/// Dry tank that the paddle on this path needs behind its face at rest [m].
double room_behind(const Wavemaker& table, const Flume& flume, const std::vector<Waypoint>& path);

/// The paddle, and what stands still below its hinge.
std::vector<Body> paddle_and_sill(const Scene& scene, const Wavemaker& table, const Flume& flume);

}  // namespace splashdown::apps
