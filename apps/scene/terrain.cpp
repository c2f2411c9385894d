#include "apps/scene/terrain.hpp"

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "apps/scene/geometry.hpp"
#include "apps/scene/rules/check.hpp"
#include "apps/scene/rules/problems.hpp"
#include "core/surface/cut.hpp"
#include "rigid/shapes/mass_properties.hpp"

namespace splashdown::apps {
namespace {

using Outline = std::vector<rigid::Vec<2>>;

/// What of a polygon lies where sign x_k <= sign side (Sutherland and Hodgman 1974).
Outline below(const Outline& polygon, int k, double sign, double side) {
  Outline kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double over_a = sign * (a[k] - side), over_b = sign * (b[k] - side);
    if (over_a <= 0) kept.push_back(a);
    if ((over_a < 0 && over_b > 0) || (over_a > 0 && over_b < 0)) {
      rigid::Vec<2> cut = a + over_a / (over_a - over_b) * (b - a);
      cut[k] = side;
      kept.push_back(cut);
    }
  }
  return kept;
}

/// The part in the box; corners that coincide once.
Outline clipped(const rigid::Surface<2>& hull, const Extents<2>& box) {
  Outline polygon, distinct;
  for (Eigen::Index f = 0; f < hull.facets.cols(); ++f) polygon.emplace_back(hull.vertices.col(hull.facets(0, f)));
  for (int k = 0; k < 2; ++k) {
    polygon = below(polygon, k, -1, box.min()[k]);
    polygon = below(polygon, k, 1, box.max()[k]);
  }
  const double near = 1e-9 * box.diagonal().norm();
  for (const auto& x : polygon)
    if (distinct.empty() || (x - distinct.back()).norm() > near) distinct.push_back(x);
  while (distinct.size() > 1 && (distinct.back() - distinct.front()).norm() <= near) distinct.pop_back();
  return distinct;
}

/// Of a hull in the world, in the frame of the body's shape; nothing where none of it lies in the box.
std::optional<Shape> part_in(const Body& body, const rigid::Surface<2>& hull, const Extents<2>& box) {
  const auto part = clipped(hull, box);
  if (part.size() < 3) return {};
  PolygonShape shape;
  for (const auto& x : part) {
    shape.points.emplace_back(Point::Zero());
    shape.points.back().head<2>() = shape_pose<2>(body).inverse() * x;
  }
  shape_of<2>(shape);  // throws for what is no outline
  return shape;
}

std::optional<Shape> part_in(const Body& body, const rigid::Surface<3>& hull, const Extents<3>& box) {
  rigid::Surface<3> part = cut_at_box(hull, box);
  if (part.facets.cols() == 0) return {};
  part.vertices = shape_pose<3>(body).inverse() * part.vertices;
  SurfaceShape shape;
  if (const auto* file = std::get_if<SurfaceShape>(&body.shape)) shape = *file;
  shape.read = std::make_shared<rigid::Shape<3>>(rigid::Shape<3>{part, rigid::mass_properties<3>(part)});
  return shape;
}

template <int d>
void cut(const Tank& tank, Body& body) {
  const auto inside = extents<d>(tank);
  const auto hull = outline<d>(body);
  const double roundoff = 1e-9 * inside.diagonal().norm();
  const Extents<d> wide(inside.min().array() - roundoff, inside.max().array() + roundoff);
  if (wide.contains(extents<d>(hull)) || !inside.intersects(extents<d>(hull))) return;
  if (auto part = part_in(body, hull, inside)) body.shape = std::move(*part);
}

/// A file in another unit, most of the time: not cut, so that its place is asked about.
template <int d>
bool is_out_of_scale(const Tank& tank, const Body& body) {
  constexpr double most = 100;  // times the tank
  return extents<d>(outline<d>(body)).sizes().maxCoeff() > most * extents<d>(tank).sizes().maxCoeff();
}

template <int d>
bool is_good(const Shape& shape) {
  try {
    shape_of<d>(shape);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

template <int d>
void cut_bodies(Scene& scene, const SceneLabels& labels, Problems& problems) {
  if (!(extents<d>(*scene.tank).sizes().minCoeff() > 0)) return;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    auto& body = scene.bodies[i];
    if (body.motion != Motion::fixed || problems.found_in(labels.bodies[i]) || !is_good<d>(body.shape)) continue;
    if (is_out_of_scale<d>(*scene.tank, body)) continue;
    try {
      cut<d>(*scene.tank, body);
    } catch (const std::exception& error) {
      problems.add(labels.bodies[i] + ".shape",
                   std::string("what of it lies in the tank is no single body: ") + error.what(),
                   "Give each part a body of its own, or enlarge the tank.");
    }
  }
}

}  // namespace

void cut_terrain(Scene& scene, const SceneLabels& labels, Problems& problems) {
  if (!scene.tank || problems.found_in("tank")) return;
  scene.dimension == 2 ? cut_bodies<2>(scene, labels, problems) : cut_bodies<3>(scene, labels, problems);
}

}  // namespace splashdown::apps
