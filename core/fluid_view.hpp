// What people look at in a fluid: its state at t_n, read only. Records know a fluid by this alone.
//
// It is sampled at numbered points. Most are corners of cells; others may be samples of walls, or drops. Where they come from,
// a mesh that moves or a grid that stays, is the fluid's own matter: a grid gives its squares as triangles, two each.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/diagnostic.hpp"
#include "core/facet.hpp"
#include "core/goals/goal.hpp"
#include "core/mirror.hpp"
#include "core/wall_vector.hpp"

namespace splashdown {

/// A surface that bounds the fluid: a body's hull or the inside of a tank.
template <int d>
struct WallSpec {
  std::string name;  ///< of the scene
  /// Wall frame; encloses the solid. A tank is a surface turned inside out (clockwise outline in 2D).
  Surface<d> surface;
  Isometry<d> pose = Isometry<d>::Identity();  ///< wall frame to world at t = 0
  Twist<d> velocity = Twist<d>::Zero();        ///< of the wall frame's origin, at t = 0
  double size = 0;                             ///< element size at the wall [m]
  bool deforms = false;                        ///< its vertices move each by itself; its frame is the world's
  bool sticks = false;                         ///< no slip: the wall drags viscous fluid along (viscosity.hpp)
  /// The plane of symmetry that ends the fluid, and that the wall reaches across or has a side in; none: nothing is mirrored.
  std::optional<Mirror> mirror = {};
};

/// Load of the fluid on a wall about the wall's reference point, world frame [N, N m; 2D: N/m, N]; of one that deforms about the
/// world's origin.
template <int d>
struct WallLoad {
  Wrench<d> physical = Wrench<d>::Zero();  ///< mean over the kick: acceleration pressure, stresses of effects
  Wrench<d> repair = Wrench<d>::Zero();    ///< mean over the kick, from the repair impulse
  double wetted = 0;                       ///< wetted length (2D) or area (3D) [m, m^2]
  /// physical + repair: all that acts on the wall.
  Wrench<d> total() const { return physical + repair; }
};

/// Volume and energy book-keeping since t = 0 [m^d, J; per metre of depth in 2D]. What a fluid does not do stays zero.
struct Ledger {
  double volume_initial = 0;    ///< at t = 0
  double volume = 0;            ///< at t_n: enclosed by the boundary, with `hull_chords`; spray apart
  double time_integration = 0;  ///< volume change by moving nodes
  double remesh_created = 0;    ///< volume gained when the boundary was recognised anew
  double remesh_deleted = 0;    ///< volume lost there (negative)
  double returned = 0;          ///< volume that came back at the free surface for what these three changed
  double spray = 0;             ///< volume now carried by separated drops
  double hull_chords = 0;       ///< volume that the facets of sunken hulls have taken from the mesh; part of `volume`
  double kinetic_energy = 0;    ///< at t_n, with velocities of t_n
  double potential_energy = 0;  ///< at t_n, the sum over all effects
  double chord_energy = 0;      ///< potential energy of the water in `hull_chords`; part of potential_energy
  double energy_remesh = 0;     ///< kinetic energy changed by node insertion and removal
  double energy_repair = 0;     ///< kinetic energy taken by repair impulses
  double work_on_walls = 0;  ///< integral of load . wall velocity: to t_n like the energies, after commit to t_{n+1/2}
  /// Work of effects on the water, of those that book it (waves that are kept alive, friction of hulls): to t_{n-1/2}.
  double work_of_effects = 0;
  double volume_of_effects = 0;  ///< that effects have brought in, negative: taken away (PressureTerms)
  /// Volume gained or lost against what there should be [m^d].
  double volume_excess() const { return volume + spray - volume_initial - volume_of_effects; }
};

/// Where a point of a fluid lies.
struct PointPlace {
  int wall = -1;                 ///< index of the wall that it lies on, -1: none
  bool at_corner = false;        ///< of that wall's surface
  bool on_free_surface = false;  ///< with a wall: at the contact line
};

/// World frame; of the step under way between its begin and its commit, else of t_n. Spans and numbers of points hold until the
/// fluid is stepped on.
template <int d>
class FluidView {
 public:
  virtual ~FluidView() = default;
  virtual double density() const = 0;                           ///< [kg/m^3]
  virtual std::span<const WallSpec<d>> walls() const = 0;       ///< as they were made
  virtual std::span<const Isometry<d>> wall_poses() const = 0;  ///< at t_n; of those that deform the identity
  /// Of a wall that deforms: its vertices at t_n, world frame [m]. nullptr: it is rigid.
  virtual const AtVertices<d>* wall_vertices(std::size_t /*wall*/) const { return nullptr; }
  /// On the walls in their order: of the step under way once it is solved; before the first one empty or zero.
  virtual std::span<const WallLoad<d>> loads() const = 0;
  /// Whether the fluid stands still while all hulls are far from it, and stay so in the next step.
  virtual bool is_waiting() const { return false; }
  virtual std::span<const Vec<d>> points() const = 0;  ///< at t_n [m]; arrays below are as long
  /// Simplices of numbers of points, positively oriented.
  virtual std::span<const std::array<int, d + 1>> cells() const = 0;
  /// Facets between points, area vectors out of the fluid: wetted walls and the free surface. Ends of a domain that are neither
  /// are not among them.
  virtual std::span<const Facet<d>> boundary() const = 0;
  virtual PointPlace place(std::size_t point) const = 0;  ///< where a point lies
  /// Volume of a drop [m^d], a point by itself in no cell; nothing: the point is none.
  virtual std::optional<double> drop_volume(std::size_t point) const = 0;
  /// At the points at t_n [Pa]: of the step under way once it is solved, before that what they carry.
  virtual std::span<const double> pressure() const = 0;
  /// What the repair impulse is as a mean over the kick of a step that is solved, at the points [Pa]; before that empty, and of
  /// fluids without repair. Walls are loaded by the sum of both: in a true impact this is all there is.
  virtual std::span<const double> repair_pressure() const = 0;
  virtual const Ledger& ledger() const = 0;  ///< to t_n
  /// Velocity of a point at t_n [m/s]; of fluids that know it at half steps the mean of those around (core/leapfrog.hpp).
  virtual Vec<d> velocity_n(std::size_t point) const = 0;
  /// The greatest of all points at t_n [m/s].
  virtual double max_speed() const {
    double squared = 0;
    for (std::size_t point = 0; point < points().size(); ++point)
      squared = std::max(squared, velocity_n(point).squaredNorm());
    return std::sqrt(squared);
  }
  /// Pressure anywhere at t_n [Pa], as the fluid interpolates it; nothing where there is no fluid.
  virtual std::optional<double> pressure_at(const Vec<d>& point) const = 0;
  /// Potential energy per unit mass at a point [J/kg], the sum over all effects.
  virtual double potential(const Vec<d>& point) const = 0;
  /// What effects say about themselves at t_n: EFFECT_NAME and value, always of the same names.
  virtual std::vector<Diagnostic> diagnostics() const = 0;
  /// Loads that it was asked for, with their errors at t_n: costs more than a step.
  virtual std::vector<GoalValue> goals() const { return {}; }
  /// Instantaneous added mass G = B A^-1 B^T of some walls together at t_n [kg, kg m, kg m^2; 2D: per metre]: world
  /// frame, about the walls' reference points, d(d+1)/2 rows a wall. Of a step that is under way.
  virtual Eigen::MatrixXd added_mass(std::span<const std::size_t> walls) const = 0;
};

}  // namespace splashdown
