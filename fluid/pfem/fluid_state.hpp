// What a fluid is made of. For fluid.cpp, fluid_view.cpp and resting.cpp alone.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "fluid/pfem/fluid.hpp"
#include "fluid/pfem/step/step.hpp"
#include "fluid/pfem/water/water.hpp"

namespace splashdown::fluid {

/// The state behind Fluid: its water, what steps it, and what the last solve has found.
template <int d>
struct Fluid<d>::State {
  /// Meshes the water; `step` is still to be made.
  State(FluidSpec<d> spec, std::vector<std::unique_ptr<Effect<d>>> effects)
      : water(std::move(spec), std::move(effects)) {}

  Water<d> water;
  std::unique_ptr<WaterStep<d>> step;
  StepResult<d> result = {};            ///< of the last solve
  bool solved = false;                  ///< it is of the begun step
  std::vector<Isometry<d>> poses = {};  ///< of its walls, for those who look
};

}  // namespace splashdown::fluid
