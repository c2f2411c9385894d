#include "apps/effects/theory/theory.hpp"

#include <algorithm>
#include <cmath>

#include "apps/scene/kinds/effect_kind.hpp"

namespace splashdown::apps {

std::span<const TheoryRow> theory_rows() {
  static constexpr TheoryRow rows[] = {
      {"waves", advise_waves},
      {"wind", advise_wind},
      {"skin_friction", advise_skin_friction},
      {"form_drag", advise_form_drag},
      {"surface tension", advise_surface_tension},
      {"compressibility", advise_compressibility},
      {"trapped air", advise_trapped_air},
      {"cavitation", advise_cavitation},
      {"elasticity", advise_elasticity},
      {"turbulence", advise_turbulence},
  };
  return rows;
}

const TheoryRow* theory_of(std::string_view name) {
  const auto rows = theory_rows();
  const auto found = std::ranges::find(rows, name, &TheoryRow::name);
  return found == rows.end() ? nullptr : &*found;
}

std::vector<const TheoryRow*> theory_of_what_is_missing() {
  std::vector<const TheoryRow*> rows;
  for (const auto& row : theory_rows())
    if (std::ranges::none_of(effect_kinds(), [&](const EffectKind* kind) { return kind->name() == row.name; }))
      rows.push_back(&row);
  return rows;
}

double dynamic_pressure(double density, double speed) { return 0.5 * density * speed * speed; }

double reynolds_number(const Outlook& look, double viscosity) {
  return look.scales.density * look.scales.speed * look.scales.length / viscosity;
}

double laminar_friction(double reynolds) { return reynolds > 0 ? 1.33 / std::sqrt(reynolds) : 0; }

double turbulent_friction(double reynolds) {
  const double log = std::log10(std::max(reynolds, 1e4)) - 2;
  return 0.075 / (log * log);
}

}  // namespace splashdown::apps
