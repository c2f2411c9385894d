// An elastic body whose surface a fluid presses on. Coordinates of the wall are the velocities of the vertices of its surface
// (mesh/boundary.hpp), vertex by vertex, world frame. Impulses I act at t_n over a kick, walls move over dt with
// s = (x_{n+1} - x_n)/dt:
//
//   M s + dt/2 (f_n + C s) + c dt^2 K s = p_n + I + kick F(t_n),   p_{n+1} = M s - dt/2 (f_n + C s) + c dt (f_n - f_{n-1})
//
// with f_n = f(x_{n+1/2}), x_{n+1/2} = (x_n + x_{n+1})/2: kicks, and the midpoint rule between them (Hairer, Lubich, Wanner 2006,
// section VI.4). Second order with any steps; momenta are exact, and rigid motions leapfrog. f is that of
// Law::stress_between, so that between kicks energies of linear solids and of St. Venant and Kirchhoff's are exact at any dt.
// p is the momentum just before the kick of t_n. The tangent of the left side, M_s = M + dt/2 C + (1/4 + c) dt^2 K, is what the
// exact interface term knows.
//
// c damps vibrations that the step does not resolve, w dt >> 1: a step leaves 0.72 of them where c = 0.1 (ElasticWall). Held
// unknowns move with what drives them in the middle of the step, or stay.
#pragma once

#include <iosfwd>

#include "core/mixing.hpp"
#include "core/response.hpp"
#include "elastic/assembly/solid.hpp"
#include "elastic/mesh/boundary.hpp"
#include "elastic/steps/scheme.hpp"

namespace splashdown::elastic {

/// begin, any number of trials, commit. Trials start from t_n.
///
/// The midpoint rule and C leave vibrations of w dt >> 1 as they are, p_{n+1} = -p_n; kicks feed them, and shorter steps show
/// their energy, by (dt/dt_new)^2. Of slow ones c takes little, since c dt K s is c (f_n - f_{n-1}) to second order: c (w dt)^3/4
/// of the critical damping is left, 0.01 % with forty steps a period, and the frequency is (1/12 + 3c/4) (w dt)^2 low. Of large
/// motions dt K s has the second Piola stress that the step adds, and f_n - f_{n-1} theirs where the step ends: momenta stay
/// exact (NodalWall::damping_of_second_half).
template <int d>
class ElasticWall {
 public:
  /// Of a solid that outlives it; `dynamics`: its damping, loads, limits.
  ElasticWall(const Solid<d>& solid, Dynamics dynamics);
  virtual ~ElasticWall() = default;

  /// The surface at rest, world frame at t = 0, and its nodes.
  const Boundary<d>& boundary() const { return boundary_; }
  /// Velocities of all nodes at t = 0.
  virtual void start(const Field& velocity) = 0;

  /// Fixes the step from t: the trial without an impulse, and how it changes with one.
  void begin(double t, double kick, double dt);
  /// Of the begun step: velocities without an impulse, until `update` puts them anew.
  const Eigen::VectorXd& free() const { return free_; }
  /// Z and M of the begun step, s = free + Z y, M y = Z^T I.
  const ModalInertia& modal() const { return modal_; }
  /// The trial under an impulse, by Newton's method.
  const Eigen::VectorXd& solve(const Eigen::VectorXd& impulse);
  /// The trial whose surface has these velocities, or in modes the nearest to them that it can have.
  const Eigen::VectorXd& adopt(const Eigen::VectorXd& velocities);
  /// Whether an impulse changes the last trial by more than `tolerance` of its velocities, and more than vertices stray as the
  /// body turns, a hundredth at most, or with more work in all steps than 0.5 % of its energy; `free` is then put so that
  /// free + Z y is right near this trial, a pass of a Newton method with the tangent of the begun step.
  bool update(const Eigen::VectorXd& impulse, double tolerance);
  /// Whether the last trial is a solution and no element of it is turned over.
  Status acceptable() const;
  void commit();  ///< accepts the last trial

