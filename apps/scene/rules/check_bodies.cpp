#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/scene/rules/check.hpp"
#include "apps/scene/rules/rules.hpp"
#include "apps/scene/solid.hpp"

namespace splashdown::apps {
namespace {

void check_name(const Scene& scene, std::size_t i, const std::string& label, Problems& problems) {
  const auto& name = scene.bodies[i].name;
  for (std::size_t j = 0; j < i; ++j)
    if (!name.empty() && scene.bodies[j].name == name)
      problems.add(label + ".name", "is taken by another body", "Give every body its own name.");
}

void check_mass(const Scene& scene, const Body& body, const std::string& label, Problems& problems) {
  if (problems.found_in(label + ".mass") || problems.found_in(label + ".density")) return;
  const bool mass = problems.noted(label + ".mass"), density = problems.noted(label + ".density");
  if (mass && density) problems.add(label + ".density", "mass and density exclude each other", "Remove one of them.");
  if (body.becomes_free() && !mass && !density)
    problems.add_missing(
        label + ".mass",
        fmt::format("a free body needs its mass ({}) or mean density (kg/m^3)", mass_unit(scene.dimension)),
        "Add mass or density, or motion = \"fixed\".");
  if (body.becomes_free() && body.free.empty() && problems.noted(label + ".free"))
    problems.add(label + ".free", "must name at least one of " + listing(freedom_names(scene.dimension)),
                 "For none of them use motion = \"fixed\".");
}

/// A tensor that some distribution of mass has: symmetric, positive, no principal value above the others' sum.
void check_inertia(const Scene& scene, const Body& body, const std::string& label, Problems& problems) {
  if (!body.inertia || scene.dimension == 2 || problems.found_in(label + ".inertia")) return;
  const Eigen::Matrix3d& tensor = *body.inertia;
  const std::string key = label + ".inertia", cure = "Leave it out for that of uniform density.";
  const double digits = 1e-6;  // that people write
  if ((tensor - tensor.transpose()).norm() > digits * tensor.norm())
    return problems.add(key, "must be symmetric", cure);
  const Eigen::Vector3d principal = tensor.selfadjointView<Eigen::Lower>().eigenvalues();
  if (principal[0] <= 0)
    return problems.add(key, fmt::format("must be positive about every axis, not {:g} kg m^2", principal[0]), cure);
  if (principal[2] > (1 + digits) * (principal[0] + principal[1]))
    problems.add(key,
                 fmt::format("no body has moments {:g}, {:g}, {:g} kg m^2 about its principal axes: the largest must "
                             "not exceed the sum of the others",
                             principal[0], principal[1], principal[2]),
                 cure);
}

/// A body without mass moves as the water lets it.
void check_massless(const Scene& scene, const Body& body, const std::string& label, Problems& problems) {
  if (!body.becomes_free() || !body.without_mass) return;
  const std::string key = label + (body.mass ? ".mass" : ".density");
  if (!scene.has_fluid())
    return problems.add(key, "a free body without mass needs a fluid that has inertia for it", "Give it a mass.");
  if (scene.coupling && scene.coupling->interface_term != "rigid")
    problems.add(key, "a free body without mass needs coupling.interface_term = \"rigid\"",
                 "Change the term, or give it a mass.");
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
      return problems.add(
          key,
          fmt::format("times must increase: row {} has {:g} s after {:g} s", i + 1, path[i].time, path[i - 1].time),
          "Sort the rows.");
}

/// The shape's outline in its own frame; nothing, and a problem, if there is none.
template <int d>
std::optional<rigid::Surface<d>> checked_shape(const Body& body, const std::string& label, Problems& problems) {
  if (const auto* wedge = std::get_if<WedgeShape>(&body.shape); wedge && wedge->height) {
    const double chine = wedge->breadth / 2 * std::tan(wedge->deadrise_deg * radians);
    if (*wedge->height < (1 - 1e-6) * chine) {
      problems.add(label + ".shape.height", fmt::format("must not be below that of the faces, {:g} m", chine),
                   "Leave it out for a triangle.");
      return {};
    }
  }
  try {
    return shape_of<d>(body.shape).surface;
  } catch (const std::invalid_argument& error) {
    if (std::holds_alternative<PolygonShape>(body.shape))
      problems.add(label + ".shape.points", error.what(), "List the corners in order, each once.");
    else if (std::holds_alternative<SplineShape>(body.shape))
      problems.add(label + ".shape.points", error.what(), cure_of_spline);
    else if (std::holds_alternative<RevolvedShape>(body.shape))
      problems.add(label + ".shape.profile", error.what(), cure_of_profile);
    else
      problems.add(label + ".shape", error.what(), "Mind the units of its lengths.");
    return {};
  }
}

/// A hull from a file that is larger than its tank is in another unit, most of the time.
std::string unit_question(const Shape& shape, double extent, double tank) {
  const auto* file = std::get_if<SurfaceShape>(&shape);
  if (!file || extent < tank) return {};
  const double thousandth = 1e-3;  // millimetres, what most programs write
  return fmt::format("Is its file in millimetres? shape.scale = {:g} makes it {:.3g} m long. ",
                     file->scale * thousandth, extent * thousandth);
}

template <int d>
void check_inside_tank(const Scene& scene, const Body& body, const rigid::Surface<d>& shape, const std::string& label,
                       Problems& problems) {
  if (!scene.tank) return;
  const Extents<d> tank = extents<d>(*scene.tank);
  if (tank.isEmpty()) return;
  const double tolerance = 1e-9 * tank.diagonal().norm();
  const Extents<d> wide(tank.min().array() - tolerance, tank.max().array() + tolerance);
  std::vector<Waypoint> places{{0, body.position, body.attitude}};
  places.insert(places.end(), body.path.begin(), body.path.end());
  for (const auto& place : places) {
    auto moved = shape;
    moved.vertices = shape_pose<d>(place.position, place.attitude) * shape.vertices;
    const auto box = extents<d>(moved);
    if (wide.contains(box)) continue;
    return problems.add(label + (body.path.empty() ? ".position" : ".path"),
                        fmt::format("the body spans {} m and leaves the tank {} m", text<d>(box), text<d>(tank)),
                        unit_question(body.shape, box.sizes().maxCoeff(), tank.sizes().maxCoeff()) +
                            "Move the body or enlarge the tank.");
  }
}

template <int d>
void check_size(const Scene& scene, const Body& body, const rigid::Surface<d>& shape, const std::string& label,
                Problems& problems) {
  const double extent = extents<d>(shape).sizes().maxCoeff();
  if (!scene.fluid || body.size <= extent) return;
  const bool own = problems.noted(label + ".size");  // what is not given is that of the surface
  problems.add(own ? label + ".size" : "fluid.size.surface",
               fmt::format("must not exceed the body's extent of {:g} m{}", extent,
                           own ? "" : fmt::format(" ({} has no size of its own)", label)),
               "Use e.g. a fiftieth of it.");
}

/// Bodies that a mesh is made around as one, such as a cylinder and what sticks out of it, fixed or elastic.
bool make_one_obstacle(const Scene& scene, std::size_t a, std::size_t b) {
  const auto stays = [&](std::size_t i) { return scene.bodies[i].motion == Motion::fixed || scene.bodies[i].deforms; };
  return scene.ale && stays(a) && stays(b);
}

}  // namespace

template <int d>
void check_bodies(const Scene& scene, const SceneLabels& labels, Problems& problems) {
  std::vector<std::optional<Solid<d>>> solids(scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const auto& body = scene.bodies[i];
    const auto& label = labels.bodies[i];
    check_name(scene, i, label, problems);
    check_mass(scene, body, label, problems);
    check_inertia(scene, body, label, problems);
    check_path(body, label, problems);
    if (problems.found_in(label + ".shape")) continue;
    auto shape = checked_shape<d>(body, label, problems);
    if (!shape) continue;
    const auto misplaced = [&](const char* key) { return problems.found_in(label + key); };
    if (misplaced(".position") || misplaced(".heading_deg") || misplaced(".pitch_deg") || misplaced(".roll_deg") ||
        misplaced(".path"))
      continue;
    if (!body.makes_waves) check_inside_tank<d>(scene, body, *shape, label, problems);  // its table has a rule for that
    check_size<d>(scene, body, *shape, label, problems);
    if (!problems.found_in("fluid")) check_massless(scene, body, label, problems);
    shape->vertices = shape_pose<d>(body) * shape->vertices;
    solids[i].emplace(*shape);
    for (std::size_t j = 0; j < i; ++j)
      if (solids[j] && !make_one_obstacle(scene, i, j) && overlap<d>(*solids[i], *solids[j]))
        problems.add(label + ".position", "overlaps " + labels.bodies[j], "Bodies may touch, but not share space.");
  }
}

template void check_bodies<2>(const Scene&, const SceneLabels&, Problems&);
template void check_bodies<3>(const Scene&, const SceneLabels&, Problems&);

}  // namespace splashdown::apps
