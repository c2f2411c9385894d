#include "apps/run/foreseen.hpp"

#include <exception>

#include "apps/check/statics.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/outlook/impact_theory.hpp"
#include "apps/scene/scales.hpp"

namespace splashdown::apps {

template <int d>
Foresight foreseen(const Scene& scene) {
  Foresight known;
  const auto try_to_tell = [&](const char* what, const auto& tell) {
    try {
      tell();
    } catch (const std::exception& error) {
      known.untold.push_back(std::string(what) + ": " + error.what());
    }
  };
  try_to_tell("masses", [&] {
    for (const auto& body : scene.bodies)
      if (body.becomes_free()) known.bodies[body.name].mass = mass_properties<d>(body).mass;
  });
  try_to_tell("the load by theory", [&] {
    const auto look = outlook<d>(scene);
    if (const auto theory = impact_theory(look))
      known.bodies[scene.bodies[look.entry->body].name].load = LoadBand{theory->time, theory->karman, theory->wagner};
  });
  try_to_tell("the position of rest", [&] {
    const auto statics = statics_of<d>(scene);
    for (std::size_t i = 0; i < statics.size(); ++i)
      if (statics[i]) known.bodies[scene.bodies[i].name].rest = *statics[i];
  });
  return known;
}

template <int d>
std::optional<StillWater> still_water(const Scene& scene) {
  const auto level = still_water_level<d>(scene);
  const double gravity = scene.gravity ? -scene.gravity->acceleration[d - 1] : 0;
  if (!scene.fluid || !level || !(gravity > 0)) return {};
  return StillWater{scene.fluid->density, gravity, *level};
}

template std::optional<StillWater> still_water<2>(const Scene&);
template std::optional<StillWater> still_water<3>(const Scene&);
template Foresight foreseen<2>(const Scene&);
template Foresight foreseen<3>(const Scene&);

}  // namespace splashdown::apps
