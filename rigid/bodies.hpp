// All rigid bodies of a scene, moved by Bullet (double precision).
//
//   m dV/dt = F,   d(I w)/dt = M        (Newton-Euler, about the centre of mass)
//
// Leapfrog (Stoermer-Verlet): velocities live at half steps, poses at whole steps,
//
//   s_{n+1/2} = s_{n-1/2} + kick M_b^-1 (f_n + sum of forces),   kick = (dt_{n-1} + dt_n)/2
//   x_{n+1}   = x_n + dt_n V_{n+1/2},   R_{n+1} = exp(dt_n w_{n+1/2}) R_n
//
// which is Bullet's semi-implicit Euler step when dt is constant. Second order, symplectic.
// Joints and contacts are conditions on the half-step velocities, taken at x_n, that remove what x_n violates of
// them: positions stay on them to second order in dt. Stops of joints are contacts; springs and dampers of joints are part of
// the equation above, taken so that no step is too long for them.
// Three verbs: begin fixes kick and dt, solve may be repeated (always from t_n, same bits for the same input), commit makes
// t_{n+1} the present. A load that is not finite gives a trial state that is not.
#pragma once

#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/bodies_view.hpp"
#include "core/response.hpp"
#include "core/status.hpp"
#include "rigid/body.hpp"
#include "rigid/contact/contacts.hpp"
#include "rigid/forces/force.hpp"
#include "rigid/joint.hpp"

namespace splashdown::rigid {

/// The bodies and their state. Driven by one thread. World frame; quantities about the centres of mass.
template <int d>
class Bodies final : public BodiesView<d> {
 public:
  /// Contacts between the bodies and with the planes only if asked for. Throws std::invalid_argument for bodies and joints
  /// that cannot be (body.hpp, joint.hpp).
  Bodies(std::vector<BodySpec<d>> specs, std::vector<std::unique_ptr<Force<d>>> forces,
         std::vector<JointSpec> joints = {}, std::optional<ContactSpec<d>> contacts = {});
  ~Bodies() override;
  /// Takes all over; what is left may only be destroyed or assigned to.
  Bodies(Bodies&&) noexcept;
  /// Takes all over; what is left may only be destroyed or assigned to.
  Bodies& operator=(Bodies&&) noexcept;

  std::size_t size() const override;
  const BodySpec<d>& spec(std::size_t body) const override;
  const BodyState<d>& state(std::size_t body) const override;
  std::span<const BodyState<d>> states() const;  ///< of all, at t_n
  std::span<const BodyState<d>> trials() const;  ///< of all: the last trial
  double time() const;                           ///< t_n [s]
  bool answers(std::size_t body) const;          ///< forces move it from t_n on: it is free, or has been released

  /// Fixes the step: forces over `kick` [s], drift over `dt` [s]; joints, springs and contacts are taken at x_n. Throws
  /// std::invalid_argument unless both are positive.
  void begin(double kick, double dt);
  /// Of the begun step, with the contacts that are closed at the moment. The half-step velocities are affine in the
  /// load until contacts open or close. (A spinning body in 3D is taken at its predicted midpoint.)
  Response response() const;
  /// Trial state at t_{n+1} (pose) and t_{n+1/2} (velocity) under constant loads, one wrench a body about its centre of mass,
  /// world frame [N, N m; 2D: N/m, N]. Throws std::invalid_argument for another number of them, std::logic_error before
  /// `begin`.
  std::span<const BodyState<d>> solve(std::span<const Wrench<d>> loads);
  /// The same under their impulses over the kick, of all bodies one below the other [N s, N m s].
  std::span<const BodyState<d>> solve(const Eigen::VectorXd& impulses);
  /// Trial state with half-step velocities of all bodies that somebody found from `response`.
  std::span<const BodyState<d>> adopt(const Eigen::VectorXd& velocities);
  /// Opens and closes contacts as the last trial asks for if the impulses on all bodies are these. False: they were right.
  bool update_contacts(const Eigen::VectorXd& impulses);
  /// Whether the last trial stays on its side of what it may touch: contacts are looked for as far as velocities of t_n
  /// reach, and hulls that are held may leave others no room.
  Status acceptable() const;
  /// Accepts the last trial.
  void commit();
  /// Tells forces how much of each body's hull is wet from now on: its measure [m, m^2], in the order of the bodies. Part of the
  /// saved state. Throws std::invalid_argument for another number of them.
  void see_wetted(std::span<const double> measures);
  /// Largest dt that forces and releases at a time allow from t_n [s]; infinity: any.
  double stable_dt() const;
  std::vector<Diagnostic> diagnostics() const override;

  void save(std::ostream& out) const;  ///< bit-exact state at t_n
  void load(std::istream& in);         ///< std::runtime_error for what is none of these bodies

 private:
  struct System;  // rigid/system.hpp
  std::unique_ptr<System> system_;
};

extern template class Bodies<2>;
extern template class Bodies<3>;

}  // namespace splashdown::rigid
