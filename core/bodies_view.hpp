// What people look at in bodies: what they are, and their state at t_n. Records know bodies by this alone.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "core/types.hpp"

namespace splashdown {

enum class BodyMotion { free, fixed, prescribed };

template <int d>
struct BodySpec {
  std::string name;
  Surface<d> surface;  ///< in the body frame, whose origin is the centre of mass
  double mass = 0;
  Inertia<d> inertia = Inertia<d>::Identity();
  BodyMotion motion = BodyMotion::free;
  std::array<bool, freedoms<d>> free{};        ///< which of (V, w) may change, world axes; used when motion = free
  Isometry<d> pose = Isometry<d>::Identity();  ///< body frame to world at t = 0
  Twist<d> velocity = Twist<d>::Zero();        ///< at t = 0
  /// Pose at time t for motion = prescribed [world frame].
  std::function<Isometry<d>(double)> path;
};

template <int d>
struct BodyState {
  Isometry<d> pose;   ///< at t_n, body frame to world
  Twist<d> velocity;  ///< at t_{n-1/2} (at t_0 for the first step)
};

template <int d>
class BodiesView {
 public:
  virtual ~BodiesView() = default;
  virtual std::size_t size() const = 0;
  virtual const BodySpec<d>& spec(std::size_t body) const = 0;
  virtual const BodyState<d>& state(std::size_t body) const = 0;  ///< at t_n
};

}  // namespace splashdown
