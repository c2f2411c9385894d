// A body in a flow on a moving mesh, coupled as scenes couple it.
#pragma once

#include <memory>
#include <optional>

#include "flows.hpp"
#include "fluid/ale/participant.hpp"
#include "tests/unit/coupling/falling_body.hpp"

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

using Coupled = coupling::FallingBody<AleFlow>;

inline Coupled coupled(const FreeBody& scene, std::unique_ptr<coupling::Accelerator> accelerator = nullptr,
                       coupling::CouplingLimits limits = {}) {
  return coupling::falling_body<Participant>(std::make_unique<AleFlow>(scene.fluid()), scene.body(), g,
                                             std::move(accelerator), limits);
}

}  // namespace splashdown::ale::scenes
