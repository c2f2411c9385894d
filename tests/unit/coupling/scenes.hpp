// Coupled scenes that the tests of coupling, verification and stability share.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "rigid/forces/gravity.hpp"
#include "rigid/shapes/shapes.hpp"
#include "tests/unit/coupling/watched.hpp"
#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::coupling::scenes {

using Vec = Eigen::Vector2d;
using fluid::scenes::eps;

inline constexpr double g = 9.81;
inline constexpr double water = 1000;

/// Bodies come first among the fluid's walls, the tank last.
struct Scene {
  fluid::FluidSpec<2> fluid;
  std::vector<rigid::BodySpec<2>> bodies;
  Vec gravity{0, -g};
  std::function<std::unique_ptr<rigid::Force<2>>()> extra_force;
  std::vector<rigid::JointSpec> joints;
  std::optional<rigid::ContactSpec<2>> contacts;

  void add_body(const rigid::Shape<2>& shape, double mass, const Vec& centre, double size, double pitch = 0) {
    const auto properties = rigid::with_mass<2>(shape.at_unit_density, mass);
    rigid::BodySpec<2> b;
    b.name = "body" + std::to_string(bodies.size());
    b.surface = rigid::centred<2>(shape.surface, properties.centre);
    b.mass = mass;
    b.inertia = properties.inertia;
    b.free.fill(true);
    b.pose.translate(centre);
    b.pose.rotate(pitch);
    fluid::WallSpec<2> w = fluid::scenes::wall(b.name, {b.surface.vertices, b.surface.facets}, size);
    w.pose = b.pose;
    fluid.walls.insert(fluid.walls.begin() + static_cast<std::ptrdiff_t>(bodies.size()), w);
    bodies.push_back(b);
  }
  void set_velocity(std::size_t body, const rigid::Twist<2>& s) {
    bodies[body].velocity = fluid.walls[body].velocity = s;
  }
  /// The same scene, turned about the origin.
  Scene turned(double angle) const {
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(angle).toRotationMatrix();
    Scene out = *this;
    for (auto& l : out.fluid.liquids) l.boundary.vertices = R * l.boundary.vertices;
    for (std::size_t w = 0; w < out.fluid.walls.size(); ++w) {
      auto& wall = out.fluid.walls[w];
      wall.pose.prerotate(Eigen::Rotation2Dd(angle));
      wall.velocity.head<2>() = R * wall.velocity.head<2>();
      if (w < bodies.size()) out.bodies[w].pose = wall.pose, out.bodies[w].velocity = wall.velocity;
    }
    out.gravity = R * gravity;
    return out;
  }
};

inline std::unique_ptr<fluid::Fluid<2>> water_of(const Scene& scene) {
  const bool weighs = scene.gravity != Vec::Zero();
  return std::make_unique<fluid::Fluid<2>>(
      scene.fluid, weighs ? fluid::scenes::gravity(scene.gravity) : fluid::scenes::no_effects());
}

inline std::unique_ptr<rigid::Bodies<2>> bodies_of(const Scene& scene) {
  std::vector<std::unique_ptr<rigid::Force<2>>> forces;
  if (scene.gravity != Vec::Zero()) forces.push_back(std::make_unique<rigid::Gravity<2>>(scene.gravity));
  if (scene.extra_force) forces.push_back(scene.extra_force());
  return std::make_unique<rigid::Bodies<2>>(scene.bodies, std::move(forces), scene.joints, scene.contacts);
}

/// Bodies inside the pressure equation.
inline std::unique_ptr<Watched<2>> coupled(const Scene& scene) {
  return std::make_unique<Watched<2>>(water_of(scene), bodies_of(scene));
}

inline std::unique_ptr<Watched<2>> coupled(
    const Scene& scene, std::unique_ptr<InterfaceTerm> term,
    std::unique_ptr<Accelerator> accelerator = std::make_unique<ConstantRelaxation>(1.0), CouplingLimits limits = {}) {
  return std::make_unique<Watched<2>>(water_of(scene), bodies_of(scene), std::move(term), std::move(accelerator),
                                      limits);
}

/// A circle of radius 0.5 m, 1.5 m deep in a tank of 5 m by 3 m.
inline Scene submerged_circle(double density_ratio, double h = 0.12) {
  Scene s;
  s.fluid = fluid::scenes::still_water(5, 3, 3 * h);
  s.fluid.size = {.surface = 2 * h, .far = 3 * h, .growth = 0.2};
  const auto shape = rigid::circle(0.5, 64);
  s.add_body(shape, density_ratio * water * shape.at_unit_density.mass, {0, -1.5}, h);
  return s;
}

/// A wedge of 30 degrees and 0.5 m breadth over still water, falling at 6.15 m/s.
inline Scene wedge_drop(double mass, double height, double h = 0.01) {
  Scene s;
  s.fluid = fluid::scenes::still_water(2, 1, 0.2);
  s.fluid.size = {.surface = 0.05, .far = 0.2, .growth = 0.2};
  const auto shape = rigid::wedge(std::numbers::pi / 6, 0.5, 0.1);
  s.add_body(shape, mass, Vec(0, height) + shape.at_unit_density.centre, h);
  s.bodies[0].free = {false, true, false};
  s.set_velocity(0, {0, -6.15, 0});
  return s;
}

inline std::string saved(const Stepper& stepper) {
  std::ostringstream out;
  stepper.save(out);
  return out.str();
}

/// Attempts a step as runs do: halved as long as it is refused.
inline StepReport attempt_halving(Stepper& stepper, double& dt, int attempts) {
  auto report = stepper.attempt(dt);
  while (!report.ok() && --attempts > 0) report = stepper.attempt(dt *= 0.5);
  return report;
}

/// Steps of the criterion, the first ones short. Returns the largest number of passes; -1: a step was
/// refused.
inline int run(Stepper& stepper, int steps, double dt_first = 1e-4) {
  int passes = 0;
  double dt = dt_first;
  for (int i = 0; i < steps; ++i) {
    dt = std::min(stepper.stable_dt(), i == 0 ? dt_first : 1.5 * dt);
    const auto report = stepper.attempt(dt);
    if (!report.ok()) return -1;
    passes = std::max(passes, report.passes);
    stepper.commit();
  }
  return passes;
}

/// Steps as long as they may be until `end`: the last one's report, or that of the one that was refused, with the most passes.
inline StepReport go_on_to(Stepper& stepper, double end, double dt_first = 1e-4) {
  StepReport report;
  int passes = 0;
  for (double dt = dt_first; stepper.time() < end; dt *= 1.5) {
    dt = std::min({stepper.stable_dt(), dt, end - stepper.time()});
    report = stepper.attempt(dt);
    passes = report.passes = std::max(passes, report.passes);
    if (!report.ok()) break;
    stepper.commit();
  }
  return report;
}

/// `resumed` takes over from `whole`, and both make some steps of dt. True: none is refused, and they end with the same
/// bits.
inline bool go_on_alike(Stepper& whole, Stepper& resumed, int steps, double dt) {
  std::istringstream file(saved(whole));
  resumed.load(file);
  for (auto* stepper : {&whole, &resumed})
    for (int i = 0; i < steps; ++i) {
      if (!stepper->attempt(dt).ok()) return false;
      stepper->commit();
    }
  return saved(whole) == saved(resumed);
}

}  // namespace splashdown::coupling::scenes
