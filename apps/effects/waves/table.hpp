// [waves] as plain data.
#pragma once

#include <optional>
#include <string>

#include "apps/scene/scene.hpp"

namespace splashdown::apps {

/// Lengths in [m], times in [s]. What belongs to other types of sea keeps its default.
struct Waves {
  std::string type;  ///< "regular", "irregular", "focused"

  // regular
  std::string theory = "stream_function";  ///< or "linear"
  double height = 0;                       ///< crest above trough
  std::optional<double> period, length;    ///< one of them
  double phase_deg = 0;                    ///< at the tank's middle at t = 0: how far the last crest has passed [deg]

  // irregular and focused
  double significant_height = 0;
  double peak_period = 0;
  double gamma = 3.3;           ///< of JONSWAP; 1: Pierson and Moskowitz
  int seed = 1;                 ///< of phases and directions
  double spreading = 0;         ///< s of cos^2s(angle / 2); 0: none. In three dimensions
  int repeat = 100;             ///< peak periods after which the sea repeats itself
  double crest = 0;             ///< of the focused group above the still level
  Point focus = Point::Zero();  ///< where it has its crest; the height does not matter
  double focus_time = 0;        ///< and when

  double direction_deg = 0;  ///< in which the waves run, from the x axis; in the plane 0 or 180
  double current = 0;        ///< of the water over ground along the waves [m/s]: periods are those of a fixed observer
  std::optional<double> zone;       ///< width of the zones; default: 1.5 (peak) wavelengths
  std::optional<double> side_zone;  ///< of those along sides that the waves run along; default: none
  std::optional<double>
      rate;         ///< of the zones at the walls [1/s]; default: 36 times the group speed over the (peak) length
  double ramp = 0;  ///< in which the sea grows from still water; 0: it is there at t = 0

  /// Where on the wave a body shall touch the water first.
  struct Touchdown {
    std::size_t body = 0;
    double phase_deg =
        0;  ///< how far the last crest has passed the point of contact: 0 crest, 90 back, 180 trough, 270 front
  };
  std::optional<Touchdown> touchdown;
};

}  // namespace splashdown::apps
