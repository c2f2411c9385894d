#include "apps/effects/skin_friction/skin_friction.hpp"

#include <fmt/format.h>

#include "apps/effects/theory/theory.hpp"
#include "apps/effects/viscosity/viscosity.hpp"
#include "apps/scene/mirror.hpp"
#include "apps/scene/read/reader.hpp"
#include "fluid/effects/skin_friction/skin_friction.hpp"

namespace splashdown::apps {
namespace {

fluid::FrictionLine line_of(const SkinFriction& table) {
  return table.line == "ittc1957" ? fluid::FrictionLine::ittc1957 : fluid::FrictionLine::flat_plate;
}

}  // namespace

void SkinFrictionKind::read(Reader& reader, Scene& scene) const {
  auto& table = scene.effects.table<SkinFriction>();
  if (const auto* viscosity = scene.effects.find<Viscosity>()) table.dynamic_viscosity = viscosity->dynamic;
  reader.choice("line", table.line, {"ittc1957", "flat_plate"});
  reader.number("dynamic_viscosity", table.dynamic_viscosity, positive("Pa s", "Use e.g. 1e-3 for water."));
}

void SkinFrictionKind::check(const Scene& scene, Problems& problems) const {
  if (!present(scene)) return;
  if (scene.bodies.empty())
    problems.add("fluid.skin_friction", "needs a [[body]]: it acts on hulls", "Add a body or remove the table.");
  const auto* viscosity = scene.effects.find<Viscosity>();
  if (viscosity && viscosity->walls == "no_slip")
    problems.add("fluid.skin_friction",
                 "would count the friction of walls with fluid.viscosity.walls = \"no_slip\" twice",
                 "Use walls = \"slip\", or remove one of the tables.");
}

std::optional<EffectNote> SkinFrictionKind::note(const Scene& scene, const Scales& s) const {
  if (!scene.fluid || scene.bodies.empty()) return {};
  const auto* found = scene.effects.find<SkinFriction>();
  const SkinFriction table = found ? *found : SkinFriction{};
  const double reynolds = s.density * s.speed * s.length / table.dynamic_viscosity;
  if (!(reynolds > 0)) return EffectNote{"skin_friction", found != nullptr, "nothing moves"};
  const double coefficient = fluid::friction_coefficient(line_of(table), reynolds);
  return EffectNote{
      "skin_friction", found != nullptr,
      fmt::format("C_F = {:.3g} at Re = {:.3g}: it counts beside pressures of that share of rho U^2/2, as on "
                  "hulls that plane, slide or are towed; momentum thickness {:.2g} L",
                  coefficient, reynolds, coefficient / 2)};
}

std::optional<Advice> SkinFrictionKind::advise(const Outlook& look) const {
  if (!look.scene.fluid) return {};
  auto advice = advise_skin_friction(look);
  const auto* viscosity = look.scene.effects.find<Viscosity>();
  const bool counted = viscosity && viscosity->walls == "no_slip";
  if (!present(look.scene) && !look.scene.bodies.empty() && !counted)
    advice.set = {"fluid.skin_friction.line=ittc1957"};
  return advice;
}

template <int d>
void SkinFrictionKind::build_in(const Scene& scene, const EffectParts<d>& parts) const {
  const auto* table = scene.effects.find<SkinFriction>();
  parts.fluid.push_back(
      std::make_unique<fluid::SkinFriction<d>>(fluid::SkinFrictionSpec{.line = line_of(*table),
                                                                       .dynamic_viscosity = table->dynamic_viscosity,
                                                                       .hulls = scene.bodies.size(),
                                                                       .mirror = mirror_of(scene)}));
}

template void SkinFrictionKind::build_in<2>(const Scene&, const EffectParts<2>&) const;
template void SkinFrictionKind::build_in<3>(const Scene&, const EffectParts<3>&) const;

}  // namespace splashdown::apps
