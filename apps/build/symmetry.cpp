#include "apps/build/symmetry.hpp"

#include <algorithm>
#include <cmath>

#include "apps/scene/kinds/effect_kind.hpp"
#include "apps/scene/mirror.hpp"
#include "apps/scene/solid.hpp"

namespace splashdown::apps {
namespace {

constexpr double facets = 1e-3;  // of a hull: round hulls are as symmetric as their facets

struct Plane : Mirror {
  double length = 0;  ///< of the hull, what distances are compared with [m]

  template <int d>
  bool halves(const Extents<d>& box) const {
    return std::abs(0.5 * (box.min()[axis] + box.max()[axis]) - at) <= written_digits * length;
  }
};

/// Turning about the axis across the mirror is its own image, about others it is not.
template <int d>
bool holds_motion(const Plane& plane, const Body& body) {
  if (body.velocity[plane.axis] != 0) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (body.spin_deg[axis] != 0 && (d == 2 || axis != plane.axis)) return false;
  return std::ranges::all_of(body.path, [&](const Waypoint& point) {
    const auto &a = point.attitude, &b = body.attitude;
    return point.position[plane.axis] == body.position[plane.axis] && a.heading_deg == b.heading_deg &&
           a.pitch_deg == b.pitch_deg && a.roll_deg == b.roll_deg;
  });
}

template <int d>
bool holds_region(const Plane& plane, const Scene& scene, const Region& region) {
  const auto* box = std::get_if<BoxRegion>(&region.shape);
  const bool drawn = std::holds_alternative<PolygonRegion>(region.shape) ||
                     std::holds_alternative<UnionRegion>(region.shape) ||
                     (d == 2 && std::holds_alternative<SplineRegion>(region.shape));
  if (drawn || (box && box->surface_amplitude != 0)) return false;
  if (region.velocity[plane.axis] != 0 || !region.velocity_gradient.isZero()) return false;
  auto extent = extents<d>(outline<d>(region));
  if (scene.tank) extent = extent.intersection(extents<d>(*scene.tank));
  return plane.halves<d>(extent);
}

}  // namespace

template <int d>
std::vector<char> symmetric_axes(const Scene& scene, const Body& body) {
  std::vector<char> axes(d - 1, 0);
  if (scene.bodies.size() != 1 || !scene.fluid) return axes;
  const auto hull = outline<d>(body);
  const auto box = extents<d>(hull);
  const rigid::Vec<d> centre = shape_pose<d>(body) * mass_properties<d>(body).centre;
  for (int k = 0; k < d - 1; ++k) {
    const Plane plane{{k, box.center()[k]}, box.sizes().maxCoeff()};
    axes[static_cast<std::size_t>(k)] =
        (!body.becomes_free() || std::abs(centre[k] - plane.at) <= facets * plane.length) &&
        (!scene.gravity || scene.gravity->acceleration[k] == 0) &&
        (!scene.tank || plane.halves<d>(extents<d>(*scene.tank))) && holds_motion<d>(plane, body) &&
        std::ranges::all_of(scene.fluid->regions,
                            [&](const Region& region) { return holds_region<d>(plane, scene, region); }) &&
        std::ranges::all_of(
            effect_kinds(),
            [&](const EffectKind* kind) { return !kind->present(scene) || !kind->asymmetry(scene, plane); }) &&
        asymmetry_of<d>(plane, hull).distance <= facets * plane.length;
  }
  return axes;
}

template std::vector<char> symmetric_axes<2>(const Scene&, const Body&);
template std::vector<char> symmetric_axes<3>(const Scene&, const Body&);

}  // namespace splashdown::apps
