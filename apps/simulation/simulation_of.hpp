// A scene's world and its steps, in two dimensions or in three.
#pragma once

#include <optional>

#include "apps/build/build.hpp"
#include "apps/record/recorder.hpp"
#include "apps/scene/scene.hpp"
#include "apps/simulation/all_bodies.hpp"
#include "apps/simulation/steps.hpp"
#include "apps/simulation/wall_watch.hpp"

namespace splashdown::apps {

template <int d>
class SimulationOf {
 public:
  /// Keeps the reference to the scene that the world was made of.
  SimulationOf(const Scene& scene, World<d> world);

  coupling::Stepper& stepper() { return *world_.stepper; }
  const coupling::Stepper& stepper() const { return *world_.stepper; }
  const World<d>& world() const { return world_; }
  /// The scene's dt_max, and no hull enters the water by more than a share of its elements in a step [s].
  double dt_bound() const;
  /// A body that the step tried last carries through a wall.
  std::optional<Obstacle> obstacle() const;
  /// What is known at t_n of a step that was tried; halves of symmetric scenes are told as the whole. Views live as long as this.
  RecordInput<d> known(const StepMade& step) const;

 private:
  const Scene& scene_;
  World<d> world_;
  std::optional<WallWatch<d>> walls_;  // of scenes with rigid bodies
  std::optional<AllBodies<d>> all_;    // of scenes with rigid and elastic ones
};

extern template class SimulationOf<2>;
extern template class SimulationOf<3>;

}  // namespace splashdown::apps
