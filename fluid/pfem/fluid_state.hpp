// What a fluid holds and what a step of it works with. For acceptance.cpp, fluid.cpp, fluid_checkpoint.cpp, prepare.cpp and
// solve.cpp alone.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/leapfrog.hpp"
#include "fluid/pfem/contact/wall_motion.hpp"
#include "fluid/pfem/fluid.hpp"
#include "fluid/pfem/mesh/adapt/adapt.hpp"
#include "fluid/pfem/mesh/conservation/displaced_volume.hpp"
#include "fluid/pfem/mesh/conservation/free_water.hpp"
#include "fluid/pfem/mesh/delaunay/moving_delaunay.hpp"
#include "fluid/pfem/mesh/recognition/recognise.hpp"
#include "fluid/pfem/parallel.hpp"
#include "fluid/pfem/pressure/pressure.hpp"
#include "fluid/pfem/timer.hpp"

namespace splashdown::fluid {

/// Phases by their number in the timer; effects come after.
enum Phase : std::size_t { remesh, assemble, momentum, pressure, motion, first_effect };  ///< the others follow

/// What a checkpoint holds: everything at t_n that the next step is computed from.
template <int d>
struct Present {
  double time = 0, dt = 0;  ///< dt: of the step that led here
  Nodes<d> nodes;
  Mesh<d> mesh;
  std::vector<Isometry<d>> poses;
  std::vector<Twist<d>> velocity;  ///< of walls, at t_{n-1/2}
  std::vector<double> wetted;
  std::vector<double> chords;                 ///< by which hulls hold more than when the water closed around them
  std::vector<DisplacedVolume<d>> displaced;  ///< of walls, in this mesh; not in a checkpoint: it follows from the mesh
  double acceleration_dt = std::numeric_limits<double>::infinity();
  std::vector<Wrench<d>> resting_loads;  ///< on walls, of water that waits; empty: it does not
  Ledger ledger;
};

/// What a residual asks for: impulses A^-1 r, and how walls answer to them.
template <int d>
struct Correction {
  std::vector<double> residual, impulse;
  std::vector<Twist<d>> walls;
  Eigen::VectorXd answer;

  /// r^T A^-1 r'
  double dot(const Correction& other) const { return of(residual).dot(of(other.impulse)); }
  /// Adds a share of another one.
  void add(double share, const Correction& other) {
    of(residual) += share * of(other.residual);
    of(impulse) += share * of(other.impulse);
    for (std::size_t w = 0; w < walls.size(); ++w) walls[w] += share * other.walls[w];
    answer += share * other.answer;
  }

 private:
  static auto of(const std::vector<double>& v) {
    return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
  }
  static auto of(std::vector<double>& v) {
    return Eigen::Map<Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
  }
};

/// What one solve works with.
template <int d>
struct Trial {
  std::vector<Vec<d>> v;                         ///< of nodes, before the pressure
  typename FreeWater<d>::Moments free_water;     ///< what it has before the pressure
  std::vector<Twist<d>> s_before;                ///< of walls, repaired
  std::vector<Twist<d>> s_unloaded;              ///< of walls, before the pressure
  std::vector<Vec<d>> x_mid;                     ///< where a motion is judged
  std::vector<double> r, repaired;               ///< residual, repair impulse
  std::vector<Wrench<d>> on_walls;               ///< impulses of effects
  std::vector<double> of_surface;                ///< impulses of a pressure on the surface, of nodes; empty: none
  std::vector<Wrench<d>> handed, repair_handed;  ///< impulses of held nodes: physical, of the repair
  Eigen::VectorXd known, answer;                 ///< impulses on the motions besides the pressure's, and what they did
  Eigen::VectorXd unanswered;                    ///< impulses that the motions have yet to answer
  double energy_before = 0, energy_repaired = 0,
         energy_unloaded = 0;            ///< of v: as carried, repaired, before the pressure
  std::vector<double> phi, uncorrected;  ///< physical impulse, with and without the corrections
  std::vector<Vec<d>> v_after;           ///< of nodes, with the pressure
  std::vector<Twist<d>> s_after;         ///< of walls
  typename WallMotion<d>::Moved moved;   ///< along the walls
  /// What an effect whose work is booked has changed in a kick.
  struct Booked {
    std::size_t effect;
    std::vector<Vec<d>> change;       ///< of velocities of nodes
    std::vector<Wrench<d>> on_walls;  ///< impulse
  };
  std::vector<Booked> booked;
};

/// Why a step is refused, and the node that it is for: a fragment of the water that could fly on by itself; -1: none.
struct Refusal {
  Status status;
  int node = -1;
};

/// By an impulse, over the energies in it: what its truncation and their lumping may feign.
inline constexpr double most_gain = 0.05;

/// Edges that are short enough to be merged, or lie across a film, limit no time step.
template <int d>
double squared_length(const Present<d>& at, int i, int j) {
  const double short_edge = merge_below * std::min(at.nodes.h[i], at.nodes.h[j]);
  return std::max((at.nodes.x[i] - at.nodes.x[j]).squaredNorm(), short_edge * short_edge);
}

/// The state behind Fluid.
template <int d>
struct Fluid<d>::State {
  FluidSpec<d> spec;
  std::vector<std::unique_ptr<Effect<d>>> effects;
  std::vector<Wall<d>> walls;
  PhaseTimer timer{{"mesh", "assemble", "momentum", "pressure", "move"}};

