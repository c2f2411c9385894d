// [wind]: the motion of the air. It acts on bodies with [body.aero], and it is the stream of a fluid on a grid.
#pragma once

#include "apps/scene/kinds/effect_kind.hpp"
#include "rigid/forces/wind/wind.hpp"

namespace splashdown::apps {

struct GustTable {
  Point velocity = Point::Zero();  ///< at its peak, added [m/s]
  double start = 0;                ///< [s]
  double duration = 1;             ///< [s]
};

struct WindTable {
  Point velocity = Point::Zero();   ///< at `height` [m/s]
  std::string profile = "uniform";  ///< "uniform" | "log"
  double height = 10;               ///< over the water, where `velocity` is measured [m]
  double roughness = 2e-4;          ///< of the surface [m]; open sea (Wieringa 1992)
  std::optional<double> level;      ///< of the surface [m]; default: that of still water
  std::optional<GustTable> gust;
};

/// As bodies feel it.
template <int d>
rigid::Wind<d> wind_of(const WindTable& table, const Scene& scene);

class WindKind final : public EffectOf<WindKind, WindTable> {
 public:
  std::string_view name() const override { return "wind"; }
  bool knows_no_mesh() const override { return true; }
  void read(Reader& reader, Scene& scene) const override;
  void check(const Scene& scene, Problems& problems) const override;
  void ask(const AskedScene& asked, std::vector<std::string>& questions) const override;
  std::optional<std::string> asymmetry(const Scene& scene, const Mirror& mirror) const override;
  std::optional<EffectNote> note(const Scene& scene, const Scales& scales) const override;
};

}  // namespace splashdown::apps
