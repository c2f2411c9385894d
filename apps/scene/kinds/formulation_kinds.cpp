#include "apps/scene/kinds/formulation_kinds.hpp"

namespace splashdown::apps {
namespace {

void read_monolithic(Reader& table, Fluid& fluid) {
  Monolithic& monolithic = fluid.monolithic;
  table.choice("stabilisation", monolithic.stabilisation, {"transient", "convective"});
  if (monolithic.stabilisation == "convective")
    table.number("speed", monolithic.speed, positive("m/s", "Use the speed of the impact, e.g. 100."), Need::required);
  else
    table.skip("speed");
  table.choice("scheme", monolithic.scheme, {"midpoint", "implicit_euler"});
  table.number("tolerance", monolithic.tolerance, within(1e-12, 1e-2, "", "Use 1e-6."));
}

}  // namespace

std::span<const FormulationKind> formulation_kinds() {
  static const FormulationKind kinds[] = {
      {"fractional", "pressure, then corrections of what it leaves"},
      {"monolithic", "velocity and pressure in one stabilised system, solved to a tolerance", read_monolithic},
      {"vortex", "vortices on a grid around penalised bodies, without a free surface", nullptr, FluidMedium::grid},
      {"ale", "quadratic elements on a mesh that moves with bodies, without a free surface", nullptr,
       FluidMedium::mesh}};
  return kinds;
}

}  // namespace splashdown::apps
