#include "apps/scene/read/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/scene/choose/refine.hpp"
#include "apps/scene/kinds/effect_kind.hpp"
#include "apps/scene/kinds/formulation_kinds.hpp"
#include "apps/scene/read/fill_sizes.hpp"
#include "apps/scene/read/override.hpp"
#include "apps/scene/read/parts.hpp"
#include "apps/scene/rules/check.hpp"
#include "apps/scene/terrain.hpp"

namespace splashdown::apps {
namespace {

/// Finest element size of the scene.
double finest(const Scene& scene) {
  double h = std::min(scene.fluid->size.surface, scene.fluid->size.far);
  if (scene.tank) h = std::min(h, scene.tank->size);
  for (const auto& body : scene.bodies) h = std::min(h, body.size);
  return h;
}

/// Surface waves as short as the elements stay stable in an explicit scheme, which bounds dt by
/// 2 / sqrt(pi |g| / h) = 1.13 sqrt(h / |g|). Without such waves: a hundred steps at least.
double default_dt_max(const Scene& scene) {
  const double g = scene.gravity ? scene.gravity->acceleration.norm() : 0;
  return scene.fluid && g > 0 ? scene.time.cfl * std::sqrt(finest(scene) / g) : scene.time.end / 100 / refine_of(scene);
}

bool meets_fluid_freely(const Scene& scene) {
  return scene.has_fluid() &&
         std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& body) { return body.becomes_free(); });
}

void read_tank(Reader& reader, Scene& scene) {
  const Rule place = place_rule(scene.dimension);
  auto& tank = scene.tank.emplace();
  reader.point("min", tank.min, place, Need::required);
  reader.point("max", tank.max, place, Need::required);
  if (!scene.fluid) return reader.skip("size");
  tank.size = scene.fluid->size.far;
  reader.number("size", tank.size, refined(positive("m", "Use e.g. fluid.size.far."), scene.fluid->size.refine));
}

void read_output(Reader& reader, Output& output) {
  reader.interval("interval", output.interval, not_negative("s", "Use 0 for a row every step."));
  reader.number("frames", output.frames,
                not_negative("s", "Use e.g. a hundredth of time.end; leave it out for no frames."));
  reader.number("checkpoint", output.checkpoint, positive("s", "Use wall-clock seconds, e.g. 60."));
}

/// The tables of effects that stand there, each by its own kind. A body that one makes is told by its table.
void read_effects(Reader& around, TablePlace place, Scene& scene, SceneLabels& labels) {
  for (const auto* kind : effect_kinds()) {
    if (kind->place() != place) continue;
    if (place == TablePlace::array || place == TablePlace::body_array)
      around.each_table(kind->name(), [&](Reader& reader) { kind->read(reader, scene); });
    else if (auto reader = around.table(kind->name()))
      kind->read(*reader, scene);
    labels.bodies.resize(scene.bodies.size(), std::string(kind->name()));
  }
}

/// What only formulations on other media know.
void refuse_tables_of_others(Reader& reader, FluidMedium medium) {
  const auto refuse = [&](std::initializer_list<const char*> tables, const char* formulation) {
    for (const char* table : tables)
      reader.refuse(table, fmt::format("belongs to formulation = \"{}\"", formulation),
                    "Ask for that formulation, or remove the table.");
  };
  if (medium != FluidMedium::grid) refuse({"grid", "stream", "particles", "penalisation"}, "vortex");
  if (medium != FluidMedium::mesh) refuse({"domain", "sides", "inflow", "ale"}, "ale");
  if (medium == FluidMedium::particles) return;
  const std::string what = medium == FluidMedium::grid ? "a fluid on a grid" : "a fluid between sides",
                    cure = "Remove it, or use formulation = \"fractional\" or \"monolithic\".";
  for (const char* table : {"region", "monolithic"}) reader.refuse(table, what + " has none", cure);
  for (const EffectKind* kind : effect_kinds())
    if (kind->place() == TablePlace::fluid && kind->name() != "viscosity")
      reader.refuse(kind->name(), what + " does not carry this effect", cure);
}

