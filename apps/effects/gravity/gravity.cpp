#include "apps/effects/gravity/gravity.hpp"

#include <fmt/format.h>

#include <cmath>

#include "apps/scene/geometry.hpp"
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

template <int d>
void GravityKind::build_in(const Scene& scene, const EffectParts<d>& parts) const {
  const auto acceleration = vec<d>(scene.gravity->acceleration);
  parts.fluid.push_back(std::make_unique<fluid::Gravity<d>>(acceleration));
  parts.forces.push_back(std::make_unique<rigid::Gravity<d>>(acceleration));
}

template void GravityKind::build_in<2>(const Scene&, const EffectParts<2>&) const;
template void GravityKind::build_in<3>(const Scene&, const EffectParts<3>&) const;

}  // namespace splashdown::apps
