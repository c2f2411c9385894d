// [fluid.skin_friction]: friction of the water on hulls, by a friction line.
#pragma once

#include "apps/scene/kinds/effect_kind.hpp"

namespace splashdown::apps {

struct SkinFriction {
  std::string line = "ittc1957";    ///< "ittc1957" | "flat_plate"
  double dynamic_viscosity = 1e-3;  ///< [Pa s]; default: that of [fluid.viscosity], else of water at 20 C
};

class SkinFrictionKind final : public EffectOf<SkinFrictionKind, SkinFriction> {
 public:
  std::string_view name() const override { return "skin_friction"; }
  std::optional<std::string> asymmetry(const Scene&, const Mirror&) const override { return {}; }
  TablePlace place() const override { return TablePlace::fluid; }
  void read(Reader& reader, Scene& scene) const override;
  void check(const Scene& scene, Problems& problems) const override;
  std::optional<EffectNote> note(const Scene& scene, const Scales& scales) const override;
  std::optional<Advice> advise(const Outlook& look) const override;

 private:
  friend EffectOf;
  template <int d>
  void build_in(const Scene& scene, const EffectParts<d>& parts) const;
};

}  // namespace splashdown::apps
