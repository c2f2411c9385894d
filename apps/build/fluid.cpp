#include <algorithm>
#include <limits>

#include "apps/build/build.hpp"
#include "apps/effects/elastic/solid.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/kinds/effect_kind.hpp"
#include "core/geometry.hpp"
#include "fluid/pfem/mesh/sizes/size_field.hpp"

namespace splashdown::apps {
namespace {

template <int d>
std::function<fluid::Vec<d>(const fluid::Vec<d>&)> velocity_field(const Region& region) {
  if (region.velocity.isZero(0) && region.velocity_gradient.isZero(0)) return {};
  const fluid::Vec<d> velocity = vec<d>(region.velocity), origin = vec<d>(region.velocity_origin);
  const fluid::Mat<d> gradient = region.velocity_gradient.topLeftCorner<d, d>();
  return [=](const fluid::Vec<d>& x) -> fluid::Vec<d> { return velocity + gradient * (x - origin); };
}

template <int d>
fluid::WallSpec<d> hull(const Body& body) {
  const auto spec = body_spec<d>(body);
  return {.name = spec.name, .surface = spec.surface, .pose = spec.pose, .velocity = spec.velocity, .size = body.size};
}

/// The same of a body that deforms: in the world's frame, about whose origin its twist is told.
template <int d>
fluid::WallSpec<d> skin(const Body& body, const ElasticTable& table) {
  fluid::WallSpec<d> rigid = hull<d>(body);
  rigid.velocity.template head<d>() = rigid_velocity<d>(rigid.velocity, Vec<d>(-rigid.pose.translation()));
  rigid.pose.setIdentity();
  rigid.surface = solid_surface<d>(body, table);
  rigid.deforms = true;
  return rigid;
}

fluid::SizeSpec size_spec(const Sizes& size) {
  return {.surface = size.surface,
          .far = size.far,
          .growth = size.growth,
          .wetted_fraction = size.wetted_fraction,
          .hollow = size.hollow.value_or(std::numeric_limits<double>::infinity()),
          .hollow_min = size.hollow_min,
          .curvature = size.curvature,
          .corner = size.corner};
}

}  // namespace

template <int d>
std::vector<HullBend<d>> hull_bends(const Scene& scene, const Body& body) {
  const fluid::Wall<d> wall(hull<d>(body));
  const auto sizes = size_spec(scene.fluid->size);
  std::vector<HullBend<d>> bends;
  for (const auto& bend : wall.bends())
    bends.push_back({wall.spec().pose * bend.at, bend.radius,
                     std::min(body.size, fluid::size_at_bend(sizes, body.size, bend.radius))});
  return bends;
}

template <int d>
std::vector<fluid::SizeSource<d>> hull_spots(const Scene& scene, const Body& body) {
  const fluid::Wall<d> wall(hull<d>(body));
  auto spots = fluid::spots_of(size_spec(scene.fluid->size), wall, body.size);
  for (auto& spot : spots) spot.at = wall.spec().pose * spot.at;
  return spots;
}

template <int d>
WallSpec<d> wall_of(const Scene& scene, std::size_t body) {
  if (const auto* elastic = scene.effects.find<ElasticTables>())
    for (const auto& table : elastic->of_bodies)
      if (table.body == body) return skin<d>(scene.bodies[body], table);
  return hull<d>(scene.bodies[body]);
}

template <int d>
fluid::FluidSpec<d> fluid_spec(const Scene& scene) {
  const auto& liquid = *scene.fluid;
  fluid::FluidSpec<d> spec;
  spec.density = liquid.density;
  spec.size = size_spec(liquid.size);
  spec.step = {.cfl = scene.time.cfl, .dt_max = scene.time.dt_max};
  for (const auto& region : liquid.regions) spec.liquids.push_back({outline<d>(region), velocity_field<d>(region)});
  for (const auto& body : scene.bodies) spec.walls.push_back(hull<d>(body));
  if (const auto* elastic = scene.effects.find<ElasticTables>())
    for (const auto& table : elastic->of_bodies) spec.walls[table.body] = skin<d>(scene.bodies[table.body], table);
  if (scene.tank) {
    fluid::WallSpec<d> tank;
    tank.name = "tank";
    tank.surface = tank_outline<d>(*scene.tank);
    tank.size = scene.tank->size;
    spec.walls.push_back(std::move(tank));
  }
  for (const auto* kind : effect_kinds())
    if (kind->present(scene)) kind->prepare(scene, spec);
  return spec;
}

template <int d>
Parts<d> parts_of(const Scene& scene) {
  Parts<d> parts;
  for (const auto* kind : effect_kinds())
    if (kind->present(scene)) kind->build(scene, EffectParts<d>{parts.effects, parts.forces});
  return parts;
}

template std::vector<HullBend<2>> hull_bends<2>(const Scene&, const Body&);
template std::vector<HullBend<3>> hull_bends<3>(const Scene&, const Body&);
template std::vector<fluid::SizeSource<2>> hull_spots<2>(const Scene&, const Body&);
template std::vector<fluid::SizeSource<3>> hull_spots<3>(const Scene&, const Body&);
template WallSpec<2> wall_of<2>(const Scene&, std::size_t);
template WallSpec<3> wall_of<3>(const Scene&, std::size_t);
template fluid::FluidSpec<2> fluid_spec<2>(const Scene&);
template fluid::FluidSpec<3> fluid_spec<3>(const Scene&);
template Parts<2> parts_of<2>(const Scene&);
template Parts<3> parts_of<3>(const Scene&);

}  // namespace splashdown::apps
