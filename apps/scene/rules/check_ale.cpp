// Rules of a fluid between sides on a mesh that moves: its box, what its sides let through, and bodies that lie inside it.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "apps/scene/geometry.hpp"
#include "apps/scene/kinds/effect_kind.hpp"
#include "apps/scene/rules/check.hpp"

namespace splashdown::apps {
namespace {

constexpr const char* side_names[] = {"left", "right", "bottom", "top"};
constexpr double most_nodes = 2e6;  // a factor of 20 GB

bool has_side(const AleFluid& fluid, std::string_view kind) {
  return std::ranges::any_of(fluid.sides.all(), [&](const std::string& side) { return side == kind; });
}

void check_box(const AleFluid& fluid, Problems& problems) {
  const Point size = fluid.max - fluid.min;
  if (size.head<2>().minCoeff() <= 0)
    return problems.add("fluid.domain.max", "must lie above fluid.domain.min on every axis",
                        "Swap them, or mend the signs.");
  if (problems.found_in("fluid.size")) return;
  if (fluid.far > 0.5 * size.head<2>().minCoeff())
    problems.add(
        "fluid.size.far",
        fmt::format("must not exceed half of the box's smallest side, {:g} m", 0.5 * size.head<2>().minCoeff()),
        "Use e.g. a tenth of that side.");
  else if (4.6 * size.x() * size.y() / (fluid.far * fluid.far) > most_nodes)
    problems.add("fluid.size.far",
                 fmt::format("makes more than {:g} nodes, whose factor this machine cannot hold", most_nodes),
                 "Use larger elements or a smaller box.");
  if (fluid.hull > fluid.far)
    problems.add("fluid.size.hull", fmt::format("must not exceed fluid.size.far = {:g} m", fluid.far),
                 "It is the size at bodies, the smallest.");
}

void check_sides(const AleFluid& fluid, Problems& problems) {
  const auto sides = fluid.sides.all();
  if (!has_side(fluid, "inflow")) {
    if (problems.noted("fluid.inflow.velocity"))
      problems.add("fluid.inflow.velocity", "no side is an inflow", "Use fluid.sides.left = \"inflow\".");
    return;
  }
  if (!has_side(fluid, "outflow"))
    problems.add("fluid.sides", "an incompressible fluid that comes in has to leave",
                 "Make a side an outflow, e.g. right = \"outflow\".");
  const Point inwards[] = {Point::UnitX(), -Point::UnitX(), Point::UnitY(), -Point::UnitY()};
  for (int k = 0; k < 4; ++k)
    if (sides[static_cast<std::size_t>(k)] == "inflow" && fluid.velocity.dot(inwards[k]) <= 0)
      problems.add("fluid.inflow.velocity", fmt::format("does not come in through the {} side", side_names[k]),
                   "Turn it, or make that side an outflow.");
}

void check_goals(const Scene& scene, Problems& problems) {
  const auto& fluid = *scene.ale;
  if (fluid.adapt > 0 && fluid.goals.empty())
    problems.add("fluid.ale.adapt", "there is no goal to refine the mesh for",
                 "Add [[fluid.ale.goal]] with body = \"NAME\".");
  for (std::size_t k = 0; k < fluid.goals.size(); ++k) {
    const auto key = fmt::format("fluid.ale.goal[{}]", k);
    if (fluid.scheme != "steady")
      problems.add(key, "the adjoint is that of a steady flow",
                   "Use fluid.ale.scheme = \"steady\", or remove the table.");
    if (std::ranges::find(scene.bodies, fluid.goals[k].body, &Body::name) == scene.bodies.end())
      problems.add(key + ".body", fmt::format("there is no body '{}'", fluid.goals[k].body), "Use the name of a body.");
  }
}

void check_body(const AleFluid& fluid, const Body& body, const std::string& label, Problems& problems) {
  rigid::Surface<2> hull;
  try {
    hull = outline<2>(body);
  } catch (const std::invalid_argument&) {  // the body's own check has reported it
    return;
  }
  const auto box = extents<2>(hull);
  if (body.size > 0.5 * box.sizes().maxCoeff())
    problems.add(problems.noted(label + ".size") ? label + ".size" : "fluid.size.hull",
                 fmt::format("must not exceed half of the length of {}, {:g} m", label, box.sizes().maxCoeff()),
                 "Use e.g. a twentieth of its breadth.");
  const Extents<2> inner(vec<2>(fluid.min).array() + body.size, vec<2>(fluid.max).array() - body.size);
  if (!inner.contains(box))
    problems.add(label + ".position",
                 fmt::format("the body spans {} m and does not lie an element or more inside fluid.domain {} m",
                             text<2>(box), text<2>(Extents<2>(vec<2>(fluid.min), vec<2>(fluid.max)))),
                 "Move the body or enlarge the box.");
}

}  // namespace

void check_ale(const Scene& scene, const SceneLabels& labels, Problems& problems) {
  const auto& fluid = *scene.ale;
  for (const auto* kind : effect_kinds())
    if (kind->present(scene) && (!kind->knows_no_mesh() || kind->name() == "wind"))
      problems.add(std::string(kind->name()), "a fluid with formulation = \"ale\" does not carry this effect",
                   "Remove the table, or change the formulation.");
  if (scene.tank)
    problems.add("tank", "the box of this fluid has sides of its own", "Remove the table; use fluid.domain and sides.");
  if (scene.coupling && scene.coupling->interface_term != "rigid" && scene.coupling->interface_term != "none")
    problems.add("coupling.interface_term", "must be \"rigid\" or \"none\" with fluid.formulation = \"ale\"",
                 "Use \"rigid\": stable for light bodies.");
  for (std::size_t i = 0; i < scene.records.size(); ++i)
    if (std::holds_alternative<ElevationEntry>(scene.records[i]))
      problems.add(labels.records[i] + ".kind", "there is no free surface with fluid.formulation = \"ale\"",
                   "Remove the record.");
  if (fluid.scheme == "steady" &&
      std::ranges::any_of(scene.bodies, [](const Body& body) { return body.motion != Motion::fixed; }))
    problems.add("fluid.ale.scheme", "a flow around bodies that move is not steady", "Use \"midpoint\".");
  if (problems.found_in("fluid")) return;
  check_box(fluid, problems);
  check_sides(fluid, problems);
  check_goals(scene, problems);
  if (problems.found_in("fluid")) return;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (!problems.found_in(labels.bodies[i])) check_body(fluid, scene.bodies[i], labels.bodies[i], problems);
}

}  // namespace splashdown::apps
