// A step of the water: what moves it from t_n to t_{n+1}. Formulations differ in how the repair and the pressure find a motion
// that creates no volume; mesh, contact, effects, bodies, loads and books are the same.
//
//   begin    remesh at t_n, fill and factor the pressure matrix
//   solve    repair, predict, pressure, correct, for given wall velocities; repeatable
//   taken    what of it the water takes in
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/leapfrog.hpp"
#include "core/response.hpp"
#include "core/status.hpp"
#include "fluid/pfem/parallel.hpp"
#include "fluid/pfem/pressure/compression.hpp"
#include "fluid/pfem/pressure/pressure.hpp"
#include "fluid/pfem/step/trial.hpp"
#include "fluid/pfem/step_result.hpp"
#include "fluid/pfem/water/water.hpp"

namespace splashdown::fluid {

/// Why a step is refused, and the node that it is for: a fragment of the water that could fly on by itself; -1: none.
struct Refusal {
  Status status;
  int node = -1;
};

/// By an impulse, over the energies in it: what its truncation and their lumping may feign.
inline constexpr double most_gain = 0.05;
/// Tolerances of iterative solves. Each pass of the repair and of the corrections leaves a tenth of the residual anyhow;
/// the pressure solve takes out what the repair leaves of the flux, the corrections what the pressure solve leaves.
inline constexpr double closely = 1e-4, roughly = 1e-2;

/// One step at a time, on the water it was made for, which must outlive it.
template <int d>
class WaterStep {
 public:
  /// `on_surface`: which nodes of the free surface have a pressure of their own.
  explicit WaterStep(Water<d>& water, SurfaceUnknowns on_surface = SurfaceUnknowns::without_spikes)
      : water_(water), equation_(on_surface) {}
  virtual ~WaterStep() = default;
  WaterStep(const WaterStep&) = delete;
  WaterStep& operator=(const WaterStep&) = delete;

  /// Fixes `kick` and `dt` [s] and how walls answer. Refused where the pressure matrix cannot be factored.
  Status begin(double kick, double dt, const InterfaceModel& structure);
  /// One solve of the begun step (Fluid::solve).
  StepResult<d> solve(std::span<const WallVelocity<d>> given, std::span<const double> previous,
                      const ClosedContacts& contacts);
  /// The first reason for which what was found last may not be committed.
  Refusal refusal(const StepResult<d>& found) const;
  /// What was found last is taken: effects move on, and this is what the water takes in. `found` must outlive it.
  Motion<d> taken(const StepResult<d>& found);

  PressureEquation<d>& equation() { return equation_; }              ///< of the begun step
  const PressureEquation<d>& equation() const { return equation_; }  ///< of the begun step
  /// First guess of the impulses: kick times the pressure that nodes carry [Pa s].
  std::vector<double> carried_impulse() const;
  /// At t_n, from velocities at t_{n-1/2} and t_{n+1/2}.
  Vec<d> at_t_n(const Vec<d>& before, const Vec<d>& after) const {
    return velocity_at_t_n(before, after, water_.work.dt, dt_);
  }

 protected:
  // What formulations differ in.
  /// Makes the carried velocity, seen at t_{n-1/2} on the new mesh, create no volume.
  virtual Status repair() = 0;
  /// Corrects impulses by the pressure matrix for what nodes and walls really do.
  virtual Status correct(std::span<const double> previous) = 0;
  /// Where in the step from t_n to t_{n+1} the motion creates no volume: 1/2 in its middle, 1 at its end.
  virtual double judged_at() const { return 0.5; }
  /// Whether effects that may be solved for with the pressure are: `correct` then lets them follow it.
  virtual bool solves_all() const { return false; }
  /// How terms that are solved implicitly go through a kick.
  virtual InTime in_time() const { return InTime::euler; }

  /// What a repair starts from.
  struct Unrepaired {
    std::vector<WallVelocity<d>> s;  ///< of walls
    std::vector<Vec<d>> free;        ///< of nodes, as if no wall held them
    Eigen::VectorXd answer;          ///< of modes
    double energy = 0;               ///< of the liquid [J]
    double drops = 0;                ///< of the spray [J]
  };
  /// The carried velocities, before any repair.
  Unrepaired begin_repair();
  /// The volume that they create on the way back to t_{n-1/2}: of unknowns [m^d/s]. `impulses`: of the repair, that have made
  /// them; a compressible liquid gives way to them. `seen`: whose velocities tell where that was; none: their own.
  void flux_before(std::vector<double>& residual, std::span<const double> impulses = {},
                   const Unrepaired* seen = nullptr);
  /// Takes in impulses of the repair that have made `free` of `from.free` and handed impulses to walls, as far as they bring no
  /// energy; `from` is then what a further one starts from.
  void take_repair(Unrepaired& from, std::vector<double>& impulses, std::vector<Vec<d>>& free,
                   std::span<const WallImpulse<d>> handed);

