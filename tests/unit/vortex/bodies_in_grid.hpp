// A free body in a fluid on a grid, coupled as scenes couple it.
#pragma once

#include <memory>
#include <optional>

#include "fluid/vortex/participant.hpp"
#include "shapes.hpp"
#include "tests/unit/coupling/falling_body.hpp"

namespace splashdown::vortex::scenes {

inline constexpr double g = 1;

/// A body of a mean density over the fluid's, at rest in still fluid that weighs; its frame's origin is its centroid.
struct FreeBody {
  Surface<2> outline = circle(0.5);
  double density = 1;  // over the fluid's
  double angle = 0;
  double h = 1. / 24;
  double smoothing = 0.5;
  double half = 2;  // of the grid [m]
  double reynolds = 200;
  int passes = 0;
  Vec<2> offset = Vec<2>::Zero();  // of the centre of mass from the centroid
  SideKind sides = SideKind::free;
  int tall = 1;  // height of the grid over its breadth

  GridFlowSpec fluid() const {
    GridFlowSpec spec;
    spec.density = 1;
    spec.viscosity = 1 / reynolds;
    spec.grid = square_grid(4 * static_cast<int>(std::lround(half / (2 * h))), half);
    spec.grid.ny *= tall;
    spec.grid.min.y() *= tall;
    spec.sides = sides;
    spec.gravity = {0, -g};
    spec.penalisation.smoothing = smoothing;
    spec.penalisation.passes = passes;
    WallSpec<2> wall;
    wall.name = "body";
    wall.surface = surface();
    wall.pose = pose();
    spec.walls = {wall};
    return spec;
  }
  Surface<2> surface() const {
    auto moved = outline;
    moved.vertices.colwise() -= offset;
    return moved;
  }
  Isometry<2> pose() const {
    Isometry<2> at = Isometry<2>::Identity();
    at.linear() = Eigen::Rotation2Dd(angle).toRotationMatrix();
    at.translation() = at.linear() * offset;
    return at;
  }
  BodySpec<2> body() const {
    const auto m = moments_of(outline);
    BodySpec<2> spec;
    spec.name = "body";
    spec.surface = surface();
    spec.mass = density * m.area;
    spec.inertia(0, 0) = density * m.polar;
    spec.free.fill(true);
    spec.pose = pose();
    return spec;
  }
};

using Coupled = coupling::FallingBody<GridFlow>;

inline Coupled coupled(const FreeBody& scene, std::unique_ptr<coupling::Accelerator> accelerator = nullptr,
                       coupling::CouplingLimits limits = {}) {
  return coupling::falling_body<Participant>(std::make_unique<GridFlow>(scene.fluid()), scene.body(), g,
                                             std::move(accelerator), limits);
}

}  // namespace splashdown::vortex::scenes
