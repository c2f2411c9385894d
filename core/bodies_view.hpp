// What people look at in bodies: what they are, and their state at t_n. Records know bodies by this alone.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"
#include "core/types.hpp"

namespace splashdown {

/// free: by forces, in the freedoms that are let free; fixed: not at all; prescribed: along a path.
enum class BodyMotion { free, fixed, prescribed };

/// When a prescribed body becomes free: as soon as one of these holds at the end of a step.
struct Release {
  std::optional<double> time = {};  ///< it is this time, which a step ends at [s]
  bool at_contact = false;          ///< its hull is wet, or a body that moves touches it
  std::optional<double> load = {};  ///< the water's load on it is so large [N, N/m]
};

/// What a body is made from. SI; per metre of depth in 2D [kg/m, kg m].
template <int d>
struct BodySpec {
  std::string name;                             ///< of the scene
  Surface<d> surface;                           ///< in the body frame, whose origin is the centre of mass
  double mass = 0;                              ///< [kg, kg/m]
  Inertia<d> inertia = Inertia<d>::Identity();  ///< about the centre of mass, body axes [kg m^2, kg m]
  BodyMotion motion = BodyMotion::free;         ///< what moves it
  std::array<bool, freedoms<d>> free{};         ///< which of (V, w) may change, world axes; used when forces move it
  Isometry<d> pose = Isometry<d>::Identity();   ///< body frame to world at t = 0
  Twist<d> velocity = Twist<d>::Zero();         ///< at t = 0
  /// Pose at time t for motion = prescribed [world frame].
  std::function<Isometry<d>(double)> path;
  std::optional<Release> release = {};  ///< of motion = prescribed: until then

  /// Forces move it, from the start or after its release.
  bool becomes_free() const { return motion == BodyMotion::free || release; }
};

/// Where a body is and how it moves, world frame, about its centre of mass.
template <int d>
struct BodyState {
  Isometry<d> pose;   ///< at t_n, body frame to world
  Twist<d> velocity;  ///< at t_{n-1/2} (at t_0 for the first step)
};

/// The bodies in the order of the scene; an index beyond the last throws std::out_of_range.
template <int d>
class BodiesView {
 public:
  virtual ~BodiesView() = default;
  virtual std::size_t size() const = 0;                           ///< how many bodies
  virtual const BodySpec<d>& spec(std::size_t body) const = 0;    ///< as it was made
  virtual const BodyState<d>& state(std::size_t body) const = 0;  ///< at t_n
  /// What forces, joints and contacts say about themselves in the step from t_n that was tried: FORCE_NAME and value, always of
  /// the same names.
  virtual std::vector<Diagnostic> diagnostics() const { return {}; }
};

}  // namespace splashdown