  /// The motion that the impulses found so far give the nodes. False: an effect could not follow.
  bool move_nodes();
  /// There are effects that are solved for with the pressure.
  bool has_followers() const { return !trial_.following.change.empty(); }
  /// Lets bodies answer exactly to what effects that follow have given them last.
  void settle_bodies();
  /// What the impulses found so far change in velocities, of nodes and without effects that follow.
  std::vector<Vec<d>> pushed() const;
  /// The volume that this motion creates: of unknowns [m^d/s].
  void what_is_left(std::span<const double> previous, std::vector<double>& residual);
  /// What its residual asks for, by the pressure matrix and the bodies in it.
  Status ask(Correction<d>& left);
  /// Adds to a correction what its residual asks for where viscosity, not inertia, resists.
  void add_viscous_part(Correction<d>& left) const;
  /// Adds a share of a correction to impulses and walls.
  void apply(const Correction<d>& correction, double share);
  /// Lets the modes answer to impulses: changes both arguments.
  void answer_to(std::vector<double>& impulses, std::vector<WallVelocity<d>>& s, const Eigen::VectorXd& further);
  /// Work of impulses on walls that change their velocities from s_0 to s_1 [J].
  double work_of(std::span<const double> impulses, std::span<const WallVelocity<d>> s_0,
                 std::span<const WallVelocity<d>> s_1) const;
  /// Kinetic energy of the spray [J].
  double energy_of_drops(std::span<const Vec<d>> v) const;
  /// Sets x_mid: where nodes are after `by` [s] with velocities u.
  void middle(std::span<const Vec<d>> u, double by) {
    in_parallel(u.size(), [&](std::size_t i) { trial_.x_mid[i] = water_.work.nodes.x[i] + by * u[i]; });
  }

  Water<d>& water_;
  double kick_ = 0, dt_ = 0;
  PressureEquation<d> equation_;
  std::optional<WallMotion<d>> wall_motion_;
  Trial<d> trial_;
  PressureTerms terms_;  ///< of effects, in the begun step
  Compression compression_;

 private:
  bool in_equilibrium_ = false;
  /// What effects see of the begun step.
  StepView<d> view(const ModalInertia* answers = nullptr) const {
    return {.nodes = water_.work.nodes,
            .mesh = water_.work.mesh,
            .density = water_.spec.density,
            .kick = kick_,
            .t = water_.work.time,
            .dt = dt_,
            .dt_before = water_.work.dt,
            .lumped_volume = equation_.lumped_mass(),
            .around = equation_.around(),
            .walls = water_.spec.walls,
            .poses = water_.work.poses,
            .layout = water_.layout,
            .answers = answers,
            .in_time = in_time()};
  }

  /// Repair, prediction, pressure and correction, in this order.
  Status find_motion(std::span<const WallVelocity<d>> given, std::span<const double> previous,
                     const ClosedContacts& contacts);
  /// Takes what would open or close closed contacts out of the bodies' answer to the repair.
  void restrict_repair(const ClosedContacts& contacts);
  /// Lets effects that are solved for with the pressure follow it: changes v_after and the impulses on walls.
  bool follow();
  /// Adds the effects' changes of velocity and impulses on walls.
  Status predict(const ClosedContacts& contacts);
  /// Impulses with which the motion to t_{n+1} creates no volume, by the pressure matrix.
  Status solve_pressure(std::span<const WallVelocity<d>> given, std::span<const double> previous);
  /// Effects' terms of the pressure equation.
  Status add_pressure_terms();
  /// In its first step a compressible liquid is, or is not, in equilibrium: nothing else happens to other liquids and steps.
  Status set_equilibrium(bool on);
  /// What the repair has made of the compression goes on in the pressure.
  Status carry_compression();
  /// Damps what compresses nodes otherwise than their neighbours.
  void damp_compression();
  /// Takes in a pressure on the free surface: continued into the water, what the pressure equation finds is the rest.
  void push_surface();
  /// What effects' terms make of the volume of nodes in the step; empty: nothing [m^d].
  std::vector<double> meant_volumes() const;
  /// The interface Laplacian on the change of impulses since the previous pass.
  void lag(std::vector<double>& residual, std::span<const double> previous, std::span<const double> present) const;
  /// A further impulse on the modes.
  void apply_body_impulse(const Eigen::VectorXd& impulse);
  /// Water and bodies answer to an impulse on the modes.
  void let_bodies_answer(const Eigen::VectorXd& impulse);

  // What the solution amounts to (evaluation.cpp).
  /// Loads, pressures and energies of the solution.
  void evaluate(StepResult<d>& found);
  /// Loads on walls, means over the kick.
  void evaluate_loads(StepResult<d>& found) const;
  /// Pressures at nodes [Pa].
  void evaluate_pressure(StepResult<d>& found) const;
  /// Energies at t_n [J].
  void evaluate_energies(StepResult<d>& found) const;
  /// Powers of the effects that book their work, means over the kick [W].
  void evaluate_work(StepResult<d>& found) const;

  // What a step may not do (acceptance.cpp).
  /// Refuses results that are not finite.
  Status finite(const StepResult<d>& found) const;
  /// Refuses elements that turn over.
  Refusal inverted_element(const StepResult<d>& found) const;
  /// Refuses more kinetic energy than impulses and walls have brought.
  Refusal energy_from_nowhere(const StepResult<d>& found) const;
  /// Whether the node is of the free surface and on no wall.
  bool may_fly_alone(int node) const { return water_.work.nodes.surface[node] && water_.work.nodes.tie[node].wall < 0; }
};

extern template class WaterStep<2>;
extern template class WaterStep<3>;

}  // namespace splashdown::fluid
