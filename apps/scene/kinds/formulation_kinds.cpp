#include "apps/scene/kinds/formulation_kinds.hpp"

namespace splashdown::apps {

std::span<const FormulationKind> formulation_kinds() {
  static const FormulationKind kinds[] = {
      {"fractional", "pressure, then corrections of what it leaves"},
      {"monolithic", "velocity and pressure in one stabilised system, solved to a tolerance"},
      {"vortex", "vortices on a grid around penalised bodies, without a free surface", true}};
  return kinds;
}

}  // namespace splashdown::apps
