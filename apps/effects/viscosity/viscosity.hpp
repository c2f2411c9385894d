// [fluid.viscosity]: Newtonian viscosity of the water.
#pragma once

#include "apps/scene/kinds/effect_kind.hpp"

namespace splashdown::apps {

struct Viscosity {
  double dynamic = 1e-3;       ///< [Pa s]; water at 20 C
  std::string walls = "slip";  ///< "slip" | "no_slip"
};

class ViscosityKind final : public EffectOf<ViscosityKind, Viscosity> {
 public:
  std::string_view name() const override { return "viscosity"; }
  TablePlace place() const override { return TablePlace::fluid; }
  void read(Reader& reader, Scene& scene) const override;
  void ask(const AskedScene& asked, std::vector<std::string>& questions) const override;
  std::optional<std::string> asymmetry(const Scene&, const Mirror&) const override { return {}; }
  std::optional<EffectNote> note(const Scene& scene, const Scales& scales) const override;
  std::optional<Advice> advise(const Outlook& look) const override;

 private:
  friend EffectOf;
  template <int d>
  void prepare_in(const Scene& scene, fluid::FluidSpec<d>& spec) const;
  template <int d>
  void build_in(const Scene& scene, const EffectParts<d>& parts) const;
};

}  // namespace splashdown::apps
