// [fluid.compressibility]: a liquid that carries sound.
#pragma once

#include "apps/scene/kinds/effect_kind.hpp"

namespace splashdown::apps {

struct Compressibility {
  std::optional<double> speed_of_sound;  ///< of the liquid without gas [m/s]
  std::optional<double> bulk_modulus;    ///< the same as rho c^2 [Pa]; water's speed of sound without either
  double bulk_modulus_slope = 0;         ///< dK/dp; 7 for water
  double gas_content = 0;                ///< share of the volume at `ambient_pressure`
  double ambient_pressure = 101325;      ///< [Pa]; used with gas alone
};

/// Of the liquid without gas [Pa].
double bulk_modulus_of(const Compressibility& table, double density);
/// Of the liquid with its gas, at ambient pressure (Wood 1930) [m/s].
double sound_speed_of(const Compressibility& table, double density);

class CompressibilityKind final : public EffectOf<CompressibilityKind, Compressibility> {
 public:
  std::string_view name() const override { return "compressibility"; }
  TablePlace place() const override { return TablePlace::fluid; }
  void read(Reader& reader, Scene& scene) const override;
  void check(const Scene& scene, Problems& problems) const override;
  std::optional<std::string> asymmetry(const Scene&, const Mirror&) const override { return {}; }
  std::optional<EffectNote> note(const Scene& scene, const Scales& scales) const override;
  std::optional<Advice> advise(const Outlook& look) const override;

 private:
  friend EffectOf;
  template <int d>
  void build_in(const Scene& scene, const EffectParts<d>& parts) const;
};

}  // namespace splashdown::apps
