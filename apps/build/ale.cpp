#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "apps/build/build.hpp"
#include "apps/scene/geometry.hpp"

namespace splashdown::apps {
namespace {

struct SideName {
  std::string_view name;
  ale::BoundaryKind kind;
};
constexpr SideName side_kinds[] = {{"inflow", ale::BoundaryKind::inflow},
                                   {"outflow", ale::BoundaryKind::outflow},
                                   {"no_slip", ale::BoundaryKind::no_slip},
                                   {"slip", ale::BoundaryKind::slip}};

/// From rest to 1 within the ramp.
double risen(double time, double ramp) {
  return time < ramp ? 0.5 * (1 - std::cos(std::numbers::pi * time / ramp)) : 1;
}

/// Over the height of the side that it comes in by, 1 in the mean.
ale::FlowField inflow_of(const AleFluid& fluid) {
  const Vec<2> mean = vec<2>(fluid.velocity), min = vec<2>(fluid.min), size = vec<2>(fluid.max) - min;
  const double ramp = fluid.ramp;
  if (fluid.profile == "uniform") return [=](const Vec<2>&, double time) { return Vec<2>(risen(time, ramp) * mean); };
  return [=](const Vec<2>& x, double time) {
    const bool by_left_or_right = x.x() == min.x() || x.x() == min.x() + size.x();
    const int along = by_left_or_right ? 1 : 0;
    const double at = (x[along] - min[along]) / size[along];
    return Vec<2>(6 * at * (1 - at) * risen(time, ramp) * mean);
  };
}

/// theta of (v+ - v-)/k = theta F(v+) + (1 - theta) F(v-).
ale::ThetaScheme scheme_of(const AleFluid& fluid) {
  if (fluid.scheme == "steady") return {.theta = 1, .is_steady = true};
  if (fluid.scheme == "implicit_euler") return {.theta = 1};
  return {.theta = 0.5 + (fluid.scheme == "shifted" ? fluid.shift : 0)};
}

}  // namespace

ale::AleFlowSpec ale_spec(const Scene& scene) {
  const auto& fluid = *scene.ale;
  ale::AleFlowSpec spec;
  spec.density = fluid.density;
  spec.viscosity = fluid.viscosity;
  spec.min = vec<2>(fluid.min);
  spec.max = vec<2>(fluid.max);
  const auto sides = fluid.sides.all();
  std::ranges::transform(sides, spec.sides.begin(), [](const std::string& name) {
    return std::ranges::find(side_kinds, name, &SideName::name)->kind;
  });
  spec.inflow = inflow_of(fluid);
  spec.far = fluid.far;
  spec.growth = fluid.growth;
  spec.extension = fluid.extension == "biharmonic" ? ale::ExtensionLaw::biharmonic : ale::ExtensionLaw::laplace;
  spec.remesh = fluid.remesh == "automatic";
  spec.corner = fluid.corner;
  if (scene.gravity) spec.gravity = vec<2>(scene.gravity->acceleration);
  spec.scheme = scheme_of(fluid);
  spec.newton = {.tolerance = fluid.tolerance, .max_iterations = fluid.max_iterations};
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    auto& wall = spec.walls.emplace_back(wall_of<2>(scene, b));
    wall.sticks = true;
    spec.motions.push_back(wall.deforms ? ale::deforming_wall(wall.surface) : ale::rigid_wall(wall.pose));
  }
  for (const auto& goal : fluid.goals) {
    const auto body = std::ranges::find(scene.bodies, goal.body, &Body::name);
    spec.goals.push_back({.name = goal.body + "." + goal.direction,
                          .wall = static_cast<std::size_t>(body - scene.bodies.begin()),
                          .direction = goal.direction == "x" ? Vec<2>::UnitX() : Vec<2>::UnitY()});
  }
  return spec;
}

}  // namespace splashdown::apps
