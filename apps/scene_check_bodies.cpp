#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/scene_check.hpp"
#include "apps/scene_geometry.hpp"

namespace splashdown::apps {
namespace {

struct Place2 {
  Point position;
  double pitch_deg;
};

void check_name(const Scene& scene, std::size_t i, const std::string& label, Problems& problems) {
  const auto& name = scene.bodies[i].name;
  for (std::size_t j = 0; j < i; ++j)
    if (!name.empty() && scene.bodies[j].name == name)
      problems.add(label + ".name", "is taken by another body", "Give every body its own name.");
}

void check_mass(const Body& body, const std::string& label, Problems& problems) {
  if (problems.found_in(label + ".mass") || problems.found_in(label + ".density")) return;
  const bool mass = problems.noted(label + ".mass"), density = problems.noted(label + ".density");
  if (mass && density)
    problems.add(label + ".density", "mass and density exclude each other", "Remove one of them.");
  if (body.motion == Motion::free && !mass && !density)
    problems.add_missing(label + ".mass", "a free body needs its mass (kg/m) or mean density (kg/m^3)",
                         "Add mass or density, or motion = \"fixed\".");
  if (body.motion == Motion::free && body.free.empty() && problems.noted(label + ".free"))
    problems.add(label + ".free", "must name at least one of 'x', 'y' or 'rotation'",
                 "For none of them use motion = \"fixed\".");
}

bool starts_wet(const Scene& scene, const Body& body) {
  const auto hull = outline(body);
  return std::any_of(scene.fluid->regions.begin(), scene.fluid->regions.end(),
                     [&](const Region& region) { return overlap(hull, outline(region)); });
}

/// A body without mass moves as the water lets it.
void check_massless(const Scene& scene, const Body& body, const std::string& label, Problems& problems) {
  const bool massless = body.mass == 0. || body.density == 0.;
  if (body.motion != Motion::free || !massless) return;
  const std::string key = label + (body.mass ? ".mass" : ".density"), cure = "Give it a mass, or let it start in the water.";
  if (!scene.fluid) return problems.add(key, "a free body without mass needs a fluid that has inertia for it", "Give it a mass.");
  if (scene.coupling && scene.coupling->interface_term != "rigid")
    problems.add(key, "a free body without mass needs coupling.interface_term = \"rigid\"", "Change the term, or give it a mass.");
  if (!starts_wet(scene, body))
    problems.add(key, "a free body without mass must start in the fluid, which has inertia for it", cure);
  if (body.inertia) problems.add(label + ".inertia", "a body without mass has no inertia", "Remove it.");
}

void check_path(const Body& body, const std::string& label, Problems& problems) {
  const auto& path = body.path;
  if (path.empty()) return;
  const std::string key = label + ".path";
  if (path.size() < 2)
    problems.add(key, "must have at least two rows", "For constant velocity use velocity and spin_deg.");
  if (path.front().time != 0) problems.add(key, "must begin at time 0", "Put the initial pose first.");
  for (std::size_t i = 1; i < path.size(); ++i)
    if (path[i].time <= path[i - 1].time)
      return problems.add(key,
                          fmt::format("times must increase: row {} has {:g} s after {:g} s", i + 1,
                                      path[i].time, path[i - 1].time),
                          "Sort the rows.");
}

/// The shape's outline in its own frame; nothing, and a problem, if there is none.
std::optional<rigid::Surface<2>> checked_shape(const Body& body, const std::string& label,
                                               Problems& problems) {
  if (const auto* wedge = std::get_if<WedgeShape>(&body.shape); wedge && wedge->height) {
    const double chine = wedge->breadth / 2 * std::tan(wedge->deadrise_deg * std::numbers::pi / 180);
    if (*wedge->height < (1 - 1e-6) * chine) {
      problems.add(label + ".shape.height", fmt::format("must not be below that of the faces, {:g} m", chine),
                   "Leave it out for a triangle.");
      return {};
    }
  }
  try {
    return shape_of(body.shape).surface;
  } catch (const std::invalid_argument& error) {
    if (std::holds_alternative<PolygonShape>(body.shape))
      problems.add(label + ".shape.points", error.what(), "List the corners in order, each once.");
    return {};
  }
}

void check_inside_tank(const Scene& scene, const Body& body, const rigid::Surface<2>& shape,
                       const std::string& label, Problems& problems) {
  if (!scene.tank) return;
  const Extents tank(planar(scene.tank->min), planar(scene.tank->max));
  if (tank.isEmpty()) return;
  const double tolerance = 1e-9 * tank.diagonal().norm();
  const Extents wide(tank.min().array() - tolerance, tank.max().array() + tolerance);
  std::vector<Place2> places{{body.position, body.pitch_deg}};
  for (const auto& point : body.path) places.push_back({point.position, point.pitch_deg});
  for (const auto& place : places) {
    auto moved = shape;
    moved.vertices = shape_pose(place.position, place.pitch_deg) * shape.vertices;
    const auto box = extents(moved);
    if (wide.contains(box)) continue;
    return problems.add(
        label + (body.path.empty() ? ".position" : ".path"),
        fmt::format(
            "the body spans [{:g}, {:g}] x [{:g}, {:g}] m and leaves the tank [{:g}, {:g}] x [{:g}, {:g}] m",
            box.min().x(), box.max().x(), box.min().y(), box.max().y(), tank.min().x(), tank.max().x(),
            tank.min().y(), tank.max().y()),
        "Move the body or enlarge the tank.");
  }
}

void check_size(const Scene& scene, const Body& body, const rigid::Surface<2>& shape,
                const std::string& label, Problems& problems) {
  const double extent = extents(shape).sizes().maxCoeff();
  if (scene.fluid && body.size > extent)
    problems.add(label + ".size", fmt::format("must not exceed the body's extent of {:g} m", extent),
                 "Use e.g. a fiftieth of it.");
}

}  // namespace

void check_bodies(const Scene& scene, const SceneLabels& labels, Problems& problems) {
  std::vector<std::optional<rigid::Surface<2>>> outlines(scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const auto& body = scene.bodies[i];
    const auto& label = labels.bodies[i];
    check_name(scene, i, label, problems);
    check_mass(body, label, problems);
    check_path(body, label, problems);
    if (problems.found_in(label + ".shape")) continue;
    auto shape = checked_shape(body, label, problems);
    if (!shape) continue;
    if (problems.found_in(label + ".position") || problems.found_in(label + ".pitch_deg") ||
        problems.found_in(label + ".path"))
      continue;
    check_inside_tank(scene, body, *shape, label, problems);
    check_size(scene, body, *shape, label, problems);
    if (!problems.found_in("fluid")) check_massless(scene, body, label, problems);
    outlines[i] = std::move(shape);
    outlines[i]->vertices = shape_pose(body) * outlines[i]->vertices;
    for (std::size_t j = 0; j < i; ++j)
      if (outlines[j] && overlap(*outlines[i], *outlines[j]))
        problems.add(label + ".position", "overlaps " + labels.bodies[j],
                     "Bodies may touch, but not share space.");
  }
}

}  // namespace splashdown::apps
