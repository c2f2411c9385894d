#include "apps/scene/scales.hpp"

#include <algorithm>
#include <cmath>

#include "apps/scene/geometry.hpp"
#include "apps/scene/kinds/effect_kind.hpp"

namespace splashdown::apps {
namespace {

/// A linear field is fastest on the region's outline.
template <int d>
double fastest(const Region& region) {
  const auto surface = outline<d>(region);
  double speed = 0;
  for (Eigen::Index i = 0; i < surface.vertices.cols(); ++i) {
    const rigid::Vec<d> x = surface.vertices.col(i) - vec<d>(region.velocity_origin);
    speed = std::max(speed, (vec<d>(region.velocity) + region.velocity_gradient.topLeftCorner<d, d>() * x).norm());
  }
  return speed;
}

double fastest(const Body& body) {
  double speed = body.velocity.norm();
  for (std::size_t i = 1; i < body.path.size(); ++i)
    speed = std::max(speed, (body.path[i].position - body.path[i - 1].position).norm() /
                                (body.path[i].time - body.path[i - 1].time));
  return speed;
}

/// Speed at the water after a free fall from where the body is.
template <int d>
double at_the_water(const Scene& scene, const Body& body) {
  const double speed = fastest(body);
  const auto level = still_water_level<d>(scene);
  if (body.motion != Motion::free || !scene.gravity || !level) return speed;
  const double drop = std::max(0., extents<d>(outline<d>(body)).min()[d - 1] - *level);
  return std::sqrt(speed * speed + 2 * scene.gravity->acceleration.norm() * drop);
}

}  // namespace

std::optional<double> straight_pull(const Scene& scene) {
  constexpr double roundoff = 1e-9;
  if (!scene.gravity) return {};
  const int up = scene.dimension - 1;
  const Point& g = scene.gravity->acceleration;
  if (!(g[up] < 0) || g.head(up).norm() > roundoff * g.norm()) return {};
  return -g[up];
}

template <int d>
std::optional<double> still_water_level(const Scene& scene) {
  if (!scene.fluid) return {};
  double level = 0, widest = 0;
  for (const auto& region : scene.fluid->regions) {
    const auto box = extents<d>(outline<d>(region));
    const double wide = box.sizes().template head<d - 1>().prod();
    if (wide <= widest) continue;
    widest = wide;
    const auto* flat = std::get_if<BoxRegion>(&region.shape);
    level = flat ? flat->max[d - 1] : box.max()[d - 1];
  }
  return level;
}

template <int d>
Scales scales(const Scene& scene) {
  Scales s;
  if (!scene.bodies.empty())
    s.length = extents<d>(outline<d>(scene.bodies.front())).sizes().maxCoeff();
  else if (scene.fluid)
    s.length = extents<d>(outline<d>(scene.fluid->regions.front())).sizes().maxCoeff();
  else if (scene.vortex)
    s.length = (scene.vortex->max - scene.vortex->min).maxCoeff();
  else if (scene.ale)
    s.length = (scene.ale->max - scene.ale->min).maxCoeff();
  s.gravity = scene.gravity ? scene.gravity->acceleration.norm() : 0;
  s.density = scene.fluid_density();
  for (const auto& body : scene.bodies) s.speed = std::max(s.speed, at_the_water<d>(scene, body));
  if (scene.fluid)
    for (const auto& region : scene.fluid->regions) s.speed = std::max(s.speed, fastest<d>(region));
  if (scene.vortex)
    for (const auto& row : scene.vortex->stream) s.speed = std::max(s.speed, std::hypot(row[1], row[2]));
  if (scene.ale) s.speed = std::max(s.speed, scene.ale->velocity.norm());
  s.level = still_water_level<d>(scene).value_or(0);
  if (s.speed == 0) s.speed = std::sqrt(s.gravity * s.length);  // what gravity will make of rest
  return s;
}

template <int d>
std::vector<EffectNote> effect_notes(const Scene& scene) {
  const auto s = scales<d>(scene);
  std::vector<EffectNote> notes;
  for (const auto* kind : effect_kinds())
    if (auto note = kind->note(scene, s)) notes.push_back(std::move(*note));
  return notes;
}

template std::optional<double> still_water_level<2>(const Scene&);
template Scales scales<2>(const Scene&);
template std::vector<EffectNote> effect_notes<2>(const Scene&);
template std::optional<double> still_water_level<3>(const Scene&);
template Scales scales<3>(const Scene&);
template std::vector<EffectNote> effect_notes<3>(const Scene&);

}  // namespace splashdown::apps