  Present<d> now;         ///< committed
  Present<d> work;        ///< now, remeshed
  bool prepared = false;  ///< work belongs to now
  MovingDelaunay<d> triangulation;
  FreeWater<d> free_water;                      ///< of the mesh of work
  typename FreeWater<d>::Moments free_carried;  ///< by it into the step
  FlatCells<d> flat_cells;                      ///< in the mesh of work (Recognised)

  double kick = 0, dt = 0;
  PressureEquation<d> equation;
  std::optional<WallMotion<d>> wall_motion;
  Trial<d> trial;
  StepResult<d> result;  ///< of the last solve
  PressureTerms terms;   ///< of effects, in the begun step
  bool solved = false;   ///< it is of the begun step

  /// The plane of symmetry that ends the fluid, if there is one.
  std::optional<Mirror> mirror() const {
    const auto with = std::ranges::find_if(spec.walls, [](const WallSpec<d>& wall) { return wall.mirror.has_value(); });
    return with == spec.walls.end() ? std::nullopt : with->mirror;
  }
  /// The walls at these poses.
  WallsAt<d> walls_at(const std::vector<Isometry<d>>& poses) const { return {walls, poses}; }

  /// Reference points of the walls, world frame [m].
  std::vector<Vec<d>> centres(const std::vector<Isometry<d>>& poses) const {
    std::vector<Vec<d>> c;
    for (const auto& p : poses) c.push_back(p.translation());
    return c;
  }

  /// Poses of the walls after `by` [s] with twists s, from those of `work`.
  std::vector<Isometry<d>> moved_poses(std::span<const Twist<d>> s, double by) const {
    std::vector<Isometry<d>> out;
    for (std::size_t w = 0; w < walls.size(); ++w) out.push_back(fluid::moved<d>(work.poses[w], s[w], by));
    return out;
  }

  /// What effects see of the begun step.
  StepView<d> view(const ModalInertia* answers = nullptr) const {
    return {.nodes = work.nodes,
            .mesh = work.mesh,
            .density = spec.density,
            .kick = kick,
            .t = work.time,
            .dt = dt,
            .dt_before = work.dt,
            .lumped_volume = equation.lumped_volume(),
            .around = equation.around(),
            .walls = spec.walls,
            .poses = work.poses,
            .answers = answers};
  }

  // The mesh of a step (prepare.cpp).
  /// Remeshes `now` into `work`.
  void prepare();
  /// Gives nodes the energy that the field has around them; that of all water [J].
  double hold_field_energy();
  /// Sets h of nodes from the size field.
  void size_nodes();
  /// Joins drops that touch, and drops in the liquid with it.
  void collect_drops();
  /// Nodes of cells first, in 3D along a space-filling curve; how many they are.
  std::size_t put_drops_last();
  /// The cells of the water. `liquid`: nodes that may be their corners, the first ones.
  void cut(std::size_t liquid);
  /// What nodes of a new mesh carry, and what its volume has changed by.
  void settle(double before);
  /// A node for which no step is short enough leaves the begun step's mesh as a drop.
  void let_fragment_fly(int node);
  /// Whether effects leave momentum of an element's size alone within a step.
  bool is_inviscid(int node) const;
  /// Whether a contact line at this node stays within a quarter of `length` [m], its distance from a corner of its wall,
  /// for a step and for sqrt(h/g).
  bool rests_on_wall(int node, double length) const;
  /// Books volume and momentum of nodes that leave the mesh or come back to it.
  void book_spray(const std::vector<char>& was_spray);
  /// What nodes that go have carried passes to a neighbour that stays.
  void hand_over(const std::vector<char>& goes, const std::vector<std::array<int, d + 1>>& cells);
  /// What all effects give to all water alike [m/s^2].
  Vec<d> gravity() const;

