// Who goes through a wall because nothing holds him: without [contact] hulls pass the tank and each other, and what the water
// does there means nothing.
//
// Looked at are free bodies: others go where the scene says. What is not meant to be held apart may cross: bodies that a joint
// ties, and parts around a hinge that touch a wall from the start, as the foot of a flap on the floor.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/scene/scene.hpp"
#include "apps/scene/solid.hpp"
#include "apps/scene/tank_sides.hpp"
#include "apps/simulation/steps.hpp"
#include "rigid/bodies.hpp"

namespace splashdown::apps {

template <int d>
class WallWatch {
 public:
  using States = std::span<const rigid::BodyState<d>>;

  /// Looks at nothing if the scene has [contact]. The scene has to live as long. `bodies`: as they are at t = 0.
  WallWatch(const Scene& scene, const rigid::Bodies<d>& bodies);

  /// The first body that is farther in a wall than roundoff and the mesh account for, a tenth of an element: by as much facets of
  /// a curved hull depart from it. Costs a few operations a body, and pair of bodies, as long as balls around them are clear.
  std::optional<Obstacle> crossed(States states, double time) const;

 private:
  struct Watched {
    rigid::Surface<d> hull;  // in the body's frame
    double reach = 0;        // radius of the ball about the centre of mass that contains it
    double tolerance = 0;    // [m]
    bool is_free = false;
    std::vector<double> allowed;  // depth beyond each side of the tank
  };

  void allow_feet(std::size_t body, const Joint& joint, const rigid::Isometry<d>& pose);
  void let_pass(const rigid::Bodies<d>& bodies);
  std::optional<Obstacle> beyond_tank(std::size_t body, const rigid::Isometry<d>& pose, double time) const;
  bool overlaps(std::size_t a, std::size_t b, States states, double depth) const;

  const Scene& scene_;
  std::vector<TankSide<d>> sides_;
  std::vector<Watched> watched_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;  // that have to stay apart
};

extern template class WallWatch<2>;
extern template class WallWatch<3>;

}  // namespace splashdown::apps