void read_formulation(Reader& reader, Scene& scene, SceneLabels& labels) {
  std::vector<std::string> valid;
  for (const auto& kind : formulation_kinds())
    if (scene.dimension == 2 || kind.medium == FluidMedium::particles) valid.emplace_back(kind.name);
  auto formulation = valid.front();
  if (!reader.choice("formulation", formulation, valid)) return reader.skip_all();
  const FluidMedium medium = named(formulation_kinds(), formulation).medium;
  refuse_tables_of_others(reader, medium);
  if (medium == FluidMedium::grid) return read_vortex(reader, scene.vortex.emplace());
  if (medium == FluidMedium::mesh) return read_ale(reader, scene.ale.emplace());
  auto& fluid = scene.fluid.emplace();
  fluid.formulation = formulation;
  read_fluid(reader, fluid);
  read_effects(reader, TablePlace::fluid, scene, labels);
}

SceneLabels read_tables(Reader& root, Scene& scene) {
  SceneLabels labels;
  root.text("title", scene.title, "Use a short text in quotes.");
  Reader time = root.table_or_defaults("time");
  time.number("end", scene.time.end, positive("s", "Use the simulated time at which the run shall end."),
              Need::required);
  time.number("cfl", scene.time.cfl, share("Use e.g. 0.5."));
  if (time.holds("end") && time.place("end").line == 0 && !root.context().problems.found_in("time.end"))
    root.context().clip_to = scene.time.end;
  auto fluid = root.table("fluid");
  if (fluid) read_formulation(*fluid, scene, labels);
  if (scene.fluid)
    for (std::size_t i = 0; i < scene.fluid->regions.size(); ++i)
      labels.regions.push_back(fmt::format("fluid.region[{}]", i));
  if (auto tank = root.table("tank")) read_tank(*tank, scene);
  read_effects(root, TablePlace::scene, scene, labels);
  root.each_table("body", [&](Reader& reader) {
    labels.bodies.push_back(reader.path());
    read_body(reader, scene.bodies.emplace_back(), scene);
    read_effects(reader, TablePlace::body, scene, labels);
    read_effects(reader, TablePlace::body_array, scene, labels);
  });
  root.each_table("joint", [&](Reader& reader) {
    auto joint = read_joint(reader, scene);
    if (!joint) return;
    labels.joints.push_back(reader.path());
    scene.joints.push_back(*joint);
  });
  if (scene.vortex) finish_vortex(*fluid, scene);
  if (auto contact = root.table("contact")) read_contact(*contact, scene.contact.emplace());
  read_effects(root, TablePlace::after_bodies, scene, labels);
  read_effects(root, TablePlace::array, scene, labels);
  scene.time.dt_max = default_dt_max(scene);
  time.number("dt_max", scene.time.dt_max,
              refined(positive("s", "Leave it out for a sensible value."), refine_of(scene)));
  if (meets_fluid_freely(scene)) {
    Reader coupling = root.table_or_defaults("coupling");
    read_coupling(coupling, scene.coupling.emplace());
  } else if (auto coupling = root.table("coupling")) {
    Coupling nothing_to_couple;  // still checked: a fixed body may be freed by the next --set
    read_coupling(*coupling, nothing_to_couple);
  }
  Reader output = root.table_or_defaults("output");
  read_output(output, scene.output);
  root.each_table("record", [&](Reader& reader) {
    labels.records.push_back(reader.path());
    const auto before = scene.records.size();
    read_record(reader, scene);
    if (scene.records.size() == before) return labels.records.pop_back();
    read_limit_of_record(reader, scene);
    labels.limits.resize(scene.limits.size(), reader.path() + ".limit");
  });
  root.each_table("limit", [&](Reader& reader) {
    read_limit(reader, scene);
    labels.limits.resize(scene.limits.size(), reader.path());
  });
  return labels;
}

/// Whether the tank's corners, or the places of bodies, have so many numbers.
bool has_points_of(std::size_t numbers, const toml::table& table) {
  const auto fits = [&](const toml::node_view<const toml::node>& point) {
    return point.is_array() && point.as_array()->size() == numbers;
  };
  if (fits(table["tank"]["min"])) return true;
  const auto* bodies = table["body"].as_array();
  return bodies && std::ranges::any_of(*bodies, [&](const toml::node& body) {
           return body.is_table() && fits((*body.as_table())["position"]);
         });
}

