// A member of a class of scenes and the laws it has to obey.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace splashdown::ensemble {

inline constexpr double g = 9.81;        // [m/s^2]
inline constexpr double water = 1000.0;  // [kg/m^3]

/// The water may not hold more energy than it had and was given.
struct EnergyLaw {
  double bound = 0.02;   ///< of what the walls gave, or of `scale` if that is more
  double scale = 0;      ///< [J; 2D: J/m]
  double remesh = 0.02;  ///< bound of what remeshing alone may give, over the same
  double in_most = 0;    ///< bound that holds in 95 of 100 members, 0: none
};

/// Nothing moves faster than pressure, gravity and walls can make it.
struct SpeedLaw {
  double nodes = std::numeric_limits<double>::infinity();   ///< [m/s]
  double bodies = std::numeric_limits<double>::infinity();  ///< centres of mass [m/s]
};

/// Water neither comes nor goes.
struct VolumeLaw {
  double bound = 0.005;  ///< of `scale`
  double scale = 1;      ///< [m^3; 2D: m^2]
};

/// A single body, at rest and wet all around, starts with (M_d - m) g / (m + M_a).
struct ReleaseLaw {
  double bound = 0.05;
  double water = 0;  ///< volume of the liquid if the body were not there: the mesh's displacement is the rest
};

struct Laws {
  std::optional<double> refused = 0.03;  ///< share of steps
  std::optional<int> passes = 1;         ///< most of a step
  std::optional<EnergyLaw> energy;
  std::optional<SpeedLaw> speed;
  std::optional<VolumeLaw> volume;
  std::optional<ReleaseLaw> release;
  /// Impossible scenes: a run that is refused (2), stops with a cause (3) or calls itself unphysical obeys all laws.
  bool may_be_refused = false;
  /// Bodies so close to each other that no mesh may fill what is between them: refused before the first step (2) is right.
  bool may_not_be_meshed = false;
};

struct TextFile {
  std::string name, text;
};

struct Member {
  std::string kind;  ///< its class
  std::uint64_t seed = 0;
  std::string what;                          ///< in a few words
  std::string scene;                         ///< TOML
  std::vector<std::filesystem::path> files;  ///< of this project, to lie beside the scene
  std::vector<TextFile> texts;               ///< made for it, to lie beside the scene

  /// The scene, as "scene.toml", and its files.
  void write_to(const std::filesystem::path& folder) const;
  Laws laws;
};

}  // namespace splashdown::ensemble
