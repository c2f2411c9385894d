// Bullet, double precision: it moves bodies in 3D and knows their joints. Internal to the rigid-body
// room; bullet_engine.cpp is the only file that includes Bullet.
//
//   x <- x + dt V,   R <- exp(dt w) R
//
// Leapfrog has two steps, kick and dt, Bullet has one: so velocities are handed over and Bullet's step is a mere
// drift. What Bullet does by itself and must not: 1/60 s quanta, gravity, damping, sleeping, its implicit
// gyroscopic term (loses energy at first order), and a silent stop at pi/4 of rotation a step. Its joints give
// their conditions; its solver of them is an iteration that stops far from roundoff, ours is direct (constraint_solver.hpp).
#pragma once

#include <memory>
#include <vector>

#include "rigid/joint.hpp"

namespace splashdown::rigid {

/// Bullet's world: bodies and joints by their numbers, world frame.
class BulletEngine {
 public:
  BulletEngine();
  ~BulletEngine();

  /// `moves`: whether drift moves it. Returns the body's number, counting from 0.
  std::size_t add(bool moves);
  /// Between bodies where they are now. Refers to them by their numbers; counts from 0 itself.
  void add(const JointSpec& joint);

  /// Finite values only.
  void place(std::size_t body, const Isometry<3>& pose, const Twist<3>& velocity);
  /// Moves all bodies.
  void drift(double dt);
  /// What the joints ask of the velocities with which bodies leave their places for a time dt.
  std::vector<Condition<3>> conditions(double dt);
  /// The joint of each of these conditions: the same in every step.
  const std::vector<std::size_t>& joint_of_condition() const { return joint_of_condition_; }
  /// Where a hinge or slider is now.
  JointCoordinate<3> coordinate(std::size_t joint) const;

  Isometry<3> pose(std::size_t body) const;  ///< world frame

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
  std::vector<std::size_t> joint_of_condition_;
};

}  // namespace splashdown::rigid
