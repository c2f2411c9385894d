// Rules of elastic bodies, and what is told of them before a run.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>

#include "apps/effects/elastic/clamps.hpp"
#include "apps/effects/elastic/elastic.hpp"
#include "apps/effects/elastic/solid.hpp"
#include "apps/effects/force/force.hpp"
#include "apps/effects/gravity/gravity.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/rules/problems.hpp"
#include "elastic/mesh/thickness.hpp"

namespace splashdown::apps {
namespace {

constexpr double most_elements = 2e5;  // 0.4 million nodes, whose factors take several GB

std::string label_of(const ElasticTable& table) { return table.path.substr(0, table.path.rfind('.')); }

/// Effects that act on elastic bodies, or on the fluid around them alone.
bool meets_elastic(std::string_view effect) {
  constexpr std::array<std::string_view, 7> all = {"gravity",         "force", "elastic", "viscosity",
                                                   "compressibility", "waves", "absorber"};
  return std::ranges::find(all, effect) != all.end();
}

/// What elastic bodies do not meet yet.
void check_company(const Scene& scene, const ElasticTables& tables, Problems& problems) {
  const auto& path = tables.of_bodies.front().path;
  if (scene.vortex)
    problems.add(path, "a fluid on a grid presses on rigid bodies alone",
                 "Remove the table for a rigid body, or formulation for a fluid of finite elements.");
  if (scene.has_fluid())
    for (const auto& table : tables.of_bodies)
      if (table.start != "undeformed")
        problems.add(table.path + ".start", "in a fluid a body begins undeformed", "Remove it.");
  if (scene.has_fluid())
    for (const auto& table : tables.of_bodies)
      if (problems.noted(table.path + ".scheme") && table.scheme != ElasticTable{}.scheme)
        problems.add(table.path + ".scheme",
                     "in a fluid a body takes the fluid's steps, by kicks and the midpoint rule", "Remove it.");
  if (tables.of_bodies.front().body + tables.of_bodies.size() != scene.bodies.size())
    problems.add(path, "rigid bodies stand before elastic ones in a scene",
                 "Move the [[body]] tables of elastic bodies to the end.");
  if (!scene.joints.empty()) problems.add("joint", "joints do not hold elastic bodies", "Use clamp in [body.elastic].");
  if (scene.contact) problems.add("contact", "elastic bodies do not touch each other yet", "Remove the table.");
  for (const auto* kind : effect_kinds())
    if (kind->present(scene) && !meets_elastic(kind->name()))
      problems.add(std::string(kind->name()), "does not act on elastic bodies", "Remove the table.");
}

/// Of the rows of probes.csv.
void check_point_names(const ElasticTables& tables, Problems& problems) {
  std::set<std::string> names, told;
  for (const auto& table : tables.of_bodies)
    for (const auto& point : table.points)
      if (!names.insert(point.name).second && told.insert(point.path).second)
        problems.add(point.path, "is taken by another point", "Give every point its own name.");
}

/// Keys of [[body]] that rigid bodies have.
void check_body_keys(const Body& body, const std::string& label, Problems& problems) {
  if (body.motion != Motion::free)
    problems.add(label + ".motion", "an elastic body is free but for what is clamped",
                 "Remove it, and use clamp in [body.elastic].");
  const bool is_free_in_all = body.free == freedom_names(2) || body.free == freedom_names(3);
  for (const char* key : {".free", ".inertia", ".centre_of_mass"})
    if (problems.noted(label + key) && !(is_free_in_all && std::string_view(key) == ".free"))
      problems.add(label + key, "an elastic body has it from its mesh",
                   "Remove it; use clamp and point_mass in [body.elastic].");
  if (body.without_mass)
    problems.add(label + (body.mass ? ".mass" : ".density"), "an elastic body needs a mass", "Give it one.");
}

void check_forces(const Scene& scene, const ElasticTable& table, const auto& lies_in, Problems& problems) {
  const auto* forces = scene.effects.find<ForceTables>();
  if (!forces) return;
  const auto key = label_of(table) + ".force";
  for (const auto& force : forces->all) {
    if (force.body != table.body) continue;
    if (!force.moment.empty())
      problems.add(key, "moments do not act on points of an elastic body", "Use two forces.");
    else if (force.axes != "world")
      problems.add(key, "forces on elastic bodies do not turn with them", "Use axes = \"world\".");
    else if (!force.point)
      problems.add(key, "a force on an elastic body acts at a point of it", "Add point.");
    else if (!lies_in(*force.point))
      problems.add(key, "its point is not in the body", "Move it into the undeformed body, in the shape's frame.");
  }
}

template <int d>
void check_patches(const ElasticTable& table, const elastic::SolidMesh<d>& mesh, Problems& problems) {
  for (std::size_t k = 0; k < table.patches.size(); ++k)
    if (!meets_boundary<d>(table.patches[k], mesh))
      problems.add(fmt::format("{}.patch[{}]", table.path, k), "loads nothing: no part of the boundary lies there",
                   "Move or enlarge it (shape's frame); a piezo's middle lies on the boundary.");
}

void check_goals(const Scene& scene, const ElasticTable& table, int unknowns, Problems& problems) {
  if (table.adapt > 0 && table.goals.empty())
    problems.add(table.path + ".adapt", "there is no goal to refine the mesh for",
                 "Add [[body.elastic.goal]] with point = \"NAME\" or mode = 1.");
  if (table.adapt > 0 && scene.has_fluid())
    problems.add(table.path + ".adapt", "in a fluid the mesh is not refined for goals",
                 "Remove it, or use a smaller size.");
  for (const auto& goal : table.goals) {
    const int most = unknowns / 4;  // of what clamps leave free
    if (goal.mode > most)
      problems.add(goal.path + ".mode", fmt::format("must be {} at most on this mesh", most),
                   "Ask for a lower one, or use smaller elements.");
    if (goal.mode > 0) continue;
    if (std::ranges::find(table.points, goal.point, &ElasticPoint::name) == table.points.end())
      problems.add(goal.path + ".point", fmt::format("there is no point '{}'", goal.point),
                   "Use the name of a [[body.elastic.point]] of this body.");
    if (scene.has_fluid() || table.scheme != "steady")
      problems.add(goal.path, "the adjoint of a displacement is that of an equilibrium",
                   scene.has_fluid() ? "Remove the table, or ask for a mode."
                                     : "Use scheme = \"steady\", ask for a mode, or remove the table.");
  }
}

template <int d>
void check_parts(const Body& body, const ElasticTable& table, const elastic::SolidMesh<d>& mesh, Problems& problems) {
  const auto numbers = parts_of<d>(table, mesh);
  std::set<std::string> names;
  for (std::size_t p = 0; p < table.parts.size(); ++p) {
    const auto& part = table.parts[p];
    if (std::ranges::find(numbers, static_cast<int>(p) + 1) == numbers.end())
      problems.add(part.path, "covers no element's middle, or later parts cover all of them",
                   "Move or enlarge it (shape's frame), or use smaller elements.");
    if (!names.insert(part.name).second)
      problems.add(part.path + ".name", "is taken by another part", "Give every part its own name.");
    if (part.density && body.mass)
      problems.add(part.path + ".density", "has no meaning beside the mass of the whole body",
                   "Give the body a density in place of its mass.");
  }
}

template <int d>
void check_mesh(const Scene& scene, const ElasticTable& table, Problems& problems) {
  const auto& body = scene.bodies[table.body];
  const auto label = label_of(table);
  const auto box = extents<d>(shape_of<d>(body.shape).surface);
  const bool from_file = !table.mesh_file.empty();
  const std::string key = table.path + (from_file ? ".mesh" : ".size");
  double elements = box.volume() / std::pow(table.size, d) * 2;
  if (!from_file && table.size > box.sizes().maxCoeff())
    return problems.add(key, fmt::format("must not exceed the body's extent of {:g} m", box.sizes().maxCoeff()),
                        "Use half of its thinnest part.");
  std::string cure = "Use larger elements.";
  if constexpr (d == 3)
    if (!from_file) {
      const auto told = elastic::forecast(shape_of<3>(body.shape).surface, table.size);
      elements = told.elements;
      if (told.thin < table.size)
        cure = fmt::format("Parts of {:.2g} m get elements as small: make them thicker, or give a mesh of Gmsh.",
                           told.thin);
    }
  if (!from_file && elements > most_elements)
    return problems.add(key, fmt::format("makes about {:.1g} elements, {:g} are the most", elements, most_elements),
                        cure);
  elastic::SolidMesh<d> mesh;
  try {
    mesh = solid_mesh<d>(body, table);
  } catch (const elastic::MeshError& error) {
    return problems.add(key, error.what(), error.cure);
  }
  const Extents<d> drawn(mesh.nodes.rowwise().minCoeff(), mesh.nodes.rowwise().maxCoeff());
  constexpr double same = 0.02;  // of the extent: chords of curved hulls
  if (from_file && ((drawn.min() - box.min()).cwiseAbs().maxCoeff() > same * box.sizes().maxCoeff() ||
                    (drawn.max() - box.max()).cwiseAbs().maxCoeff() > same * box.sizes().maxCoeff()))
    return problems.add(key, fmt::format("the mesh spans {} m, the shape {} m", text<d>(drawn), text<d>(box)),
                        "Draw both in the same frame; mesh.scale is metres per unit of the file.");
  check_parts<d>(body, table, mesh, problems);
  check_clamps<d>(scene, table, mesh, problems);
  check_patches<d>(table, mesh, problems);
  check_goals(scene, table, d * mesh.size(), problems);
  const auto lies_in = [&](const Point& point) { return place_in<d>(mesh, point).has_value(); };
  check_forces(scene, table, lies_in, problems);
  const std::string rule = "is not in the body";
  cure = "Move it into the undeformed body, in the shape's frame.";
  for (std::size_t k = 0; k < table.point_masses.size(); ++k)
    if (!lies_in(table.point_masses[k].point))
      problems.add(fmt::format("{}.point_mass[{}].point", table.path, k), rule, cure);
  for (const auto& point : table.points)
    if (!lies_in(point.point)) problems.add(point.path, rule, cure);
}

template <int d>
void check_table(const Scene& scene, const ElasticTable& table, Problems& problems) {
  const auto& body = scene.bodies[table.body];
  const auto label = label_of(table);
  check_body_keys(body, label, problems);
  if (problems.found_in(table.path) || problems.found_in(label + ".shape")) return;
  std::string path = table.path;
  const ElasticMaterial* material = &table;
  try {
    solid_law<d>(body, table);
    for (const auto& part : table.parts) {
      path = part.path;
      material = &part;
      solid_law<d>(body, part);
    }
    shape_of<d>(body.shape);
  } catch (const std::invalid_argument& error) {
    if (material->law == "orthotropic") problems.add(path + ".ply", error.what(), "Use measured moduli of one ply.");
    return;  // of the shape its own check speaks
  }
  check_mesh<d>(scene, table, problems);
}

}  // namespace

void ElasticKind::check(const Scene& scene, Problems& problems) const {
  const auto* tables = scene.effects.find<ElasticTables>();
  if (!tables) return;
  check_company(scene, *tables, problems);
  check_point_names(*tables, problems);
  for (const auto& table : tables->of_bodies)
    scene.dimension == 2 ? check_table<2>(scene, table, problems) : check_table<3>(scene, table, problems);
}

std::vector<NamedNumber> ElasticKind::numbers(const Scene& scene) const {
  std::vector<NamedNumber> all;
  const auto* tables = scene.effects.find<ElasticTables>();
  if (!tables) return all;
  for (const auto& table : tables->of_bodies) {
    const auto& name = scene.bodies[table.body].name;
    all.push_back({.name = name + ".peak_von_mises",
                   .unit = "Pa",
                   .paths = {"bodies." + name + ".peak_von_mises.value"},
                   .body = name});
    for (const auto& goal : table.goals) {
      const auto of = "goals." + name_of(goal, name);
      all.push_back(
          {.name = of, .unit = goal.mode > 0 ? "Hz" : "m", .paths = {of + ".value"}, .body = name, .peak = false});
    }
  }
  return all;
}

void ElasticKind::ask(const AskedScene& asked, std::vector<std::string>& questions) const {
  const auto* tables = asked.scene.effects.find<ElasticTables>();
  if (!tables) return;
  for (const auto& table : tables->of_bodies) {
    const auto& body = asked.scene.bodies[table.body];
    constexpr double coarse = 4;  // parts of a facet in which loads vary, but pressures do not
    if (asked.scene.has_fluid() && table.size > 0 && body.size > coarse * table.size)
      questions.push_back(fmt::format(
          "{}.size = {:g} m: the water's elements are {:.2g} times those of the body that bends, {:g} m: did you mean "
          "{:.2g}? Loads would know nothing of what the body's elements resolve",
          label_of(table), body.size, body.size / table.size, table.size, table.size));
    if (asked.scene.dimension != 3 || !table.mesh_file.empty() || !(table.size > 0)) continue;
    constexpr double thick = 4;  // a slip of units or of a digit is more
    const auto told = elastic::forecast(shape_of<3>(body.shape).surface, table.size);
    if (table.size > thick * told.thin)
      questions.push_back(
          fmt::format("{}.size = {:g} m is {:.2g} times the thickness of parts of the shape, {:.2g} m: did you mean "
                      "{:.2g}? Elements are "
                      "as small there all the same, about {:.1g} of them in all",
                      table.path, table.size, table.size / told.thin, told.thin, told.thin / 2, told.elements));
  }
}

}  // namespace splashdown::apps
