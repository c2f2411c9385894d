// Forces on bodies besides the fluid's load: present in a scene or absent, never switched.
#pragma once

#include <iosfwd>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "rigid/body.hpp"
#include "rigid/constraints/pull.hpp"

namespace splashdown::rigid {

/// What forces see of all bodies. World frame.
template <int d>
struct BodiesAt {
  std::span<const BodySpec<d>> specs;    ///< as they were made
  std::span<const BodyState<d>> states;  ///< poses at t_n, velocities at t_{n-1/2}, or of t_n: Force::is_of_velocity
  /// Of each hull's measure, what was wet in the last step, 0 to 1.
  std::span<const double> wetted_share;
  double time;                      ///< t_n [s]
  double kick = 0;                  ///< over which forces of this step act [s]; 0: none is begun
  double dt = 0;                    ///< of this step [s]; 0: none is begun
  std::span<const char> held = {};  ///< of each body, 1: it is on its path still
  /// Poses at t_{n+1} and velocities at t_{n+1/2} that were tried last; empty: none.
  std::span<const BodyState<d>> next = {};

  /// Of the step that led to t_n [s]; 0 at the start.
  double dt_before() const { return 2 * kick - dt; }
};

/// A force on one body or on several. `add` is taken at t_n and explicit: what is stiff bounds the step, or is a `pull`, which no
/// step is too long for.
template <int d>
class Force {
 public:
  virtual ~Force() = default;
  virtual std::string name() const = 0;  ///< of its table
  /// Adds to the wrench on each body about its centre of mass, world frame [N, N m; 2D: N/m, N]. The same for the same.
  virtual void add(const BodiesAt<d>& at, std::span<Wrench<d>> wrenches) const = 0;
  /// Whether it depends on velocities. Such forces are taken at those of t_n, predicted from t_{n-1/2} with all forces and the
  /// last step's loads (explicit midpoint rule): second order in time.
  virtual bool is_of_velocity() const { return false; }
  /// Adds pulls of a begun step. The same for the same.
  virtual void pull(const BodiesAt<d>& /*at*/, std::vector<Pull<d>>& /*pulls*/) const {}
  /// The step to `at.next` is accepted: what has a state of its own goes on to t_{n+1}.
  virtual void commit(const BodiesAt<d>& /*at*/) {}
  virtual void save(std::ostream& /*out*/) const {}  ///< that state, bit-exact
  virtual void load(std::istream& /*in*/) {}         ///< std::runtime_error for what is none
  /// Largest dt from t_n for which it is stable [s]; infinity: it sets none.
  virtual double stable_dt(const BodiesAt<d>& /*at*/) const { return std::numeric_limits<double>::infinity(); }
  /// Numbers at t_n, always of the same names; forces are means over the kick of the step that was tried.
  virtual std::vector<Diagnostic> diagnostics(const BodiesAt<d>& /*at*/) const { return {}; }
};

}  // namespace splashdown::rigid
