// A body that forces move, in 3D: its inertia and its step. Internal to the rigid-body room.
#pragma once

#include "rigid/bodies.hpp"
#include "rigid/spin.hpp"

namespace splashdown::rigid {

/// Mass, inertia and angular momentum of one body; twists about its centre of mass, world frame.
class FreeBody {
 public:
  /// Which of (V, w) may change, world axes.
  using Freedom = std::array<bool, freedoms<3>>;
  /// Of twists: 6 x 6.
  using Matrix = Eigen::Matrix<double, freedoms<3>, freedoms<3>>;

  /// A body without mass has no inertia either.
  FreeBody(double mass, const Inertia<3>& inertia, const Freedom& free, const BodyState<3>& start);

  /// Fixes the step under a known impulse: the inertia, and what of the impulse changes s with it.
  void begin(const BodyState<3>& state, const Wrench<3>& impulse, double dt);
  /// M of the begun step in world axes: M (s - s_before) = impulse() + other impulses, in the free freedoms.
  const Matrix& inertia() const { return matrix_; }
  const Wrench<3>& impulse() const {
    return impulse_;
  }  ///< known impulse of the begun step, with what the spin adds [N s, N m s]
  /// Takes on the momentum of the velocity that the step ends with.
  void commit(const Twist<3>& velocity);

  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();  ///< angular, about the centre of mass, at t_{n-1/2}

 private:
  double mass_;
  Inertia<3> inertia_;
  std::array<bool, 3> spinning_;
  Matrix matrix_ = Matrix::Zero();
  Wrench<3> impulse_ = Wrench<3>::Zero();
};

}  // namespace splashdown::rigid
