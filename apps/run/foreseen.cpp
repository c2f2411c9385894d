#include "apps/run/foreseen.hpp"

#include <exception>

#include "apps/check/statics.hpp"
#include "apps/scene/outlook/impact_theory.hpp"
#include "apps/scene/scales.hpp"

namespace splashdown::apps {

template <int d>
std::map<std::string, Foreseen> foreseen(const Scene& scene) {
  std::map<std::string, Foreseen> all;
  try {
    const auto look = outlook<d>(scene);
    if (const auto theory = impact_theory(look))
      all[scene.bodies[look.entry->body].name].load = LoadBand{theory->time, theory->karman, theory->wagner};
    const auto statics = statics_of<d>(scene);
    for (std::size_t i = 0; i < statics.size(); ++i)
      if (statics[i]) all[scene.bodies[i].name].rest = *statics[i];
  } catch (const std::exception&) {
  }
  return all;
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
template std::map<std::string, Foreseen> foreseen<2>(const Scene&);
template std::map<std::string, Foreseen> foreseen<3>(const Scene&);

}  // namespace splashdown::apps
