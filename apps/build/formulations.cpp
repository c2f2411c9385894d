#include "apps/build/formulations.hpp"

#include "apps/scene/kinds/named.hpp"

namespace splashdown::apps {
namespace {

template <int d>
struct FormulationMaker {
  std::string_view name;  // FormulationKind::name
  fluid::Formulation<d> (*make)(const Fluid& fluid);
};

template <int d>
fluid::Formulation<d> fractional_step(const Fluid&) {
  return fluid::fractional<d>();
}

template <int d>
fluid::Formulation<d> monolithic_step(const Fluid& fluid) {
  const auto& monolithic = fluid.monolithic;
  return fluid::monolithic<d>({.tolerance = monolithic.tolerance,
                               .speed = monolithic.speed,
                               .implicit_euler = monolithic.scheme == "implicit_euler"});
}

}  // namespace

template <int d>
fluid::Formulation<d> formulation(const Fluid& fluid) {
  static constexpr FormulationMaker<d> makers[] = {{"fractional", fractional_step<d>},
                                                   {"monolithic", monolithic_step<d>}};
  return named(makers, fluid.formulation).make(fluid);
}

template fluid::Formulation<2> formulation<2>(const Fluid&);
template fluid::Formulation<3> formulation<3>(const Fluid&);

}  // namespace splashdown::apps
