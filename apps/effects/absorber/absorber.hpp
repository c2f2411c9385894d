// [fluid.absorber]: numerical beaches at one end of the tank or both.
#pragma once

#include "apps/scene/kinds/effect_kind.hpp"

namespace splashdown::apps {

struct Absorber {
  double width = 0;           ///< of each zone [m]
  std::string ends = "both";  ///< of the tank on the first axis: "both" | "lower" | "upper"
  double rate = 0;            ///< damping rate at the wall; rises smoothly from 0 at the zone's edge [1/s]
};

class AbsorberKind final : public EffectOf<AbsorberKind, Absorber> {
 public:
  std::string_view name() const override { return "absorber"; }
  TablePlace place() const override { return TablePlace::fluid; }
  void read(Reader& reader, Scene& scene) const override;
  void check(const Scene& scene, Problems& problems) const override;
  void ask(const AskedScene& asked, std::vector<std::string>& questions) const override;
  std::optional<std::string> asymmetry(const Scene&, const Mirror&) const override { return {}; }
  std::optional<EffectNote> note(const Scene& scene, const Scales& scales) const override;
  std::optional<Advice> advise(const Outlook& look) const override;

 private:
  friend EffectOf;
  template <int d>
  void build_in(const Scene& scene, const EffectParts<d>& parts) const;
};

}  // namespace splashdown::apps
