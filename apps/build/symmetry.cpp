#include "apps/build/symmetry.hpp"

#include <algorithm>
#include <cmath>

#include "apps/scene/solid.hpp"

namespace splashdown::apps {
namespace {

constexpr double written_digits = 1e-6;  // of lengths, that people write

/// The plane across axis `k` at `place`.
struct Mirror {
  int k = 0;
  double place = 0, length = 0;  ///< [m]; of the hull, what distances are compared with

  bool holds(double at) const { return std::abs(at - place) <= written_digits * length; }
  template <int d>
  bool holds(const Extents<d>& box) const {
    return holds(0.5 * (box.min()[k] + box.max()[k]));
  }
};

template <int d>
bool holds_hull(const Mirror& mirror, const rigid::Surface<d>& hull) {
  const Solid<d> solid(hull);
  const double facets = 1e-3;  // round hulls are as symmetric as their facets
  for (Eigen::Index v = 0; v < hull.vertices.cols(); ++v) {
    rigid::Vec<d> x = hull.vertices.col(v);
    x[mirror.k] = 2 * mirror.place - x[mirror.k];
    if (solid.distance(x) > facets * mirror.length) return false;
  }
  return true;
}

/// Turning about the axis across the mirror is its own image, about others it is not.
template <int d>
bool holds_motion(const Mirror& mirror, const Body& body) {
  if (body.velocity[mirror.k] != 0) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (body.spin_deg[axis] != 0 && (d == 2 || axis != mirror.k)) return false;
  return std::ranges::all_of(body.path, [&](const Waypoint& point) {
    const auto &a = point.attitude, &b = body.attitude;
    return point.position[mirror.k] == body.position[mirror.k] && a.heading_deg == b.heading_deg &&
           a.pitch_deg == b.pitch_deg && a.roll_deg == b.roll_deg;
  });
}

template <int d>
bool holds_region(const Mirror& mirror, const Scene& scene, const Region& region) {
  const auto* box = std::get_if<BoxRegion>(&region.shape);
  if (std::holds_alternative<PolygonRegion>(region.shape) || (box && box->surface_amplitude != 0)) return false;
  if (region.velocity[mirror.k] != 0 || !region.velocity_gradient.isZero()) return false;
  auto extent = extents<d>(outline<d>(region));
  if (scene.tank) extent = extent.intersection(extents<d>(*scene.tank));
  return mirror.holds<d>(extent);
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
    const Mirror mirror{k, box.center()[k], box.sizes().maxCoeff()};
    axes[static_cast<std::size_t>(k)] =
        (!body.becomes_free() || std::abs(centre[k] - mirror.place) <= 1e-3 * mirror.length) &&
        (!scene.gravity || scene.gravity->acceleration[k] == 0) &&
        (!scene.tank || mirror.holds<d>(extents<d>(*scene.tank))) && holds_motion<d>(mirror, body) &&
        std::ranges::all_of(scene.fluid->regions,
                            [&](const Region& region) { return holds_region<d>(mirror, scene, region); }) &&
        holds_hull<d>(mirror, hull);
  }
  return axes;
}

template std::vector<char> symmetric_axes<2>(const Scene&, const Body&);
template std::vector<char> symmetric_axes<3>(const Scene&, const Body&);

}  // namespace splashdown::apps
