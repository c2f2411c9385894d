// What closed formulas and statics say of a body without a run, for reports beside what the run found.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace splashdown::apps {

/// The load of an impact between two theories (apps/scene/outlook/impact_theory.hpp).
struct LoadBand {
  std::vector<double> time;       ///< [s]
  std::vector<double> low, high;  ///< von Karman's and Wagner's, upwards [N, N/m]
};

/// At rest on still water; nan: not known, or not of this dimension.
struct AtRest {
  bool sinks = false;
  double draft = std::numeric_limits<double>::quiet_NaN();                                                  ///< [m]
  double heel = std::numeric_limits<double>::quiet_NaN(), trim = std::numeric_limits<double>::quiet_NaN();  ///< [deg]
  double gm_roll = std::numeric_limits<double>::quiet_NaN(),
         gm_pitch = std::numeric_limits<double>::quiet_NaN();  ///< [m]
  std::vector<double> heels, levers;  ///< heel to starboard [deg], GZ [m]; empty: none to speak of
  double rights_up_to = std::numeric_limits<double>::quiet_NaN();  ///< heel from which it does not come back [deg]
  std::string held;                                                ///< what keeps it from floating as if it were alone
};

/// What the pressure of water at rest is told by: density gravity (level - height), none above.
struct StillWater {
  double density = 0, gravity = 0, level = 0;  ///< [kg/m^3], downward [m/s^2], [m]
};

struct Foreseen {
  std::optional<double> mass;  ///< [kg, kg/m]
  std::optional<LoadBand> load;
  std::optional<AtRest> rest;
};

}  // namespace splashdown::apps
