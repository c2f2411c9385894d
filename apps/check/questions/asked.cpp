#include "apps/check/questions/asked.hpp"

#include "apps/scene/scales.hpp"
#include "rigid/shapes/hydrostatics.hpp"

namespace splashdown::apps {

template <int d>
Asked<d> asked_of(const Scene& scene, const Cost& cost) {
  Asked<d> asked{scene, cost, still_water_level<d>(scene), 0, {}};
  if (scene.gravity) asked.pull = -scene.gravity->acceleration[d - 1];
  for (const auto& body : scene.bodies) {
    AskedBody<d> of{&body, outline<d>(body), {}, shape_of<d>(body.shape).at_unit_density, 0};
    of.box = extents<d>(of.hull);
    if (asked.level)
      of.wet = rigid::submerged<d>(of.hull, rigid::Isometry<d>::Identity(), *asked.level).volume / of.uniform.mass;
    asked.bodies.push_back(std::move(of));
  }
  return asked;
}

template Asked<2> asked_of<2>(const Scene&, const Cost&);
template Asked<3> asked_of<3>(const Scene&, const Cost&);

}  // namespace splashdown::apps
