// [wavemaker]: a paddle at one end of the tank that sends waves along it.
#pragma once

#include "apps/scene/kinds/effect_kind.hpp"

namespace splashdown::apps {

struct Wavemaker {
  std::string type;                      ///< "piston" | "flap"
  std::string end = "lower";             ///< of the tank on the first axis: "lower" | "upper"
  double period = 0;                     ///< [s]
  std::optional<double> height, stroke;  ///< of the waves, of the paddle at the still level: one of them [m]
  std::optional<double> ramp;            ///< in which the stroke grows from nothing [s]; default: two periods
};

/// The table becomes a body, `wavemaker`, on a path that it prescribes.
class WavemakerKind final : public EffectOf<WavemakerKind, Wavemaker> {
 public:
  std::string_view name() const override { return "wavemaker"; }
  TablePlace place() const override { return TablePlace::after_bodies; }
  void read(Reader& reader, Scene& scene) const override;
  void check(const Scene& scene, Problems& problems) const override;
  void ask(const AskedScene& asked, std::vector<std::string>& questions) const override;
  std::optional<EffectNote> note(const Scene& scene, const Scales& scales) const override;
  std::optional<WantedSize> surface_size(const Scene& scene) const override;

 private:
  friend EffectOf;
};

}  // namespace splashdown::apps
