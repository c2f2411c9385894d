#include "apps/scene/terrain.hpp"

#include "apps/scene/geometry.hpp"
#include "apps/scene/rules/check.hpp"
#include "apps/scene/rules/problems.hpp"
#include "core/surface/clip.hpp"

namespace splashdown::apps {
namespace {

const char* const in_one_piece = "Give each part a body of its own, or a tank that holds it.";

void take(Body& body, const rigid::Surface<2>& part) {
  PolygonShape polygon;
  for (Eigen::Index v = 0; v < part.vertices.cols(); ++v) {
    polygon.points.emplace_back(Point::Zero());
    polygon.points.back().head<2>() = part.vertices.col(v);
  }
  body.shape = polygon;
}

void take(Body& body, const rigid::Surface<3>& part) {
  SurfaceShape surface;
  if (const auto* file = std::get_if<SurfaceShape>(&body.shape)) surface = *file;
  surface.read = std::make_shared<rigid::Shape<3>>(rigid::Shape<3>{part, rigid::mass_properties<3>(part)});
  body.shape = surface;
}

template <int d>
void cut(const Tank& tank, Body& body) {
  const auto inside = extents<d>(tank);
  auto hull = outline<d>(body);
  const double roundoff = 1e-9 * inside.diagonal().norm();
  const Extents<d> wide(inside.min().array() - roundoff, inside.max().array() + roundoff);
  if (wide.contains(extents<d>(hull)) || !inside.intersects(extents<d>(hull))) return;
  auto part = clipped_to_box<d>(hull, inside);
  if (part.facets.cols() == 0) return;
  part.vertices = shape_pose<d>(body).inverse() * part.vertices;
  Body taken = body;
  take(taken, part);
  shape_of<d>(taken.shape);  // throws for what is no outline
  body.shape = std::move(taken.shape);
}

}  // namespace

void cut_terrain(Scene& scene, const SceneLabels& labels, Problems& problems) {
  if (!scene.tank || problems.found_in("tank")) return;
  if (!((scene.tank->max - scene.tank->min).head(scene.dimension).minCoeff() > 0)) return;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    auto& body = scene.bodies[i];
    if (body.motion != Motion::fixed || problems.found_in(labels.bodies[i])) continue;
    try {
      scene.dimension == 2 ? void(shape_of<2>(body.shape)) : void(shape_of<3>(body.shape));
    } catch (const std::invalid_argument&) {
      continue;  // the rules of shapes say so
    }
    try {
      scene.dimension == 2 ? cut<2>(*scene.tank, body) : cut<3>(*scene.tank, body);
    } catch (const std::invalid_argument& error) {
      problems.add(labels.bodies[i] + ".shape", std::string("what lies in the tank is no single body: ") + error.what(),
                   in_one_piece);
    }
  }
}

}  // namespace splashdown::apps