  /// Of the surface: where the last trial brings it [m].
  Eigen::VectorXd placement() const;
  /// Of the surface: velocities that it came to t_n with [m/s].
  Eigen::VectorXd velocities() const { return at_boundary(s_); }
  /// Of all nodes at t_n [m].
  const Field& displacement() const { return u_; }
  /// Of all nodes: M v = p, just before the kick of t_n [m/s].
  virtual Field velocity() const = 0;
  /// Of the last step, (s - s_before) / kick [m/s^2].
  const Field& acceleration() const { return a_; }
  /// U(u), as the step knows it [J, J/m].
  virtual double strain_energy() const = 0;
  /// s.M s/2, of the last step [J, J/m]. With `strain_energy_between` it changes by I.(s_before + s)/2, what a fluid books as
  /// work; p.v/2 also holds what vibrations too fast for the step would have got from a kick in no time.
  double kinetic_energy_between() const { return 0.5 * s_.dot(solid_.mass() * s_); }
  /// U in the middle of the last step [J, J/m].
  virtual double strain_energy_between() const = 0;
  /// What damping has taken of the body so far: in a kick s'.(D_before + D) with the mean s' of the velocities before and after
  /// it and D = dt/2 C s [J, J/m].
  double dissipated() const { return dissipated_; }
  /// What moving clamps have given it so far: in a kick s'.R, R being what the equations of held unknowns lack [J, J/m].
  double driven() const { return driven_; }
  /// Newton iterations so far.
  virtual long iterations() const = 0;
  void save(std::ostream& out) const;  ///< the state at t_n, bit for bit
  /// Throws std::runtime_error for other bytes.
  void load(std::istream& in);

 protected:
  /// What of a begun step all trials share.
  virtual void prepare() {}
  /// The trial s_next_ under an impulse.
  virtual Status move(const Eigen::VectorXd& impulse) = 0;
  /// The trial s_next_ of given velocities.
  virtual Status follow(const Eigen::VectorXd& velocities) = 0;
  /// Z and M about the trial without an impulse.
  virtual ModalInertia linearised() = 0;
  /// Z^T of the impulse that the last trial of `follow` obeys.
  virtual Eigen::VectorXd implied() const = 0;
  /// What an impulse makes of the last trial, and the velocities without what Z and M answer of it.
  struct Renewed {
    Status status;
    Eigen::VectorXd velocities, free;
  };
  /// Of the surface. May put the trial anew, near enough to be accepted in its stead.
  virtual Renewed renewed(const Eigen::VectorXd& impulse);
  /// Norm over the surface of what vertices stray in the trial from velocities along their tangents at t_n, because the body
  /// turns [m/s]. A fluid that holds these has the error of one beside a rigid wall, which turns while its twist stays.
  virtual double stray() const { return 0; }
  /// Of the trial, as `kinetic_energy_between` and `strain_energy_between` have it once it is the present [J, J/m].
  virtual double trial_energy() const { return 0; }
  /// Makes the trial the present.
  virtual void accept() = 0;
  /// What the damping of the trial's step takes in its kick, and that of the step before [J, J/m].
  virtual double damping_work() const = 0;
  /// What moves the held unknowns gives in the trial's kick, under the impulse on all nodes [J, J/m].
  virtual double drive_work(const Field& impulse) const = 0;
  /// What a kind of wall adds to the state.
  virtual void write(std::ostream& out) const = 0;
  /// The same read back.
  virtual void read(std::istream& in) = 0;

  /// Of a field the numbers at the surface's vertices.
  Eigen::VectorXd at_boundary(const Field& field) const;
  /// The impulse on all nodes.
  Field spread(const Eigen::VectorXd& impulse) const;

  const Solid<d>& solid_;
  Dynamics dynamics_;
  Boundary<d> boundary_;
  Field u_, s_, a_;  // displacements at t_n; velocities of the last step and their rate
  Field s_next_;     // of the trial; displacements are u_ + dt s_next_
  Field load_;       // kick F(t_n)
  Field drive_;      // velocities of held unknowns in the step, zero for others; empty: none moves
  double dt_ = 0, kick_ = 0;

 private:
  const Eigen::VectorXd& tried(const Status& status);

  ModalInertia modal_;
  Eigen::VectorXd free_, trial_, impulse_;
  Eigen::VectorXd asked_;  // velocities that a trial was to have
  Mixing mixing_{0};       // of `free_`, pass by pass
  double dissipated_ = 0, driven_ = 0;
  double strayed_ = 0, strayed_next_ = 0;  // work of impulses on what vertices stray, so far and with the trial
  Status begun_, status_;
};

/// All nodes: the coordinates of the exact term are those of all vertices that are not held, M is what the inside leaves of M_s
/// on them (Schur complement), dense. `modes`: in their stead the answers of the deformed body to the inertia of its lowest
/// modes, 0: all vertices; what else moves takes passes. Throws std::invalid_argument for more modes than the body has.
template <int d>
std::unique_ptr<ElasticWall<d>> nodal_wall(const Solid<d>& solid, Dynamics dynamics, int modes = 0);
/// The lowest natural modes, small vibrations about x = c + R (X - C + sum q_k phi_k) with a frame (c, R) that moves along if
/// nothing is held; the frame then counts as 3 of the modes in the plane, 6 in space. Throws std::invalid_argument for fewer
/// or too many.
template <int d>
std::unique_ptr<ElasticWall<d>> modal_wall(const Solid<d>& solid, Dynamics dynamics, int modes);

}  // namespace splashdown::elastic