  // Hulls in the midst of the water (sunken.cpp).
  /// Books what the facets of sunken hulls enclose more or less at `poses`, in volume and potential energy.
  void follow_hulls(std::span<const Isometry<d>> poses);
  /// Volume of the mesh and of the chords of sunken hulls [m^d].
  double water() const { return enclosed_volume(work.mesh.boundary, work.nodes.x) + work.ledger.hull_chords; }

  // The motion over it (solve.cpp).
  /// One solve of the begun step (Fluid::solve).
  StepResult<d> solve(std::span<const Twist<d>> given, std::span<const double> previous,
                      const ClosedContacts& contacts);
  /// Repair, prediction, pressure and correction, in this order.
  Status find_motion(std::span<const Twist<d>> given, std::span<const double> previous, const ClosedContacts& contacts);
  /// Makes the carried velocity, seen at t_{n-1/2} on the new mesh, create no volume.
  Status repair();
  /// Takes what would open or close closed contacts out of the bodies' answer to the repair.
  void restrict_repair(const ClosedContacts& contacts);
  /// Adds the effects' changes of velocity and impulses on walls.
  Status predict(const ClosedContacts& contacts);
  /// Impulses with which the motion to t_{n+1} creates no volume, by the pressure matrix.
  Status solve_pressure(std::span<const Twist<d>> given, std::span<const double> previous);
  /// Corrects them for what nodes and walls really do, by conjugate residuals.
  Status correct(std::span<const double> previous);
  /// The motion that the impulses found so far give the nodes.
  void move_nodes();
  /// The volume that this motion creates, and what it asks for.
  Status what_is_left(std::span<const double> previous, Correction<d>& left);
  /// Effects' terms of the pressure equation.
  Status add_pressure_terms();
  /// Takes in a pressure on the free surface: continued into the water, what the pressure equation finds is the rest.
  void push_surface();
  /// Tells nodes what effects' terms make of their volume in the step; its sum [m^d].
  double book_sources();
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
  /// The interface Laplacian on the change of impulses since the previous pass.
  void lag(std::vector<double>& residual, std::span<const double> previous, std::span<const double> present) const;
  /// A further impulse on the modes.
  void apply_body_impulse(const Eigen::VectorXd& impulse);
  /// Water and bodies answer to an impulse on the modes.
  void let_bodies_answer(const Eigen::VectorXd& impulse);
  /// Adds a share of a correction to impulses and walls.
  void apply(const Correction<d>& correction, double share);
  /// Lets the modes answer to impulses: changes both arguments.
  void answer_to(std::vector<double>& impulses, std::vector<Twist<d>>& s, const Eigen::VectorXd& further);
  /// At t_n, from velocities at t_{n-1/2} and t_{n+1/2}.
  Vec<d> at_t_n(const Vec<d>& before, const Vec<d>& after) const { return velocity_at_t_n(before, after, work.dt, dt); }
  /// Kinetic energy of the spray [J].
  double energy_of_drops(std::span<const Vec<d>> v) const;
  /// Work of impulses on walls that change their velocities from s_0 to s_1 [J].
  double work_of(std::span<const double> impulses, std::span<const Twist<d>> s_0, std::span<const Twist<d>> s_1) const;
  /// First guess of the impulses: kick times the pressure that nodes carry [Pa s].
  std::vector<double> carried_impulse() const;
  /// Sets x_mid: where nodes are after `by` [s] with velocities u.
  void middle(std::span<const Vec<d>> u, double by) {
    in_parallel(u.size(), [&](std::size_t i) { trial.x_mid[i] = work.nodes.x[i] + by * u[i]; });
  }

  // What a step may not do (acceptance.cpp).
  /// Refuses results that are not finite.
  Status finite(const StepResult<d>& found) const;
  /// The first reason for which the last solve may not be committed.
  Refusal refusal() const;
  /// Refuses elements that turn over.
  Refusal inverted_element() const;
  /// Refuses more kinetic energy than impulses and walls have brought.
  Refusal energy_from_nowhere() const;
  /// Whether the node is of the free surface and on no wall.
  bool may_fly_alone(int node) const { return work.nodes.surface[node] && work.nodes.tie[node].wall < 0; }
};

}  // namespace splashdown::fluid
