#include "apps/scene/terrain.hpp"

#include <cmath>
#include <vector>

#include "apps/scene/geometry.hpp"
#include "apps/scene/rules/check.hpp"
#include "apps/scene/rules/problems.hpp"

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

void cut(const Tank& tank, Body& body) {
  const auto inside = extents<2>(tank);
  const auto hull = outline<2>(body);
  const double roundoff = 1e-9 * inside.diagonal().norm();
  const Extents<2> wide(inside.min().array() - roundoff, inside.max().array() + roundoff);
  if (wide.contains(extents<2>(hull)) || !inside.intersects(extents<2>(hull))) return;
  const auto part = clipped(hull, inside);
  if (part.size() < 3) return;
  PolygonShape shape;
  for (const auto& x : part) {
    shape.points.emplace_back(Point::Zero());
    shape.points.back().head<2>() = shape_pose<2>(body).inverse() * x;
  }
  shape_of<2>(shape);  // throws for what is no outline
  body.shape = std::move(shape);
}

bool is_good(const Shape& shape) {
  try {
    shape_of<2>(shape);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

}  // namespace

void cut_terrain(Scene& scene, const SceneLabels& labels, Problems& problems) {
  if (!scene.tank || scene.dimension != 2 || problems.found_in("tank")) return;
  if (!((scene.tank->max - scene.tank->min).head<2>().minCoeff() > 0)) return;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    auto& body = scene.bodies[i];
    if (body.motion != Motion::fixed || problems.found_in(labels.bodies[i]) || !is_good(body.shape)) continue;
    try {
      cut(*scene.tank, body);
    } catch (const std::invalid_argument& error) {
      problems.add(labels.bodies[i] + ".shape",
                   std::string("what of it lies in the tank is no single body: ") + error.what(),
                   "Give each part a body of its own, or enlarge the tank.");
    }
  }
}

}  // namespace splashdown::apps
