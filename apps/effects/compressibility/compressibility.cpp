#include "apps/effects/compressibility/compressibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/effects/theory/theory.hpp"
#include "apps/scene/read/reader.hpp"
#include "fluid/effects/compressibility/compressibility.hpp"

namespace splashdown::apps {
namespace {

fluid::CompressibilitySpec spec_of(const Compressibility& table, double density) {
  return {.bulk_modulus = bulk_modulus_of(table, density),
          .bulk_modulus_slope = table.bulk_modulus_slope,
          .gas_content = table.gas_content,
          .ambient_pressure = table.ambient_pressure};
}

/// Of what moves at t = 0 [m/s].
double fastest_start(const Scene& scene) {
  double speed = 0;
  for (const auto& region : scene.fluid->regions) speed = std::max(speed, region.velocity.norm());
  for (const auto& body : scene.bodies) speed = std::max(speed, body.velocity.norm());
  return speed;
}

}  // namespace

double bulk_modulus_of(const Compressibility& table, double density) {
  if (table.bulk_modulus) return *table.bulk_modulus;
  const double c = table.speed_of_sound.value_or(water_sound_speed);
  return density / (1 - table.gas_content) * c * c;
}

double sound_speed_of(const Compressibility& table, double density) {
  return 1 / std::sqrt(density * fluid::liquid_state(spec_of(table, density), 0).compliance);
}

void CompressibilityKind::read(Reader& reader, Scene& scene) const {
  auto& table = scene.effects.table<Compressibility>();
  reader.number("speed_of_sound", table.speed_of_sound, positive("m/s", "Use 1480 for water."));
  if (table.speed_of_sound)
    reader.refuse("bulk_modulus", "is known from speed_of_sound", "Give one of the two.");
  else
    reader.number("bulk_modulus", table.bulk_modulus, positive("Pa", "Use 2.2e9 for water."));
  reader.number("bulk_modulus_slope", table.bulk_modulus_slope,
                within(0, 20, "", "Use 7 for water, 0 for linear acoustics."));
  reader.number("gas_content", table.gas_content, within(0, 0.9, "", "Use e.g. 0.1 for a tenth of the volume."));
  reader.number("ambient_pressure", table.ambient_pressure, positive("Pa", "Use 101325 at sea level."));
}

// The liquid's own speed: that of a mixture at ambient pressure is far below, and rises with the pressure.
void CompressibilityKind::check(const Scene& scene, Problems& problems) const {
  const auto* table = scene.effects.find<Compressibility>();
  if (!table || !scene.fluid || problems.found_in("fluid") || problems.found_in("body")) return;
  const double c =
      std::sqrt(bulk_modulus_of(*table, scene.fluid->density) * (1 - table->gas_content) / scene.fluid->density);
  const double speed = fastest_start(scene);
  if (speed < c) return;
  problems.add(table->bulk_modulus ? "fluid.compressibility.bulk_modulus" : "fluid.compressibility.speed_of_sound",
               fmt::format("sound runs at {:.3g} m/s and must be faster than what moves, {:.3g} m/s", c, speed),
               "Use water's 1480 m/s, or slower motions.");
}

std::optional<EffectNote> CompressibilityKind::note(const Scene& scene, const Scales& s) const {
  if (!scene.fluid) return {};
  const auto* table = scene.effects.find<Compressibility>();
  const double c = table ? sound_speed_of(*table, s.density) : water_sound_speed;
  return EffectNote{"compressibility", table != nullptr,
                    fmt::format("rho c V = {:.3g} Pa, Ma = V/c = {:.3g}{}: no impact presses harder than rho c V{}",
                                s.density * c * s.speed, s.speed / c, table ? "" : " (water)",
                                table ? "" : "; without it a flat hit is an impulse in no time")};
}

std::optional<Advice> CompressibilityKind::advise(const Outlook& look) const {
  if (!look.scene.fluid || !(look.scales.speed > 0)) return {};
  auto advice = advise_compressibility(look);
  if (!present(look.scene)) advice.set = {fmt::format("fluid.compressibility.speed_of_sound={:g}", water_sound_speed)};
  return advice;
}

template <int d>
void CompressibilityKind::build_in(const Scene& scene, const EffectParts<d>& parts) const {
  parts.fluid.push_back(std::make_unique<fluid::Compressibility<d>>(
      spec_of(*scene.effects.find<Compressibility>(), scene.fluid->density)));
}

template void CompressibilityKind::build_in<2>(const Scene&, const EffectParts<2>&) const;
template void CompressibilityKind::build_in<3>(const Scene&, const EffectParts<3>&) const;

}  // namespace splashdown::apps
