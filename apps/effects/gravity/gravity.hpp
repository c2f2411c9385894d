// [gravity]: a uniform acceleration of water and bodies.
#pragma once

#include "apps/scene/kinds/effect_kind.hpp"

namespace splashdown::apps {

/// Its table is Scene::gravity: levels, steps and sizes follow from it as well.
class GravityKind final : public EffectOf<GravityKind, Gravity> {
 public:
  std::string_view name() const override { return "gravity"; }
  bool knows_no_mesh() const override { return true; }
  bool present(const Scene& scene) const override { return scene.gravity.has_value(); }
  void read(Reader& reader, Scene& scene) const override;
  std::optional<std::string> asymmetry(const Scene& scene, const Mirror& mirror) const override;
  std::optional<EffectNote> note(const Scene& scene, const Scales& scales) const override;
  std::optional<Advice> advise(const Outlook& look) const override;

 private:
  friend EffectOf;
  template <int d>
  void build_in(const Scene& scene, const EffectParts<d>& parts) const;
};

}  // namespace splashdown::apps
