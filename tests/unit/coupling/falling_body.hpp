// A rigid body that weighs, coupled with a fluid of any kind as scenes couple them.
#pragma once

#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "coupling/accelerators/quasi_newton.hpp"
#include "coupling/schemes/steppers.hpp"
#include "rigid/forces/gravity.hpp"
#include "rigid/participant.hpp"

namespace splashdown::coupling {

/// Both parts and their stepper; `Flow`: what `Part` makes a part of a coupling.
template <class Flow>
struct FallingBody {
  const Flow* fluid;
  const rigid::Bodies<2>* bodies;
  std::unique_ptr<Coupled> stepper;

  /// The accepted attempt of a step; throws the cause.
  StepReport step(double dt) {
    const auto report = stepper->attempt(dt);
    if (!report.ok()) throw std::runtime_error(report.cause);
    stepper->commit();
    return report;
  }
};

/// With the exact term, or without a term by an accelerator.
template <class Part, class Flow>
FallingBody<Flow> falling_body(std::unique_ptr<Flow> flow, const BodySpec<2>& body, double gravity,
                               std::unique_ptr<Accelerator> accelerator, CouplingLimits limits) {
  FallingBody<Flow> made;
  auto fluid = std::make_unique<Part>(std::move(flow));
  std::vector<std::unique_ptr<rigid::Force<2>>> forces;
  forces.push_back(std::make_unique<rigid::Gravity<2>>(Vec<2>(0, -gravity)));
  auto bodies =
      std::make_unique<rigid::Participant<2>>(std::make_unique<rigid::Bodies<2>>(std::vector{body}, std::move(forces)));
  made.fluid = &fluid->fluid();
  made.bodies = &bodies->bodies();
  if (accelerator)
    made.stepper = std::make_unique<Partitioned>(std::move(fluid), std::move(bodies), std::make_unique<NoTerm>(),
                                                 std::move(accelerator), limits);
  else
    made.stepper = std::make_unique<Simultaneous>(std::move(fluid), std::move(bodies));
  return made;
}

}  // namespace splashdown::coupling
