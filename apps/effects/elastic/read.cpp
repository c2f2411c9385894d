#include <fmt/format.h>

#include "apps/effects/elastic/elastic.hpp"
#include "apps/effects/elastic/solid.hpp"
#include "apps/scene/read/parts.hpp"

namespace splashdown::apps {
namespace {

void read_ply(Reader& reader, ElasticPly& ply, int dimension) {
  const auto three = [&](const char* name, std::vector<double>& target, const Rule& rule) {
    reader.numbers(name, target, rule);
    if (target.size() == 3 || reader.context().sketch || reader.context().problems.found_in(reader.key(name))) return;
    reader.context().problems.add(reader.key(name), "must be three numbers", rule.cure);
  };
  three("young_moduli", ply.young_moduli,
        positive("Pa", "Use those along the fibres, across them and along the normal: [135e9, 9e9, 9e9]."));
  three("poisson_ratios", ply.poisson_ratios, any("", "Use nu_12, nu_13, nu_23: [0.3, 0.3, 0.45]."));
  three("shear_moduli", ply.shear_moduli, positive("Pa", "Use G_12, G_13, G_23: [5e9, 5e9, 3e9]."));
  reader.point("fibres", ply.fibres,
               any("", "Use their direction in the shape's frame, e.g. " + axis_example(dimension, 1) + "."));
  if (dimension == 3)
    reader.point("normal", ply.normal, any("", "Use the direction across the ply, e.g. [0.0, 0.0, 1.0]."));
  auto& problems = reader.context().problems;
  constexpr double least = 1e-6;  // sine of the angle between both
  if (!(ply.fibres.norm() > 0))
    problems.add(reader.key("fibres"), "must not be zero", "Use a direction, e.g. [1.0, 0.0].");
  else if (!(ply.fibres.normalized().cross(ply.normal).norm() > least * ply.normal.norm()))
    problems.add(reader.key("normal"), "must be across the fibres", "Use e.g. [0.0, 0.0, 1.0].");
}

/// `given`: what the law already has, so that nothing has to be repeated.
void read_law(Reader& reader, ElasticMaterial& material, int dimension, const ElasticMaterial* given = nullptr) {
  reader.choice("law", material.law, elastic_laws());
  if (given && reader.context().sketch) {  // what goes with what depends on the body's law
    if (auto ply = reader.table("ply")) read_ply(*ply, material.ply, dimension);
    reader.number("young_modulus", material.young_modulus, positive("Pa", "Use e.g. 70e9 for aluminium."));
    reader.number("poisson_ratio", material.poisson_ratio, within(-1, 0.5, "", "Use e.g. 0.33 for aluminium."));
    return;
  }
  const bool is_ply = material.law == "orthotropic";
  const bool known = given && (given->law == "orthotropic") == is_ply;
  const Need need = known ? Need::optional : Need::required;
  if (is_ply) {
    if (auto ply = reader.table("ply", need)) read_ply(*ply, material.ply, dimension);
    const std::string rule = "an orthotropic law has its moduli in ply", cure = "Remove it.";
    reader.refuse("young_modulus", rule, cure);
    reader.refuse("poisson_ratio", rule, cure);
    return;
  }
  reader.refuse("ply", "only law = \"orthotropic\" has plies", "Remove it, or change the law.");
  reader.number("young_modulus", material.young_modulus, positive("Pa", "Use e.g. 70e9 for aluminium, 1e6 for rubber."),
                need);
  const std::string cure = "Use e.g. 0.33 for aluminium, 0.49 for rubber.";
  reader.number("poisson_ratio", material.poisson_ratio, within(-1, 0.5, "", cure), need);
  auto& problems = reader.context().problems;
  const double nu = material.poisson_ratio;
  if (!problems.found_in(reader.key("poisson_ratio")) && (nu == -1 || nu == 0.5))
    problems.add(reader.key("poisson_ratio"),
                 nu == 0.5 ? "must be below 0.5: what does not change its volume has no finite bulk modulus"
                           : "must be above -1",
                 cure);
}

void read_mesh(Reader& reader, ElasticTable& table, double& refine, int dimension) {
  const bool sketch = reader.context().sketch != nullptr;
  auto mesh = reader.table("mesh", Need::optional);
  if (mesh) {
    mesh->file("file", table.mesh_file, "Name a .msh file of Gmsh; relative names begin at the folder of the scene.");
    mesh->number("scale", table.mesh_scale,
                 positive("", "Use metres per unit of the file: 0.001 if it is in millimetres."));
  }
  if (mesh && !sketch) {
    for (const char* key : {"size", "refine", "adapt"})
      reader.refuse(key, "the elements are those of the mesh", "Remove it, or the mesh.");
    return;
  }
  refine = reader.divisor("refine", within(0.01, 100, "", "Use e.g. 2 for elements of half the size."), presets);
  reader.number("size", table.size, refined(positive("m", "Use half of the thinnest part, e.g. 0.01."), refine),
                sketch ? Need::optional : Need::required);
  if (dimension == 3)
    reader.refuse("adapt", "meshes in space are not refined for goals", "Remove it, or use a smaller size.");
  else
    reader.integer("adapt", table.adapt, within(0, 20, "", "Use e.g. 5: the mesh is refined so often for the goals."));
}

void read_scheme(Reader& reader, ElasticTable& table) {
  reader.choice("scheme", table.scheme, elastic_schemes());
  if (table.scheme == "generalised_alpha")
    reader.number("spectral_radius", table.spectral_radius,
                  within(0, 1, "", "Use 1 to damp nothing, 0 to damp most what is fast."));
  else
    reader.refuse("spectral_radius", "only scheme = \"generalised_alpha\" has one", "Remove it, or change the scheme.");
  if (table.scheme == "shifted_crank_nicolson")
    reader.number("shift", table.shift, not_negative("1/s", "Use e.g. 1: theta is 1/2 + shift dt."));
  else
    reader.refuse("shift", "only scheme = \"shifted_crank_nicolson\" has one", "Remove it, or change the scheme.");
  Reader rayleigh = reader.table_or_defaults("rayleigh");
  rayleigh.number("mass", table.mass_damping, not_negative("1/s", "Use 2 w times the damping ratio of a mode."));
  rayleigh.number("stiffness", table.stiffness_damping,
                  not_negative("s", "Use twice the damping ratio of a mode over its w."));
}

/// `act`: what of the region, "held" or "loaded"; `polygons`: whether one may be given.
void read_region(Reader& reader, ElasticRegion& region, int dimension, const std::string& act, bool polygons = false) {
  const Rule place = place_rule(dimension);
  reader.point("centre", region.centre, place);
  reader.number("radius", region.radius, positive("m", "Use e.g. the radius of a bolt or of a piezo."));
  reader.point("min", region.min, place);
  reader.point("max", region.max, place);
  std::vector<std::vector<double>> corners;
  if (polygons) reader.rows("points", corners, 2, place);
  for (const auto& corner : corners) region.points.emplace_back(corner[0], corner[1], 0);
  auto& problems = reader.context().problems;
  if (reader.context().sketch || problems.found_in(reader.path())) return;
  const bool has_any = region.centre || region.radius || region.min || region.max;
  constexpr std::size_t fewest = 3;
  if (!has_any && region.points.size() >= fewest) return;
  if (!region.points.empty() && !has_any)
    return problems.add(reader.key("points"), "must be three at least", "Give the corners of a polygon in turn.");
  if (!region.points.empty())
    return problems.add(reader.path(), "has more than one region", "Use points, centre and radius, or min and max.");
  if ((region.centre && region.radius && !region.min && !region.max) ||
      (region.min && region.max && !region.centre && !region.radius))
    return;
  problems.add(reader.path(), "says not what is " + act, "Use centre and radius, or min and max.");
}

void read_part(Reader& reader, ElasticTable& table, int dimension) {
  ElasticPart part;
  static_cast<ElasticMaterial&>(part) = table;
  part.path = reader.path();
  read_name(reader, part.name, "frame");
  read_law(reader, part, dimension, &table);
  reader.number("density", part.density, positive("kg/m3", "Use e.g. 1600 for carbon fibre, 60 for foam."));
  read_region(reader, part.region, dimension, "meant", dimension == 2);
  table.parts.push_back(std::move(part));
}

void read_clamp(Reader& reader, ElasticClamp& clamp, int dimension) {
  const bool plane = dimension == 2;
  reader.choices("axes", clamp.axes, plane ? Reader::Names{"x", "y"} : Reader::Names{"x", "y", "z"});
  reader.curve("velocity", clamp.velocity, plane ? 3 : 4,
               any("m/s", plane ? "Use [0.0, -30.0], or rows of a time and two components: [[0, 0, 0], [0.1, 0, -2]]."
                                : "Use [0.0, 0.0, -30.0], or rows of a time and three components."));
  read_region(reader, clamp, dimension, "held");
}

void read_patch(Reader& reader, ElasticPatch& patch, int dimension) {
  read_region(reader, patch.region, dimension, "loaded");
  const bool plane = dimension == 2;
  reader.curve("traction", patch.traction, plane ? 3 : 4,
               any("Pa", plane ? "Use [0.0, 1e3], or rows of a time and two components."
                               : "Use [0.0, 0.0, 1e3], or rows of a time and three components."));
  reader.curve("pressure", patch.pressure, 2, any("Pa", "Use e.g. 1e3, or rows of a time and a pressure."));
  reader.curve("stretch", patch.stretch, 2, any("N/m", "Use e.g. 100, or rows of a time and a force along the rim."));
  if (auto burst = reader.table("burst")) {
    patch.frequency.emplace();
    burst->number("frequency", *patch.frequency, positive("Hz", "Use that of the tone, e.g. 100e3."), Need::required);
    burst->number("cycles", patch.cycles,
                  within(1, 1000, "", "Use e.g. 5: more make a narrower spectrum and a longer signal."));
    burst->number("start", patch.start, not_negative("s", "Use when the burst begins."));
  }
  auto& problems = reader.context().problems;
  if (reader.context().sketch || problems.found_in(reader.path())) return;
  const auto loads = !patch.traction.empty() + !patch.pressure.empty() + !patch.stretch.empty();
  if (loads != 1)
    problems.add(reader.path(), loads == 0 ? "has no load" : "has more than one load",
                 "Give one of traction, pressure and stretch; add patches for more.");
  else if (!patch.stretch.empty() && !patch.region.centre)
    problems.add(reader.key("stretch"), "acts on the rim of a disc, in the plane on both ends of a strip",
                 "Use centre and radius in place of min and max.");
}

/// One, or `count` on the way to `to`: NAME_1 and so on, with as many digits as the last has.
void read_points(Reader& reader, std::vector<ElasticPoint>& all, int dimension) {
  ElasticPoint point;
  const Rule place = place_rule(dimension);
  read_name(reader, point.name, "tip");
  point.path = reader.path();
  reader.point("point", point.point, place, Need::required);
  reader.choices("signals", point.signals, elastic_signals());
  std::optional<Point> to;
  reader.point("to", to, place);
  if (!to && !reader.context().sketch) {
    reader.refuse("count", "one point is no line", "Remove it, or add to, where the line of points ends.");
    all.push_back(point);
    return;
  }
  int count = 10;
  reader.integer("count", count, within(2, 1000, "", "Use how many points there are from point to to."));
  for (int k = 0; to && k < count; ++k) {
    auto& one = all.emplace_back(point);
    one.name = fmt::format("{}_{:0{}}", point.name, k + 1, std::to_string(count).size());
    one.point += k * (*to - point.point) / (count - 1);
  }
}

void read_goal(Reader& reader, ElasticGoal& goal, int dimension) {
  goal.path = reader.path();
  reader.text("point", goal.point, "Use the name of a [[body.elastic.point]], e.g. \"tip\".");
  reader.choice("direction", goal.direction, dimension == 2 ? Reader::Names{"x", "y"} : Reader::Names{"x", "y", "z"});
  reader.integer("mode", goal.mode, within(1, 1000, "", "Use 1 for the lowest natural frequency."));
  auto& problems = reader.context().problems;
  if (reader.context().sketch || problems.found_in(reader.path())) return;
  if (goal.point.empty() == (goal.mode == 0))
    problems.add(reader.path(), goal.mode > 0 ? "asks for a point and for a mode" : "says not what is asked for",
                 "Give point, whose displacement is told, or mode, whose frequency is.");
}

}  // namespace

void ElasticKind::read(Reader& reader, Scene& scene) const {
  const int dimension = scene.dimension;
  auto& table = scene.effects.table<ElasticTables>().of_bodies.emplace_back();
  table.body = scene.bodies.size() - 1;
  scene.bodies.back().deforms = true;
  table.path = reader.path();
  read_law(reader, table, dimension);
  reader.each_table("part", [&](Reader& part) { read_part(part, table, dimension); });
  read_mesh(reader, table, scene.bodies.back().refine, dimension);
  read_scheme(reader, table);
  reader.each_table("clamp", [&](Reader& clamp) { read_clamp(clamp, table.clamps.emplace_back(), dimension); });
  reader.each_table("patch", [&](Reader& patch) { read_patch(patch, table.patches.emplace_back(), dimension); });
  reader.choice("start", table.start, {"undeformed", "equilibrium"});
  const Rule place = place_rule(dimension);
  reader.each_table("point_mass", [&](Reader& part) {
    auto& mass = table.point_masses.emplace_back();
    part.number("mass", mass.mass, positive(mass_unit(dimension), "Use the mass of what is attached."), Need::required);
    part.point("point", mass.point, place, Need::required);
  });
  reader.each_table("point", [&](Reader& part) { read_points(part, table.points, dimension); });
  reader.each_table("goal", [&](Reader& part) { read_goal(part, table.goals.emplace_back(), dimension); });
  reader.integer("modes", table.modes, within(0, 1000, "", "Use how many natural frequencies are to be told."));
  reader.choice("coordinates", table.coordinates, {"nodes", "modes", "both"});
}

}  // namespace splashdown::apps
