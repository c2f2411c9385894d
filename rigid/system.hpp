// What Bodies holds: the bodies, Bullet's objects for them, and the conditions and constraints of a begun step.
// Internal to the rigid-body room; bodies.cpp has the verbs, system.cpp what a step asks of velocities.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "rigid/bodies.hpp"
#include "rigid/bullet_engine.hpp"
#include "rigid/constraints/constraint_solver.hpp"
#include "rigid/free_body.hpp"

namespace splashdown::rigid {

/// The state behind Bodies.
template <int d>
struct Bodies<d>::System {
  /// Where between two commits it stands.
  enum class Phase { committed, begun, solved };

  std::vector<BodySpec<d>> specs;
  std::vector<double> reaches;  // of the bodies (body.hpp)
  std::vector<std::unique_ptr<Force<d>>> forces;
  std::vector<BodyState<d>> states, trials;
  std::optional<Contacts<d>> contacts;
  BulletEngine bullet;
  std::vector<std::unique_ptr<FreeBody>> movers;  // empty for bodies that forces never move
  std::vector<char> held;                         // 1: prescribed until it is released
  std::vector<JointSpec> joints;
  std::vector<double> moved;  // their coordinates at t_n, of those that are measured
  Eigen::VectorXd loads;      // of the last step; empty before
  double time = 0, kick = 0, dt = 0;
  double committed_dt = 0;  // of the step that led to t_n
  Phase phase = Phase::committed;

  // Of the begun step
  std::vector<Condition<d>> tied;     // what joints ask
  std::vector<Condition<d>> near;     // contacts that may close, then stops of joints
  std::vector<Condition<d>> rubbing;  // along what these contacts slide
  Eigen::VectorXd rebound;            // least rates of these contacts after an impact; empty: all are plastic
  /// A joint with a spring, as it is at t_n.
  struct Sprung {
    std::size_t joint;
    Spring spring;
    JointCoordinate<d> at;
  };
  std::vector<Sprung> sprung;
  std::vector<Pull<d>> pulls;         // of forces
  std::vector<std::size_t> stopped;   // the joints of the stops in `near`
  ConstraintSolver::Problem problem;  // that `constraints` solves
  ConstraintSolver constraints;
  Eigen::VectorXd impulses;  // the last that were tried
  Eigen::VectorXd apart;     // velocities that only drift: how hulls that overlap part

  /// Number of bodies.
  Eigen::Index size() const { return static_cast<Eigen::Index>(specs.size()); }
  /// Throws std::logic_error with time and rule unless `fine`.
  void expect(bool fine, const char* rule) const;
  /// Throws std::invalid_argument unless there is one value for each coordinate of all bodies.
  void expect_all(const Eigen::VectorXd& values) const;
  /// Wrenches of all bodies, one below the other. Throws std::invalid_argument for another number of them.
  Eigen::VectorXd stacked(std::span<const Wrench<d>> each) const;

  std::vector<double> hull_measures, wetted_share;  // of the bodies [m, m^2]; what is wet of them

  /// What forces see, of the step that `kick_` and `dt_` begin.
  BodiesAt<d> at(double kick_, double dt_) const { return {specs, states, wetted_share, time, kick_, dt_, held}; }
  /// The same with the step's last trial, if there is one.
  BodiesAt<d> tried() const {
    if (phase != Phase::solved) return at(0, 0);
    return {specs, states, wetted_share, time, kick, dt, held, trials};
  }
  /// Sums of all forces but the fluid's load at t_n on each body, about its centre of mass, world frame [N, N m].
  std::vector<Wrench<d>> known_forces() const;
  /// A prescribed body's velocity is the finite difference that carries one pose into the next.
  BodyState<d> prescribed(std::size_t body) const;
  /// Whether forces move it in the step.
  bool answers(std::size_t body) const { return movers[body] && !held[body]; }
  /// Whether a contact with another body was closed in the step that was tried.
  bool is_touched(std::size_t body) const;
  /// Lets go whose time, contact or load has come.
  void release();
  /// Largest dt that ends at the next release at a time, not by a sliver of a step [s].
  double until_release() const;
  /// Puts Bullet's body where `state` has it.
  void place(Eigen::Index body, const BodyState<d>& state);

  /// All that a begun step needs to answer impulses: conditions, springs, constraints.
  void set_up_constraints();
  /// Contacts that would be closed under the loads of the step before: most often they are.
  void guess_contacts();
  /// Trial states that these velocities of all bodies lead to.
  void drift(const Eigen::VectorXd& velocities);
  /// Contacts that cannot be had together, or only where a body leaves many times as fast as others close in on it: those that
  /// are held, or come on a path, leave it no room.
  Status squeezed() const;
  /// What joints and contacts do to bodies, means over the kick of the last trial: JOINT_fx ... on the first body of each joint,
  /// BODY_contact_fx ... on each body that forces move, about its centre of mass, world frame [N, N m; 2D: N/m, N].
  std::vector<Diagnostic> reactions() const;
  /// Faster than at t_n, bodies reach more than was looked at.
  Status passes_through() const;

 private:
  /// The states with velocities of t_n, as far as they are known: with these forces, and the loads of the last step.
  /// What a wrench and the load of the last step make a body's free freedoms do, joints and contacts apart [m/s^2, rad/s^2].
  Twist<d> acceleration(std::size_t body, Wrench<d> wrench) const;
  void let_go(std::size_t body);
  std::vector<BodyState<d>> predicted(std::span<const Wrench<d>> forces_) const;
  std::vector<Condition<d>> asked_by_joints();
  /// By joints, then what is held: freedoms of free bodies, and others altogether.
  std::vector<Condition<d>> equalities();
  void find_contacts();
  void find_stops_and_springs();
  /// Impulses along the rows of `tied`, then of `near`, then of `rubbing`, that the last trial's velocities take.
  Eigen::VectorXd reaction_impulses() const;
  /// What the spring of a joint does to its first body, mean over the kick.
  Wrench<d> spring_force(const Sprung& sprung) const;
  using MassMatrix = Eigen::Matrix<double, freedoms<d>, freedoms<d>>;
  MassMatrix inertia(std::size_t body) const;  ///< of one that forces move, in the step
  /// Whether trial velocities break a condition by more than roundoff.
  bool crosses(const Condition<d>& condition) const;
  /// Left sides, a row each, of the velocities of all bodies.
  Eigen::MatrixXd rows_of(const std::vector<Condition<d>>& conditions) const;
  void solve_conditions();
  /// Hulls that overlap move apart as they drift, the heavy ones least, without speed: it would be energy from nowhere.
  void part_overlaps(ConstraintSolver::Problem problem);
  /// Springs at (q_{n-1} + 2 q_n + q_{n+1})/4 (Newmark 1959, beta = 1/4), dampers at (1 - a) dq_{n-1/2} + a dq_{n+1/2}, a from
  /// 1/2 for weak ones to 1: no step is too long for them, and they add no energy. What depends on s_{n+1/2} is inertia.
  void add_springs(ConstraintSolver::Problem& problem) const;
  /// Pulls of forces: two-sided ones are inertia, one-sided ones contacts that yield.
  void add_pulls(ConstraintSolver::Problem& problem) const;
};

}  // namespace splashdown::rigid
