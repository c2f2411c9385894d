#include "apps/check/command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "apps/build/build.hpp"
#include "apps/check/body.hpp"
#include "apps/check/cost.hpp"
#include "apps/check/questions.hpp"
#include "apps/check/start.hpp"
#include "apps/check/ties.hpp"
#include "apps/check/words.hpp"
#include "apps/effects/theory/theory.hpp"
#include "apps/process/exit.hpp"
#include "apps/scene/choose/sizes.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/kinds/coupling_kinds.hpp"
#include "apps/scene/kinds/formulation_kinds.hpp"
#include "apps/scene/kinds/joint_kinds.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/scene/scales.hpp"
#include "apps/text/number_text.hpp"
#include "apps/text/plain_text.hpp"

namespace splashdown::apps {

void row(const std::string& head, const std::string& text) { fmt::print("  {:<22}{}\n", head, text); }

std::string rough(double value) {
  if (!(value >= 10 && value < 1e7)) return fmt::format("{:.2g}", value);
  const double step = std::pow(10., std::floor(std::log10(value)) - 1);
  return fmt::format("{:.0f}", std::round(value / step) * step);
}

namespace {

/// What limits a joint and draws it back.
std::string play_text(const Joint& joint, int dimension) {
  const bool hinge = kind_of(joint).turns;
  const std::string way = hinge ? "deg" : "m", force = hinge ? "N m" : "N",
                    depth = dimension == 2 ? " per m of depth" : "";
  std::string text;
  if (!joint.limits.empty()) text += fmt::format(", from {:g} to {:g} {}", joint.limits[0], joint.limits[1], way);
  if (joint.stiffness > 0)
    text += fmt::format(", spring {:g} {}/{}{}, relaxed at {:g} {}", joint.stiffness, force, hinge ? "rad" : "m", depth,
                        joint.rest, way);
  if (joint.damping > 0)
    text += fmt::format(", damper {:g} {} s{}{}", joint.damping, force, hinge ? "/rad" : "/m", depth);
  return text;
}

std::string share_text(const std::string& what, double share) {
  return share > 0 ? fmt::format("{} {:g}", what, share) : "no " + what;
}

template <int d>
void print_ties(const Scene& scene) {
  for (const auto& joint : scene.joints) {
    const std::string other = joint.other ? scene.bodies[*joint.other].name : "the world";
    const std::string where = kind_of(joint).turns    ? fmt::format(" at {} m", text<d>(vec<d>(joint.point)))
                              : kind_of(joint).slides ? fmt::format(" along {}", text<d>(vec<d>(joint.axis)))
                                                      : "";
    row(joint.type, fmt::format("{} to {}{}{}", scene.bodies[joint.body].name, other, where, play_text(joint, d)));
  }
  if (scene.contact)
    row("contact", fmt::format("bodies touch each other{}; {}, {}", scene.tank ? " and the tank" : "",
                               share_text("rebound", scene.contact->restitution),
                               share_text("friction", scene.contact->friction)));
}

void print_grid(const Scene& scene, const Scales& s) {
  const auto& fluid = *scene.vortex;
  const auto grid = vortex_spec(scene).grid;
  fmt::print("fluid on a grid\n");
  row("density", fmt::format("{:g} kg/m^3", fluid.density));
  row("grid", fmt::format("{} x {} squares of {:g} m, {} m; {} sides", grid.nx, grid.ny, grid.h,
                          text<2>(Extents<2>(grid.min, grid.max())), fluid.sides));
  row("resolution", fmt::format("L = {:.3g} squares", s.length / grid.h));
  const double reynolds = fluid.viscosity > 0 ? fluid.density * s.speed * s.length / fluid.viscosity : 0;
  if (reynolds > 0)
    row("viscosity", fmt::format("Re = rho U L/mu = {:.4g}; boundary layer about {:.2g} squares", reynolds,
                                 s.length / std::sqrt(reynolds) / grid.h));
  else
    row("viscosity", "none: nothing spreads vorticity but the grid");
  row("bodies",
      fmt::format(
          "{}, outline {}", fluid.rate ? fmt::format("penalty of {:g} 1/s", *fluid.rate) : "projection",
          fluid.smoothing > 0 ? fmt::format("smoothed over {:g} squares either way", fluid.smoothing) : "sharp"));
  if (scene.tank) row("tank", text<2>(extents<2>(*scene.tank)) + " m, its walls at rest like bodies");
}

void print_between_sides(const Scene& scene, const Scales& s) {
  const auto& fluid = *scene.ale;
  fmt::print("fluid between sides\n");
  row("density", fmt::format("{:g} kg/m^3", fluid.density));
  row("box", text<2>(Extents<2>(vec<2>(fluid.min), vec<2>(fluid.max))) + " m");
  row("sides", fmt::format("left {}, right {}, bottom {}, top {}", fluid.sides.left, fluid.sides.right,
                           fluid.sides.bottom, fluid.sides.top));
  row("inflow", fmt::format("{} m/s in the mean, {}{}", text<2>(vec<2>(fluid.velocity)), fluid.profile,
                            fluid.ramp > 0 ? fmt::format(", risen after {:g} s", fluid.ramp) : ""));
  row("viscosity", fmt::format("Re = rho U L/mu = {:.4g}; boundary layer about {:.2g} m",
                               fluid.density * s.speed * s.length / fluid.viscosity,
                               std::sqrt(s.length * fluid.viscosity / (fluid.density * s.speed))));
  row("element sizes", fmt::format("{:g} m at most, {:g} m at bodies, growing {:g} per metre; quadratic", fluid.far,
                                   fluid.hull, fluid.growth));
  row("scheme", fluid.scheme);
}

template <int d>
void print_liquid(const Scene& scene) {
  if (scene.vortex) print_grid(scene, scales<d>(scene));
  if (scene.ale) print_between_sides(scene, scales<d>(scene));
  if (!scene.fluid) return;
  const auto& fluid = *scene.fluid;
  fmt::print("liquid\n");
  row("density", fmt::format("{:g} kg/m^3", fluid.density));
  row("formulation", fmt::format("{}: {}", fluid.formulation, named(formulation_kinds(), fluid.formulation).about));
  row("regions", fmt::format("{}", fluid.regions.size()));
  if (scene.gravity) row("still water level", fmt::format("{:.6g} m", *still_water_level<d>(scene)));
  row("element sizes", fmt::format("{:g} m at the surface, {:g} m at most, growing {:g} per metre", fluid.size.surface,
                                   fluid.size.far, fluid.size.growth));
  if (scene.tank) row("tank", text<d>(extents<d>(*scene.tank)) + " m");
}

/// Of an effect that cannot be switched on: its first number, and whether it is missed.
std::string missing_text(const Advice& advice) {
  if (advice.numbers.empty()) return advice.reason;
  const auto& first = advice.numbers.front();
  return fmt::format("{} = {:.3g}{}: {}", first.name, first.value, first.unit == "-" ? "" : " " + first.unit,
                     advice.reason);
}

template <int d>
void print_effects(const Scene& scene) {
  fmt::print("effects\n");
  for (const auto& note : effect_notes<d>(scene)) row((note.active ? "on   " : "off  ") + note.name, note.reason);
  const auto look = outlook<d>(scene);
  if (scene.fluid && look.scales.speed > 0)
    for (const auto* missing : theory_of_what_is_missing()) {
      const auto advice = missing->advise(look);
      row("-    " + std::string(missing->name), missing_text(advice));
    }
  if (!scene.coupling) return;
  const auto& c = *scene.coupling;
  std::string accelerator = fmt::format("accelerator {} from relaxation {:g}", c.accelerator, c.relaxation);
  if (const auto details = named(accelerator_kinds(), c.accelerator).details) accelerator += ", " + details(c);
  row("coupling", fmt::format("{}, interface term {}, {}, tolerance {:g}, at most {} passes", c.scheme,
                              c.interface_term, accelerator, c.tolerance, c.max_passes));
}

template <int d>
void print_cost(const Scene& scene, const Cost& cost) {
  fmt::print("cost (predicted)\n");
  row("steps", fmt::format("about {} to t = {:g} s; dt about {}, at most {}", rough(cost.steps), scene.time.end,
                           with_unit(cost.dt, "s"), with_unit(scene.time.dt_max, "s")));
  if (!scene.has_fluid()) return;
  const std::string about = cost.at_least ? "> " : "about ";
  const bool grows = cost.nodes_most > 1.1 * cost.nodes;  // what two digits show
  row("nodes",
      about + rough(cost.nodes) + " at the start" + (grows ? ", " + rough(cost.nodes_most) + " later on" : ""));
  row("memory", about + with_unit(cost.bytes, "B"));
  row("the start", about + with_unit(cost.seconds_to_start, "s") + " on one core");
  row("a step", about + with_unit(cost.seconds_per_step, "s") + " on one core");
  row("the run", about + clock_text(cost.seconds_to_start + cost.steps * cost.seconds_per_step) + " on one core");
  if (cost.without_hollows)
    row("not counted", "finer elements at hollows (hollow): more nodes, shorter steps and a longer run than said");
}

/// Everything a good scene says. Throws std::invalid_argument for what `run` would refuse at its start, SceneError for what shows
/// only when the scene's parts meet, and says whether it asks for --large.
template <int d>
bool print_scene(const SceneFile& file) {
  const auto& scene = file.scene;
  refuse_contradicting_ties<d>(file);
  const auto s = scales<d>(scene);
  row("units", d == 2 ? "SI; two-dimensional masses, loads and volumes are per metre of depth" : "SI");
  row("scales", fmt::format("L = {:.4g} m, U = {:.4g} m/s, L/U = {}", s.length, s.speed,
                            s.speed > 0 ? with_unit(s.length / s.speed, "s") : "-"));
  print_liquid<d>(scene);
  const auto resting = at_rest<d>(scene);
  for (std::size_t i = 0; i < resting.size(); ++i) print_body<d>(scene, i, resting[i]);
  print_ties<d>(scene);
  for (const auto& note : ties_notes<d>(scene)) row("note", note);
  print_effects<d>(scene);
  const auto cost = predicted_cost<d>(scene);
  print_cost<d>(scene, cost);
  auto asked = questions<d>(scene, cost);
  const auto why = too_large(cost);
  if (why)
    asked.push_back(*why + ": did you mean larger element sizes, or lengths in another unit? run asks for --large");
  if (scene.fluid)
    for (const auto& rule : sizes_against_rules<d>(scene)) row("coarser than advised", rule);
  if (!asked.empty()) fmt::print("questions\n");
  for (const auto& question : asked) fmt::print("  {}\n", question);
  if (!why) check_start<d>(scene, cost, Doubt::mesh);
  return why.has_value();
}

}  // namespace

int check_command(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  SceneFile file;
  try {
    file = read_scene(path, overrides);
  } catch (const SceneError& error) {
    return bad_input(error.what());
  }
  const auto& scene = file.scene;
  fmt::print("{}: {}\n", path.string(), scene.title.empty() ? "(no title)" : one_line(scene.title));
  for (const auto& note : file.notes) fmt::print("  note: {}\n", one_line(note));
  for (const auto& line : file.chosen) row("chosen", line);
  try {
    const bool large = scene.dimension == 2 ? print_scene<2>(file) : print_scene<3>(file);
    fmt::print("The scene is good. Run it with: splashdown run {}{}\n", path.string(), large ? " --large" : "");
  } catch (const SceneError& error) {
    return bad_input(error.what());
  } catch (const std::exception& error) {
    return bad_input(fmt::format("{}: {}", path.string(), error.what()));
  }
  return exit_code::done;
}

}  // namespace splashdown::apps
