#include "apps/effects/viscosity/viscosity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/effects/theory/theory.hpp"
#include "apps/scene/read/reader.hpp"
#include "fluid/effects/viscosity/viscosity.hpp"

namespace splashdown::apps {

void ViscosityKind::read(Reader& reader, Scene& scene) const {
  auto& table = scene.effects.table<Viscosity>();
  reader.number("dynamic", table.dynamic, positive("Pa s", "Use e.g. 1e-3 for water; leave the table out for none."));
  reader.choice("walls", table.walls, {"slip", "no_slip"});
  if (reader.context().sketch) reader.skip("stencil");  // of a fluid on a grid: no rule of these walls
}

// Water has 1.8e-3 Pa s at 0 C and 2.8e-4 at 100 C; liquid hydrogen 1.3e-5, pitch more than anything that splashes.
void ViscosityKind::ask(const AskedScene& asked, std::vector<std::string>& questions) const {
  const double coldest = 2.2e-3, hottest = 2.5e-4, thinnest = 1e-5, thickest = 1e3, as_water = 0.05;
  const auto* table = asked.scene.effects.find<Viscosity>();
  if (!table) return;
  const double mu = table->dynamic, density = asked.scene.fluid->density;
  const bool water = std::abs(density / 1000 - 1) <= as_water;
  if (mu >= (water ? hottest : thinnest) && mu <= (water ? coldest : thickest)) return;
  questions.push_back(fmt::format("fluid.viscosity.dynamic = {:g} Pa s: {}: did you mean {}?", mu,
                                  water ? "water of this density has 0.0003 to 0.002" : "no liquid has that",
                                  mu * density >= hottest && mu * density <= coldest
                                      ? fmt::format("{:g}? That is {:g} m^2/s times the density", mu * density, mu)
                                      : "0.001"));
}

std::optional<EffectNote> ViscosityKind::note(const Scene& scene, const Scales& s) const {
  if (!scene.fluid) return {};
  constexpr double of_water = 1e-3;  // at 20 C [Pa s]
  const auto* table = scene.effects.find<Viscosity>();
  const double mu = table ? table->dynamic : of_water, reynolds = s.density * s.speed * s.length / mu;
  return EffectNote{
      "viscosity", table != nullptr,
      fmt::format(
          "Re = rho U L/mu = {:.3g}{}: laminar boundary layer of {:.3g} L, friction of {:.3g} of the dynamic pressure",
          reynolds, table ? "" : " (water)", 5 / std::sqrt(reynolds),
          1.33 / std::sqrt(reynolds))};  // Blasius, flat plate
}

/// Friction of a laminar layer beside the load, and what waves lose: 2 nu k^2 t in the bulk, and at walls that hold the water
/// sqrt(nu omega/2)/b more.
std::optional<Advice> ViscosityKind::advise(const Outlook& look) const {
  using std::numbers::pi;
  if (!look.scene.fluid) return {};
  const auto* table = look.scene.effects.find<Viscosity>();
  const auto& s = look.scales;
  const double mu = table ? table->dynamic : water_viscosity, nu = mu / s.density;
  const double reynolds = reynolds_number(look, mu), time = look.scene.time.end;
  Advice advice;
  advice.numbers.push_back({"Re = rho U L/mu", reynolds});
  advice.numbers.push_back({"boundary layer over L", reynolds > 0 ? 5 / std::sqrt(reynolds) : 0});
  if (look.has_load()) {
    const auto& entry = *look.entry;
    advice.change.peak = laminar_friction(reynolds) *
                         dynamic_pressure(s.density, std::max(s.speed, look.mover->forward)) * entry.wetted /
                         entry.peak_load;
  }
  const double wave = 2 * pi / look.wave_length, bulk = 2 * nu * wave * wave;
  const double swing = look.pull > 0 ? std::sqrt(look.pull * wave) : 0;
  const bool sticks = table && table->walls == "no_slip";
  const double walls = sticks ? std::sqrt(nu * swing / 2) / s.length : 0;
  advice.change.motion = 1 - std::exp(-(bulk + walls) * time);
  advice.advised = judged(advice.change);
  advice.reason = advice.advised == Advised::off
                      ? "layers are thin and waves keep their height: an inviscid fluid does the same"
                      : "friction is a part of the load, or waves lose height within the run";
  advice.source = "Blasius 1908; decay of waves, Lamb 1932, articles 348 and 349";
  if (!table) advice.set = {"fluid.viscosity.dynamic=0.001"};
  return advice;
}

template <int d>
void ViscosityKind::prepare_in(const Scene& scene, fluid::FluidSpec<d>& spec) const {
  const bool no_slip = scene.effects.find<Viscosity>()->walls == "no_slip";
  for (auto& wall : spec.walls) wall.sticks = no_slip;
}

template <int d>
void ViscosityKind::build_in(const Scene& scene, const EffectParts<d>& parts) const {
  parts.fluid.push_back(std::make_unique<fluid::Viscosity<d>>(scene.effects.find<Viscosity>()->dynamic));
}

template void ViscosityKind::prepare_in<2>(const Scene&, fluid::FluidSpec<2>&) const;
template void ViscosityKind::prepare_in<3>(const Scene&, fluid::FluidSpec<3>&) const;
template void ViscosityKind::build_in<2>(const Scene&, const EffectParts<2>&) const;
template void ViscosityKind::build_in<3>(const Scene&, const EffectParts<3>&) const;

}  // namespace splashdown::apps
