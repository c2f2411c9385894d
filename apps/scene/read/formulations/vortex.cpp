#include <fmt/format.h>

#include <algorithm>

#include "apps/scene/choose/presets.hpp"
#include "apps/scene/read/parts.hpp"

namespace splashdown::apps {

void read_vortex(Reader& reader, VortexFluid& fluid) {
  reader.number("density", fluid.density, positive("kg/m^3", "Use e.g. 1000 for water, 1.2 for air."), Need::required);
  Reader viscosity = reader.table_or_defaults("viscosity");
  viscosity.number("dynamic", fluid.viscosity,
                   not_negative("Pa s", "Use e.g. 1e-3 for water, or rho U L/Re for a Reynolds number."));
  // No choice for the schema, whose rules for a word without its key would hold for [fluid.viscosity] of all formulations.
  viscosity.reference("stencil", fluid.stencil, {"five_point", "fourth_order"});
  Reader stream = reader.table_or_defaults("stream");
  stream.curve("velocity", fluid.stream, 3,
               any("m/s", "Use e.g. [1.0, 0.0], or rows [time, x, y] with ascending times."));
  Reader particles = reader.table_or_defaults("particles");
  particles.choice("kernel", fluid.kernel, {"m4", "m6"});
  particles.choice("paths", fluid.paths, {"rk2", "rk4"});
}

void finish_vortex(Reader& reader, Scene& scene) {
  auto& fluid = *scene.vortex;
  Reader size = reader.table_or_defaults("size");
  fluid.refine = size.divisor("refine", within(0.01, 100, "", "Use e.g. 2 for squares of half the size."), presets);
  if (auto grid = reader.table("grid", Need::required)) {
    grid->number("size", fluid.size, refined(positive("m", "Use e.g. a fortieth of the body's breadth."), fluid.refine),
                 Need::required);
    const Rule place = place_rule(2);
    const Need need = scene.tank ? Need::optional : Need::required;
    if (scene.tank) {  // its walls are kept at rest like bodies, six squares deep
      fluid.min = scene.tank->min - 6 * fluid.size * Point(1, 1, 0);
      fluid.max = scene.tank->max + 6 * fluid.size * Point(1, 1, 0);
      fluid.sides = "slip";
    }
    grid->point("min", fluid.min, place, need);
    grid->point("max", fluid.max, place, need);
    grid->choice("sides", fluid.sides, {"free", "slip"});
  }
  for (auto& body : scene.bodies) body.size = fluid.size;
  const bool moves = std::ranges::any_of(scene.bodies, [](const Body& body) { return body.motion != Motion::fixed; });
  fluid.smoothing = moves ? 0.5 : 0.0;
  Reader penalisation = reader.table_or_defaults("penalisation");
  penalisation.number("smoothing", fluid.smoothing,
                      within(0, 4, "squares", "Use 0 for fixed bodies, 0.5 for bodies that move."));
  penalisation.number("rate", fluid.rate, positive("1/s", "Leave it out for its limit, or use 1e3/dt or more."));
  penalisation.integer("passes", fluid.passes, within(0, 100, "", "Use 0 to have them chosen, or e.g. 4."));
}

}  // namespace splashdown::apps
