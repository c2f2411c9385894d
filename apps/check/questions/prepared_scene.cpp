#include "apps/check/questions/prepared_scene.hpp"

#include "apps/scene/scales.hpp"
#include "rigid/shapes/hydrostatics.hpp"

namespace splashdown::apps {

template <int d>
PreparedScene<d> prepared_scene(const Scene& scene, const Cost& cost) {
  PreparedScene<d> prepared{scene, cost, still_water_level<d>(scene), 0, {}};
  if (scene.gravity) prepared.pull = -scene.gravity->acceleration[d - 1];
  for (const auto& body : scene.bodies) {
    PreparedBody<d> of{&body, outline<d>(body), {}, shape_of<d>(body.shape).at_unit_density, 0};
    of.box = extents<d>(of.hull);
    if (prepared.level)
      of.wet = rigid::submerged<d>(of.hull, rigid::Isometry<d>::Identity(), *prepared.level).volume / of.uniform.mass;
    prepared.bodies.push_back(std::move(of));
  }
  return prepared;
}

template PreparedScene<2> prepared_scene<2>(const Scene&, const Cost&);
template PreparedScene<3> prepared_scene<3>(const Scene&, const Cost&);

}  // namespace splashdown::apps
