#include "fluid/pfem/formulations.hpp"

#include "fluid/pfem/step/fractional/fractional.hpp"
#include "fluid/pfem/step/monolithic/monolithic.hpp"

namespace splashdown::fluid {

template <int d>
Formulation<d> fractional() {
  return [](Water<d>& water) -> std::unique_ptr<WaterStep<d>> { return std::make_unique<Fractional<d>>(water); };
}

template <int d>
Formulation<d> monolithic(const MonolithicSpec& spec) {
  return
      [spec](Water<d>& water) -> std::unique_ptr<WaterStep<d>> { return std::make_unique<Monolithic<d>>(water, spec); };
}

template Formulation<2> fractional<2>();
template Formulation<3> fractional<3>();
template Formulation<2> monolithic<2>(const MonolithicSpec&);
template Formulation<3> monolithic<3>(const MonolithicSpec&);

}  // namespace splashdown::fluid
