// [waves]: a sea that is there at t = 0 and that zones along the tank's sides keep alive.
#pragma once

#include "apps/effects/waves/table.hpp"
#include "apps/scene/kinds/effect_kind.hpp"

namespace splashdown::apps {

class WavesKind final : public EffectOf<WavesKind, Waves> {
 public:
  std::string_view name() const override { return "waves"; }
  TablePlace place() const override { return TablePlace::after_bodies; }
  void read(Reader& reader, Scene& scene) const override;
  void check(const Scene& scene, Problems& problems) const override;
  void ask(const AskedScene& asked, std::vector<std::string>& questions) const override;
  std::optional<EffectNote> note(const Scene& scene, const Scales& scales) const override;
  std::optional<WantedSize> surface_size(const Scene& scene) const override;
  std::optional<std::string> asymmetry(const Scene& scene, const Mirror& mirror) const override;
  std::vector<KnownSignal> signals(const Scene& scene) const override;

 private:
  friend EffectOf;
  template <int d>
  void prepare_in(const Scene& scene, fluid::FluidSpec<d>& spec) const;
  template <int d>
  void build_in(const Scene& scene, const EffectParts<d>& parts) const;
};

}  // namespace splashdown::apps
