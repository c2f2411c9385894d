// Ways to step the water: each makes the step of a fluid over its water.
#pragma once

#include <functional>
#include <memory>

namespace splashdown::fluid {

template <int d>
struct Water;
template <int d>
class WaterStep;

/// Makes the step; the water must outlive it.
template <int d>
using Formulation = std::function<std::unique_ptr<WaterStep<d>>(Water<d>& water)>;

/// Pressure and a fixed number of corrections on one factor (step/fractional).
template <int d>
Formulation<d> fractional();

/// Of the monolithic formulation.
struct MonolithicSpec {
  double tolerance = 1e-6;  ///< of what the pressure does to velocities: what its solve may leave
  double speed = 0;  ///< U of tau = h / 2 U [m/s]; 0: of the interval in which the pressure acts, and of viscosity
  bool implicit_euler = false;  ///< no volume is created at the end of a step, not in its middle; of first order
};

/// Velocity and pressure as one stabilised system, solved to a tolerance (step/monolithic).
template <int d>
Formulation<d> monolithic(const MonolithicSpec& spec = {});

}  // namespace splashdown::fluid
