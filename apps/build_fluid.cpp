#include <algorithm>
#include <limits>

#include "apps/build.hpp"
#include "apps/scene_geometry.hpp"
#include "fluid/absorber.hpp"
#include "fluid/size_field.hpp"
#include "fluid/viscosity.hpp"

namespace splashdown::apps {
namespace {

fluid::Surface<2> fluid_surface(const rigid::Surface<2>& surface) {
  return {surface.vertices, surface.facets};
}

std::function<fluid::Vec<2>(const fluid::Vec<2>&)> velocity_field(const Region& region) {
  if (region.velocity.isZero(0) && region.velocity_gradient.isZero(0)) return {};
  const fluid::Vec<2> velocity = planar(region.velocity), origin = planar(region.velocity_origin);
  const fluid::Mat<2> gradient = region.velocity_gradient.topLeftCorner<2, 2>();
  return [=](const fluid::Vec<2>& x) -> fluid::Vec<2> { return velocity + gradient * (x - origin); };
}

fluid::WallSpec<2> hull(const Body& body) {
  const auto spec = body_spec(body);
  return {.name = spec.name,
          .surface = fluid_surface(spec.surface),
          .pose = spec.pose,
          .velocity = spec.velocity,
          .size = body.size};
}

fluid::SizeSpec size_spec(const Sizes& size) {
  return {.surface = size.surface,
          .far = size.far,
          .growth = size.growth,
          .wetted_fraction = size.wetted_fraction,
          .hollow = size.hollow.value_or(std::numeric_limits<double>::infinity()),
          .hollow_min = size.hollow_min,
          .curvature = size.curvature};
}

}  // namespace

std::vector<HullBend> hull_bends(const Scene& scene, const Body& body) {
  const fluid::Wall<2> wall(hull(body));
  const auto sizes = size_spec(scene.fluid->size);
  std::vector<HullBend> bends;
  for (const auto& bend : wall.bends())
    bends.push_back({wall.spec().pose * bend.at, bend.radius,
                     std::min(body.size, fluid::size_at_bend(sizes, body.size, bend.radius))});
  return bends;
}

fluid::FluidSpec<2> fluid_spec(const Scene& scene) {
  const auto& liquid = *scene.fluid;
  fluid::FluidSpec<2> spec;
  spec.density = liquid.density;
  spec.size = size_spec(liquid.size);
  spec.step = {.cfl = scene.time.cfl, .dt_max = scene.time.dt_max};
  for (const auto& region : liquid.regions)
    spec.liquids.push_back({fluid_surface(outline(region)), velocity_field(region)});
  for (const auto& body : scene.bodies) spec.walls.push_back(hull(body));
  if (scene.tank) {
    fluid::WallSpec<2> tank;
    tank.name = "tank";
    tank.surface = fluid_surface(tank_outline(*scene.tank));
    tank.size = scene.tank->size;
    spec.walls.push_back(std::move(tank));
  }
  const bool no_slip = liquid.viscosity && liquid.viscosity->walls == "no_slip";
  for (auto& wall : spec.walls) wall.sticks = no_slip;
  return spec;
}

std::vector<std::unique_ptr<fluid::Term<2>>> fluid_terms(const Scene& scene) {
  std::vector<std::unique_ptr<fluid::Term<2>>> terms;
  if (scene.gravity)
    terms.push_back(std::make_unique<fluid::Gravity<2>>(planar(scene.gravity->acceleration)));
  if (scene.fluid->viscosity)
    terms.push_back(std::make_unique<fluid::Viscosity<2>>(scene.fluid->viscosity->dynamic));
  if (scene.fluid->absorber)
    terms.push_back(std::make_unique<fluid::Absorber<2>>(
        fluid::AbsorberSpec{.from = scene.tank->min.x(), .to = scene.tank->max.x(),
                            .width = scene.fluid->absorber->width, .rate = scene.fluid->absorber->rate}));
  return terms;
}

}  // namespace splashdown::apps
