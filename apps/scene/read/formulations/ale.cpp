#include <algorithm>

#include "apps/scene/choose/presets.hpp"
#include "apps/scene/read/parts.hpp"

namespace splashdown::apps {
namespace {

void read_sides(Reader& reader, AleFluid::Sides& sides) {
  const Reader::Names kinds = {"inflow", "outflow", "no_slip", "slip"};
  reader.choice("left", sides.left, kinds);
  reader.choice("right", sides.right, kinds);
  reader.choice("bottom", sides.bottom, kinds);
  reader.choice("top", sides.top, kinds);
}

void read_inflow(Reader& reader, AleFluid& fluid) {
  reader.point("velocity", fluid.velocity, any("m/s", "Use the mean over the side, e.g. [1.0, 0.0]."));
  reader.choice("profile", fluid.profile, {"uniform", "parabolic"});
  reader.number("ramp", fluid.ramp, not_negative("s", "Use e.g. the time in which the fluid crosses the body."));
}

void read_sizes(Reader& reader, AleFluid& fluid) {
  fluid.refine = reader.divisor("refine", within(0.01, 100, "", "Use e.g. 2 for elements of half the size."), presets);
  const auto length = [&](const char* cure) { return refined(positive("m", cure), fluid.refine); };
  reader.number("far", fluid.far, length("Use e.g. a tenth of the box's height: the largest element."), Need::required);
  fluid.hull = fluid.far / 4;
  reader.number("hull", fluid.hull, length("Use e.g. a twentieth of the body's breadth."));
  reader.number("corner", fluid.corner,
                share("Use 0.05: flow around an edge is singular; h there over the hull's. 1: as on the hull."));
  reader.number("growth", fluid.growth, share("Use 0.15: the element size's growth per unit distance."));
}

void read_method(Reader& reader, AleFluid& fluid) {
  reader.choice("scheme", fluid.scheme, {"midpoint", "shifted", "implicit_euler", "steady"});
  if (fluid.scheme == "shifted")
    reader.number("shift", fluid.shift, within(0, 0.5, "", "Use e.g. 0.01: theta = 1/2 + shift."));
  else
    reader.skip("shift");
  reader.number("tolerance", fluid.tolerance, within(1e-13, 1e-3, "", "Use 1e-8."));
  reader.integer("max_iterations", fluid.max_iterations, within(1, 1000, "", "Use 30."));
  reader.choice("extension", fluid.extension, {"laplace", "biharmonic"});
  reader.choice("remesh", fluid.remesh, {"automatic", "never"});
  reader.each_table("goal", [&](Reader& table) {
    auto& goal = fluid.goals.emplace_back();
    table.text("body", goal.body, "Use the name of a body, e.g. \"cylinder\".", Need::required);
    table.choice("direction", goal.direction, {"x", "y"});
  });
  reader.integer("adapt", fluid.adapt, within(0, 20, "", "Use e.g. 5: the mesh is refined so often for the goals."));
}

}  // namespace

void read_ale(Reader& reader, AleFluid& fluid) {
  reader.number("density", fluid.density, positive("kg/m^3", "Use e.g. 1000 for water, 1.2 for air."), Need::required);
  if (auto viscosity = reader.table("viscosity", Need::required))
    viscosity->number("dynamic", fluid.viscosity,
                      positive("Pa s", "Use e.g. 1 for a laminar channel, or rho U L/Re for a Reynolds number."),
                      Need::required);
  if (auto domain = reader.table("domain", Need::required)) {
    domain->point("min", fluid.min, place_rule(2), Need::required);
    domain->point("max", fluid.max, place_rule(2), Need::required);
  }
  Reader sides = reader.table_or_defaults("sides");
  read_sides(sides, fluid.sides);
  const auto kinds = fluid.sides.all();
  if (std::ranges::find(kinds, "inflow") != kinds.end()) {
    Reader inflow = reader.table_or_defaults("inflow");
    read_inflow(inflow, fluid);
  } else if (auto inflow = reader.table("inflow")) {
    read_inflow(*inflow, fluid);
  }
  Reader size = reader.table_or_defaults("size");
  read_sizes(size, fluid);
  Reader method = reader.table_or_defaults("ale");
  read_method(method, fluid);
}

}  // namespace splashdown::apps
