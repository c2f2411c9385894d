// Inviscid or viscous incompressible fluid with a free surface by the particle finite element method.
//
//   rho Dv/Dt + grad p = rho g + ...,   div v = 0,   p = 0 on the free surface,   v.n = w.n on walls
//
// Linear simplices, fractional step. Leapfrog in time: velocities live at half steps,
// positions at whole ones; the pressure impulse phi = kick * p makes the motion from x_n to x_{n+1}
// volume preserving on the mesh of t_n (SHAKE, Ryckaert, Ciccotti, Berendsen 1977, applied to volumes), but for
// what three corrections leave and for the nodes that fly; both are booked in the ledger as time integration.
// Second order in time. docs/theory.md derives it; docs/validation.md measures it.
//
//   begin    remesh at t_n, fill and factor the pressure matrix
//   solve    predict, repair, pressure, correct, for given wall velocities; repeatable
//   commit   move the nodes, t_n <- t_{n+1}
#pragma once

#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fluid/effects/term.hpp"
#include "fluid/mesh/mesh.hpp"
#include "fluid/nodes.hpp"
#include "fluid/pressure/pressure.hpp"
#include "fluid/spec.hpp"
#include "fluid/status.hpp"

namespace splashdown::fluid {

template <int d>
struct WallLoad {
  Wrench<d> physical = Wrench<d>::Zero();  ///< mean over the kick: acceleration pressure, stresses of effects
  Wrench<d> repair = Wrench<d>::Zero();    ///< mean over the kick, from the repair impulse
  double wetted = 0;                       ///< wetted length (2D) or area (3D) [m, m^2]
  Wrench<d> total() const { return physical + repair; }
};

/// Volume and energy book-keeping since t = 0 [m^d, J; per metre of depth in 2D].
struct Ledger {
  double volume_initial = 0, volume = 0;
  double time_integration = 0;  ///< volume change by moving nodes
  double remesh_created = 0;    ///< volume gained when the boundary was recognised anew
  double remesh_deleted = 0;    ///< volume lost there (negative)
  double returned = 0;          ///< volume that came back at the free surface for what these three changed
  double spray = 0;             ///< volume now carried by separated drops
  double kinetic_energy = 0, potential_energy = 0;
  double energy_remesh = 0;  ///< kinetic energy changed by node insertion and removal
  double energy_repair = 0;  ///< kinetic energy taken by repair impulses
  double work_on_walls = 0;  ///< integral of load . wall velocity: to t_n like the energies, after commit to t_{n+1/2}
};

/// How the motions of WallResponse are driven in a step.
struct MotionDrive {
  Eigen::MatrixXd directions;  ///< only these combinations of them may occur; without them and an impulse: all
  Eigen::VectorXd impulse;     ///< on them, besides the fluid's and what the given velocities contain; empty: none
};

template <int d>
class Fluid {
 public:
  Fluid(FluidSpec<d> spec, std::vector<std::unique_ptr<Term<d>>> terms);
  ~Fluid();

  double time() const;       ///< t_n
  double stable_dt() const;  ///< largest dt the criterion allows from t_n

  Status begin(double kick, double dt, const WallResponse<d>& response);
  /// `walls`: half-step velocities of the walls, without the fluid's load in the motions that respond, with it in all
  /// others. `previous`: the interface impulses on which the interface Laplacians lag; one that equals
  /// interface_impulse() afterwards makes them vanish. Needed with such walls only.
  Status solve(std::span<const Twist<d>> walls, std::span<const double> previous = {}, const MotionDrive& drive = {});
  /// Whether the last solve may be committed. Passes of a coupling may be wild on their way; the last may not.
  Status verdict() const;
  /// Mean physical pressure impulses on the pieces of walls with an interface Laplacian [Pa s]. After `begin` the
  /// first guess, after `solve` its result.
  std::span<const double> interface_impulse() const;
  std::span<const InterfacePiece> interface_pieces() const;  ///< of the begun step
  std::span<const WallLoad<d>> loads() const;                ///< of the last solve
  std::span<const Twist<d>> wall_velocities() const;         ///< half-step velocities the last solve ended with
  /// Instantaneous added mass G = B A^-1 B^T of some walls together at t_n [kg, kg m, kg m^2; 2D: per metre]: world
  /// frame, about the walls' reference points, d(d+1)/2 rows a wall. From `begin` to `commit`.
  Eigen::MatrixXd added_mass(std::span<const std::size_t> walls) const;
  /// Slope of `solve`, corrections apart: impulses on these walls and interface impulses, one below the other, by the
  /// walls' twists and the previous interface impulses. From `begin` to `commit`.
  Eigen::MatrixXd interface_slope(std::span<const std::size_t> walls) const;
  /// Velocities that impulses left unbalanced in the motions would still give to bodies and water: what the last
  /// solve fell short of Newton's law, Z (M + G)^-1 (Z^T impulses - M y).
  std::span<const Twist<d>> imbalance() const;
  /// Accepts the last solve. `poses`: of the walls at t_{n+1}.
  void commit(std::span<const Isometry<d>> poses);

  const FluidSpec<d>& spec() const;
  const Nodes<d>& nodes() const;
  const Mesh<d>& mesh() const;
  const Ledger& ledger() const;
  std::span<const Isometry<d>> wall_poses() const;  ///< at t_n
  /// Velocity at t_n: mean of the half-step velocities around it.
  Vec<d> velocity_n(std::size_t node) const;
  /// Pressure at a point at t_n; nothing where there is no fluid.
  std::optional<double> pressure_at(const Vec<d>& point) const;
  const std::vector<std::unique_ptr<Term<d>>>& terms() const;
  /// Seconds spent so far per phase (mesh, assemble, momentum, pressure, move) and, by its name, per effect.
  std::vector<std::pair<std::string, double>> phase_seconds() const;

  void save(std::ostream& out) const;  ///< bit-exact state at t_n
  void load(std::istream& in);

 private:
  struct State;
  std::unique_ptr<State> s_;
};

extern template class Fluid<2>;
extern template class Fluid<3>;

}  // namespace splashdown::fluid
