#include "apps/effects/gravity/gravity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/scene/geometry.hpp"
#include "apps/scene/read/echo.hpp"
#include "apps/scene/read/reader.hpp"
#include "fluid/effects/gravity/gravity.hpp"
#include "rigid/forces/gravity.hpp"

namespace splashdown::apps {

void GravityKind::read(Reader& reader, Scene& scene) const {
  const double standard = -9.81;
  auto& acceleration = scene.gravity.emplace().acceleration;
  acceleration = standard * Point::Unit(scene.dimension - 1);
  reader.point("acceleration", acceleration,
               any("m/s^2", "Use e.g. " + axis_example(scene.dimension, standard) + "; leave the table out for none."));
}

std::optional<EffectNote> GravityKind::note(const Scene& scene, const Scales& s) const {
  const double g = s.gravity > 0 ? s.gravity : 9.81, froude = s.speed / std::sqrt(g * s.length);
  return EffectNote{
      "gravity", present(scene),
      fmt::format("Fr = U/sqrt(g L) = {:.3g}: {}", froude,
                  froude > 3 ? "inertia rules at first; waves and floating need it" : "waves and weight matter")};
}

/// It makes a fall faster, speeds up what enters, and rules what lasts longer than U/g.
std::optional<Advice> GravityKind::advise(const Outlook& look) const {
  const auto& s = look.scales;
  const double g = s.gravity > 0 ? s.gravity : 9.81;
  Advice advice;
  advice.numbers.push_back({"Fr = U/sqrt(g L)", s.speed / std::sqrt(g * s.length)});
  advice.source = "free fall; speed gained until the peak, 2 g t/V of the load, or buoyancy then";
  const bool is_held = look.scene.tank || std::ranges::any_of(look.scene.bodies, [](const Body& body) {
                         return body.motion != Motion::free;
                       });
  if (!present(look.scene) && look.scene.fluid && !is_held) {
    advice.change.motion = 0;
    advice.reason = "nothing holds the liquid: all would fall together";
    return advice;
  }
  if (look.has_load()) {
    const auto& entry = *look.entry;
    const double fall = present(look.scene) ? 1 - std::pow(entry.start_speed / entry.speed, 2)
                                            : 2 * g * entry.height / std::pow(entry.speed, 2);
    const double share = look.dimension() == 2 ? 1. / 2 : 1. / 3;  // that a wedge, a cone displaces of its box
    const double buoyancy = s.density * g * share * entry.wetted * entry.peak_depth / entry.peak_load;
    advice.change.peak = std::isfinite(look.mover->mass) ? fall + 2 * g * entry.peak_time() / entry.speed : buoyancy;
  }
  const double lasts = look.mover && look.entry ? look.mover->time_in_water : look.scene.time.end;
  advice.change.motion = s.speed > 0 && !look.starts_at_rest() ? std::min(1., g * lasts / s.speed) : 1;
  advice.advised = judged(advice.change);
  advice.reason = advice.advised == Advised::off
                      ? "the run is over before weight changes a speed"
                      : "weight drives what comes after the first moments, and floating needs it";
  if (!present(look.scene))
    advice.set = {"gravity.acceleration=" +
                  toml_list(look.dimension() == 2 ? std::vector{0., -9.81} : std::vector{0., 0., -9.81})};
  return advice;
}

std::optional<std::string> GravityKind::asymmetry(const Scene& scene, const Mirror& mirror) const {
  const double across = scene.gravity->acceleration[mirror.axis];
  if (across == 0) return {};
  return fmt::format("has a component of {:g} m/s^2 across the plane", across);
}

template <int d>
void GravityKind::build_in(const Scene& scene, const EffectParts<d>& parts) const {
  const auto acceleration = vec<d>(scene.gravity->acceleration);
  parts.fluid.push_back(std::make_unique<fluid::Gravity<d>>(acceleration));
  parts.forces.push_back(std::make_unique<rigid::Gravity<d>>(acceleration));
}

template void GravityKind::build_in<2>(const Scene&, const EffectParts<2>&) const;
template void GravityKind::build_in<3>(const Scene&, const EffectParts<3>&) const;

}  // namespace splashdown::apps
