// [wavemaker]: a paddle at one end of the tank that sends waves along it.
#pragma once

#include "apps/scene/kinds/effect_kind.hpp"

namespace splashdown::apps {

struct Wavemaker {
  std::string type;           ///< "piston" | "flap"
  std::string end = "lower";  ///< of the tank on the first axis: "lower" | "upper"
  double hinge = 0;           ///< of a flap, above the tank's floor [m]; below it the wall is fixed

  // regular waves
  double period = 0;                     ///< [s]
  std::optional<double> height, stroke;  ///< of the waves, of the paddle at the still level: one of them [m]

  // an irregular sea, as in [waves]
  std::optional<double> significant_height;  ///< [m]; there: the sea is irregular
  double peak_period = 0;                    ///< [s]
  double gamma = 3.3;                        ///< of JONSWAP; 1: Pierson and Moskowitz
  int seed = 1;                              ///< of phases
  int repeat = 100;                          ///< peak periods after which the sea repeats itself

  std::optional<double> ramp;  ///< in which the stroke grows from nothing [s]; default: two (peak) periods
};

/// The table becomes a body, `wavemaker`, on a path that it prescribes; with a hinge above the floor another one below it, `sill`.
class WavemakerKind final : public EffectOf<WavemakerKind, Wavemaker> {
 public:
  std::string_view name() const override { return "wavemaker"; }
  TablePlace place() const override { return TablePlace::after_bodies; }
  void read(Reader& reader, Scene& scene) const override;
  void check(const Scene& scene, Problems& problems) const override;
  void ask(const AskedScene& asked, std::vector<std::string>& questions) const override;
  std::optional<EffectNote> note(const Scene& scene, const Scales& scales) const override;
  std::optional<WantedSize> surface_size(const Scene& scene) const override;
  std::vector<KnownSignal> signals(const Scene& scene) const override;

 private:
  friend EffectOf;
};

}  // namespace splashdown::apps