SceneLabels read_all(ReadContext& context, const toml::table& table, Scene& scene) {
  Reader root(context, table, "", "");
  root.ignore("provenance");  // what a run writes into scene.resolved.toml
  root.integer("dimension", scene.dimension, within(2, 3, "", "Use 2 or 3."));
  if (!table.contains("dimension") && has_points_of(3, table)) {
    context.problems.add_missing("dimension", "the tank and the bodies are in space, and without it a scene is plane",
                                 "Write dimension = 3 above the first table.");
    scene.dimension = 3;
  }
  context.dimension = scene.dimension;
  auto labels = read_tables(root, scene);
  if (!context.sketch) cut_terrain(scene, labels, context.problems);
  return labels;
}

/// The scene without the sizes that it leaves open; nothing if anything is wrong with it.
std::optional<Scene> read_without_sizes(const toml::table& table, const std::filesystem::path& folder) {
  Problems problems("");
  Echo unused;
  ReadContext context{.problems = problems, .echo = unused, .folder = folder};
  Scene scene;
  read_all(context, table, scene);
  return problems.empty() ? std::optional(scene) : std::nullopt;
}

/// Free bodies without mass have the least that a body in this fluid has. Where one hardly touches the water nothing else tells how it
/// moves: a direction along the hull has no inertia there, and roundoff would be its velocity.
void give_least_mass(Scene& scene) {
  for (auto& body : scene.bodies) {
    if (!body.becomes_free() || !scene.has_fluid() || !body.without_mass) continue;
    body.mass.reset();
    body.density = least_density * scene.fluid_density();
  }
}

SceneFile read_root(toml::table& table, const std::filesystem::path& folder, Problems& problems) {
  SceneFile file;
  if (sizes_are_open(table))
    if (const auto scene = read_without_sizes(table, folder)) file.chosen = fill_sizes(table, *scene);
  Echo echo;
  ReadContext context{.problems = problems, .echo = echo, .folder = folder};
  const auto labels = read_all(context, table, file.scene);
  check_scene(file.scene, labels, problems);
  problems.throw_if_any();
  give_least_mass(file.scene);
  for (const auto* kind : effect_kinds())
    if (kind->present(file.scene)) kind->complete(file.scene);
  file.resolved = echo.text();
  file.notes = std::move(context.notes);
  file.places = problems;
  return file;
}

}  // namespace

void sketch_scene(Sketch& sketch, int dimension) {
  sketch.explore([&] {
    Problems nobody_told("");
    Echo unused;
    ReadContext context{.problems = nobody_told, .echo = unused, .dimension = dimension, .sketch = &sketch};
    Scene scene;
    scene.dimension = dimension;
    read_all(context, {}, scene);
  });
}

SceneFile read_scene_text(const std::string& text, const std::string& name, std::span<const std::string> overrides) {
  Problems problems(name);
  auto table = read_toml(text, name);
  if (table["axis"].is_array_of_tables() || table["scene"].is_string())
    throw SceneError({fmt::format("{0}: is a study, not a scene. Use splashdown study {0}.", name)});
  for (const auto& argument : overrides) apply_override(table, argument, problems);
  return read_root(table, std::filesystem::path(name).parent_path(), problems);
}

SceneFile read_scene(const std::filesystem::path& path, std::span<const std::string> overrides) {
  const auto kind = path.extension().string();
  if (kind == ".stl" || kind == ".STL" || kind == ".obj" || kind == ".OBJ")
    throw SceneError({fmt::format(
        "{}: is a hull, not a scene. Name a scene in which a body has shape = {{type = \"surface\", file = "
        "\"{}\"}}.",
        path.string(), path.filename().string())});
  const auto text = read_text(path, "a scene file, e.g. examples/wedge_drop/scene.toml");
  return read_scene_text(text, path.string(), overrides);
}

}  // namespace splashdown::apps
