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

#include <array>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/fluid_view.hpp"
#include "core/response.hpp"
#include "core/status.hpp"
#include "fluid/effects/effect.hpp"
#include "fluid/pfem/formulations.hpp"
#include "fluid/pfem/pressure/pressure.hpp"
#include "fluid/pfem/spec.hpp"
#include "fluid/pfem/step_result.hpp"

namespace splashdown::fluid {

using splashdown::FluidView;
using splashdown::PointPlace;

/// The fluid and its state. One thread drives it; loops within run on all.
template <int d>
class Fluid final : public FluidView<d> {
 public:
  /// Meshes the liquid at t = 0. Throws std::invalid_argument where walls leave none or its outline is no surface.
  /// `formulation`: what steps it.
  Fluid(FluidSpec<d> spec, std::vector<std::unique_ptr<Effect<d>>> effects,
        const Formulation<d>& formulation = fractional<d>());
  ~Fluid() override;

  double time() const;       ///< t_n
  double stable_dt() const;  ///< largest dt the criterion allows from t_n

  /// Fixes the step: `kick`, over which forces act [s]; `dt`, over which nodes move [s]; `structure`: how the bodies behind
  /// the walls answer, in coordinates of all walls. Remeshes once after each commit, whatever is begun then. Refused where
  /// the pressure matrix cannot be factored.
  Status begin(double kick, double dt, const InterfaceModel& structure);
  /// `walls`: half-step velocities of the walls, without the fluid's load in the motions that respond, with it in all
  /// others. `previous`: the interface impulses on which the interface Laplacians lag; one that equals the result's
  /// makes them vanish. Needed with such walls only: std::invalid_argument for another number. `contacts`: what of the modes may
  /// occur. The state at t_n stays as it is.
  const StepResult<d>& solve(std::span<const WallVelocity<d>> walls, std::span<const double> previous = {},
                             const ClosedContacts& contacts = {});
  /// The same where all walls are rigid: their twists.
  const StepResult<d>& solve(std::span<const Twist<d>> walls, std::span<const double> previous = {},
                             const ClosedContacts& contacts = {});
  const StepResult<d>& result() const;  ///< of the last solve
  std::span<const WallLoad<d>> loads() const override { return result().loads; }
  /// Whether the last solve may be committed. Passes of a coupling may be wild on their way; the last may not.
  Status acceptable() const;
  /// Where the last solve may not be committed for a node at the free surface: lets it fly as a drop, with its volume and
  /// momentum, in the step that is to begin anew. False: it is for nothing of the kind.
  bool release_fragment();
  std::span<const InterfacePiece> interface_pieces() const;  ///< of the begun step
  std::vector<double> carried_interface_impulse() const;     ///< first guess of theirs: the pressure of the last step
  /// Slope of `solve`, corrections apart: impulses on these walls and interface impulses, one below the other, by the
  /// walls' velocities and the previous interface impulses. From `begin` to `commit`.
  Eigen::MatrixXd interface_slope(std::span<const std::size_t> walls) const;
  /// Accepts the last solve. `places`: of the walls at t_{n+1}.
  void commit(std::span<const WallPlace<d>> places);
  /// The same where all walls are rigid: their poses.
  void commit(std::span<const Isometry<d>> poses);

  /// Whether the water is at rest and nothing in it moves it: neither effects nor drops.
  bool is_at_rest() const;
  /// Water at rest from which all walls that move stay away: until it is woken, `wait` takes the place of begin, solve and
  /// commit, and the loads of the last solve stay.
  void set_waiting(bool waits);
  bool is_waiting() const override;  ///< says what was set
  /// t_n <- t_n + dt. `places`, `velocities`: of the walls at t_{n+1} and t_{n+1/2}.
  void wait(double dt, std::span<const WallPlace<d>> places, std::span<const WallVelocity<d>> velocities);

  double density() const override;
  std::span<const WallSpec<d>> walls() const override;
  std::span<const Isometry<d>> wall_poses() const override;
  const AtVertices<d>* wall_vertices(std::size_t wall) const override;
  std::span<const WallPlace<d>> wall_places()
      const;                            ///< at t_n, of the step under way between its begin and its commit
  const WallLayout<d>& layout() const;  ///< of the walls' coordinates
  /// Where walls are of which this is the placement, as a coupling knows it (coupling/participant.hpp); others are where they
  /// were.
  /// std::invalid_argument for numbers that end within a wall.
  std::vector<WallPlace<d>> places_of(const Eigen::VectorXd& placement) const;
  const Nodes<d>& nodes() const;  ///< of the mesh below
  const Mesh<d>& mesh() const;    ///< of t_n
  std::span<const Vec<d>> points() const override;
  std::span<const std::array<int, d + 1>> cells() const override;
  std::span<const Facet<d>> boundary() const override;
  PointPlace place(std::size_t node) const override;
  std::optional<double> drop_volume(std::size_t node) const override;
  std::span<const double> pressure() const override;
  std::span<const double> repair_pressure() const override;
  const Ledger& ledger() const override;
  Vec<d> velocity_n(std::size_t node) const override;
  std::optional<double> pressure_at(const Vec<d>& point) const override;  ///< linear in its cell; O(cells)
  double potential(const Vec<d>& point) const override;
  std::vector<std::pair<std::string, double>> diagnostics() const override;
  Eigen::MatrixXd added_mass(std::span<const std::size_t> walls) const override;  ///< from `begin` to `commit`

  const FluidSpec<d>& spec() const;                                ///< as it was made
  const std::vector<std::unique_ptr<Effect<d>>>& effects() const;  ///< in the order of the scene
  /// Seconds spent so far per phase (mesh, assemble, momentum, pressure, move) and, by its name, per effect.
  std::vector<std::pair<std::string, double>> phase_seconds() const;

  void save(std::ostream& out) const;  ///< bit-exact state at t_n
  void load(std::istream& in);         ///< std::runtime_error for what is none of this scene: the state stays as it was

 private:
  struct State;
  std::unique_ptr<State> s_;
};

extern template class Fluid<2>;
extern template class Fluid<3>;

}  // namespace splashdown::fluid
