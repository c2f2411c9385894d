#include "fluid/pfem/formulations.hpp"

#include "fluid/pfem/step/fractional/fractional.hpp"

namespace splashdown::fluid {

template <int d>
Formulation<d> fractional() {
  return [](Water<d>& water) -> std::unique_ptr<Step<d>> { return std::make_unique<Fractional<d>>(water); };
}

template Formulation<2> fractional<2>();
template Formulation<3> fractional<3>();

}  // namespace splashdown::fluid
