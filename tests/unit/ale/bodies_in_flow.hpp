// A body in a flow on a moving mesh, coupled as scenes couple it.
#pragma once

#include <memory>
#include <optional>

#include "coupling/accelerators/quasi_newton.hpp"
#include "coupling/schemes/steppers.hpp"
#include "flows.hpp"
#include "fluid/ale/participant.hpp"
#include "rigid/forces/gravity.hpp"
#include "rigid/participant.hpp"

namespace splashdown::ale::scenes {

inline constexpr double g = 1;

/// At rest in still fluid that weighs, between sides that are open above.
struct FreeBody {
  Surface<2> outline = circle(0.5);
  double area = std::numbers::pi / 4, polar = std::numbers::pi / 32;  // of the outline, about its origin
  double density = 1;                                                 // over the fluid's
  double angle = 0;
  double half = 2;  // of the box [m]
  double far = 0.5, size = 0.15, growth = 0.15;
  double viscosity = 0.01;

  AleFlowSpec fluid() const {
    AleFlowSpec spec{.density = 1, .viscosity = viscosity, .min = {-half, -half}, .max = {half, half}};
    spec.sides = {BoundaryKind::slip, BoundaryKind::slip, BoundaryKind::slip, BoundaryKind::outflow};
    spec.far = far;
    spec.growth = growth;
    spec.gravity = {0, -g};
    spec.walls = {{.name = "body", .surface = outline, .pose = at(0, 0, angle), .size = size}};
    return spec;
  }
  BodySpec<2> body() const {
    BodySpec<2> spec;
    spec.name = "body";
    spec.surface = outline;
    spec.mass = density * area;
    spec.inertia(0, 0) = density * polar;
    spec.free.fill(true);
    spec.pose = at(0, 0, angle);
    return spec;
  }
};

/// Both parts and their stepper.
struct Coupled {
  const AleFlow* fluid;
  const rigid::Bodies<2>* bodies;
  std::unique_ptr<coupling::Coupled> stepper;

  /// The accepted attempt of a step; throws the cause.
  coupling::StepReport step(double dt) {
    const auto report = stepper->attempt(dt);
    if (!report.ok()) throw std::runtime_error(report.cause);
    stepper->commit();
    return report;
  }
};

inline Coupled coupled(const FreeBody& scene, std::unique_ptr<coupling::Accelerator> accelerator = nullptr,
                       coupling::CouplingLimits limits = {}) {
  Coupled made;
  auto fluid = std::make_unique<Participant>(std::make_unique<AleFlow>(scene.fluid()));
  std::vector<std::unique_ptr<rigid::Force<2>>> forces;
  forces.push_back(std::make_unique<rigid::Gravity<2>>(Vec<2>(0, -g)));
  auto bodies = std::make_unique<rigid::Participant<2>>(
      std::make_unique<rigid::Bodies<2>>(std::vector{scene.body()}, std::move(forces)));
  made.fluid = &fluid->fluid();
  made.bodies = &bodies->bodies();
  if (accelerator)
    made.stepper = std::make_unique<coupling::Partitioned>(
        std::move(fluid), std::move(bodies), std::make_unique<coupling::NoTerm>(), std::move(accelerator), limits);
  else
    made.stepper = std::make_unique<coupling::Simultaneous>(std::move(fluid), std::move(bodies));
  return made;
}

}  // namespace splashdown::ale::scenes
