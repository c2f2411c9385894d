// An incompressible viscous fluid in a box with bodies in it, on a mesh that moves with them (arbitrary Lagrangian-Eulerian):
// the equations of equations/flow_equations.hpp between the structure's half steps.
//
//   v- at t_{n-1/2}, v+ at t_{n+1/2}, both carried by nodes that are at x_n in the middle; loads are those of t_n
//
// so that walls move by leapfrog with the velocities that the fluid beside them has, and impulses are loads times the kick.
// Newton's method with a factor that is kept across passes and steps while it converges. Second order in time with theta = 1/2,
// third in space. Assumed: plane, laminar, no free surface, gravity a potential (the unknown pressure is without it).
#pragma once

#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/simplices/piece_finder.hpp"
#include "core/status.hpp"
#include "fluid/ale/equations/free_system.hpp"
#include "fluid/ale/mesh/extension.hpp"
#include "fluid/ale/mesh/hull_line.hpp"
#include "fluid/ale/mesh/mesh_quality.hpp"
#include "fluid/ale/mesh/moved_mesh.hpp"
#include "fluid/ale/spec.hpp"

namespace splashdown::ale {

/// The same with `size` of a mesh that was refined so often for its goals (core/goals/refined_size.hpp). Each mesh takes steps
/// of dt until a time, the ramp's end [s]. Throws std::runtime_error where a step fails.
AleFlowSpec adapted(AleFlowSpec spec, int times, double dt, double until);

/// What bodies make of an impulse: amplitudes of modes by the impulse on the walls at amplitudes y. `answered`: what the impulse
/// on the modes loses for each amplitude, nearly.
using NextAmplitudes = std::function<Eigen::VectorXd(const Eigen::MatrixXd& answered, const Eigen::VectorXd& impulse,
                                                     const Eigen::VectorXd& y)>;

/// Quality of the worst cell below which a new mesh is wanted (mesh/mesh_quality.hpp).
constexpr double worn = 0.3;

/// The flow, and how it is looked at.
class AleFlow final : public FluidView<2> {
 public:
  /// Throws std::invalid_argument, with rule and value, for boxes and hulls that cannot be meshed.
  explicit AleFlow(AleFlowSpec spec);

  const AleFlowSpec& spec() const { return spec_; }  ///< what it was made from
  const FlowMesh& mesh() const { return mesh_; }     ///< the newest, as it was made
  long remeshings() const { return remeshings_; }    ///< how often that has been so far
  long missed() const { return missed_; }            ///< new meshes that were wanted and could not be had
  double time() const { return time_; }              ///< t_n [s]
  /// How many coordinates the first so many walls have together.
  Eigen::Index coordinates(std::size_t walls) const;
  /// How many numbers their placements have together.
  Eigen::Index placement_numbers(std::size_t walls) const;
  /// The wall that a coordinate is of comes from its count; throws std::invalid_argument where they end within a wall.
  std::size_t walls_with(Eigen::Index coordinates) const;

  /// Fixes a step of dt in which impulses act over the kick [s]. Refused where its equations are singular.
  Status begin(double kick, double dt);
  /// The begun step ends with these velocities of the first walls' coordinates; all others stand still. `goes_on`: from the last
  /// solve, else from t_n. Refused where Newton's method fails.
  Status solve(const Eigen::VectorXd& velocities, bool goes_on = false);
  /// The same with velocities + modes y, y = next(impulse, y): flow and walls by one Newton's method.
  Status solve(const Eigen::VectorXd& velocities, const Eigen::MatrixXd& modes, const NextAmplitudes& next,
               bool goes_on = false);
  /// y of the last of these solves.
  const Eigen::VectorXd& amplitudes() const { return amplitudes_; }
  /// What the impulse on these modes loses for each amplitude, with what the last solve knew of it.
  Eigen::MatrixXd answered(const Eigen::MatrixXd& modes) const { return modes.transpose() * answers_->impulses; }
  /// Impulses on those coordinates.
  const Eigen::VectorXd& impulse() const { return impulse_; }
  /// Minus the slope of impulses by velocities of the first so many coordinates, of the factor that was used last [kg, ...].
  Eigen::MatrixXd answer(const Eigen::MatrixXd& motions) const;
  /// Whether cells stay unfolded where the walls of the last solve go.
  Status acceptable() const;
  /// Accepts it. `placements`: of the first walls at t_{n+1}; empty: all stay.
  void commit(const Eigen::VectorXd& placements);
  /// Seconds spent so far in each phase.
  std::vector<std::pair<std::string, double>> phase_seconds() const;
  /// Of a steady flow around bodies at rest: the load on a wall along a direction, and how far it is off. Costs the factor of a
  /// mesh of four times as many cells. Throws std::logic_error for other flows, and before the first step.
  GoalError load_goal(std::size_t wall, const Vec<2>& direction) const;
  void save(std::ostream& out) const;  ///< the state at t_n, bit for bit
  void load(std::istream& in);         ///< throws std::runtime_error for other bytes
  /// Of the last solve.
  int iterations() const { return iterations_; }
  /// Factors made so far, of steps that were refused too.
  long factorisations() const { return factorisations_; }
  /// Velocities of nodes at t_{n-1/2} [m/s].
  const Nodes& velocity() const { return state_.velocity; }
  /// Places of nodes at t_n [m].
  const Nodes& places() const { return x_; }

  double density() const override { return spec_.density; }
  std::span<const WallSpec<2>> walls() const override { return spec_.walls; }
  std::span<const Isometry<2>> wall_poses() const override { return poses_; }
  const AtVertices<2>* wall_vertices(std::size_t wall) const override {
    return spec_.walls[wall].deforms ? &vertices_[wall] : nullptr;
  }
  std::span<const WallLoad<2>> loads() const override { return loads_; }
  std::span<const Vec<2>> points() const override { return points_; }
  /// Straight pieces: four of each cell.
  std::span<const std::array<int, 3>> cells() const override { return pieces_; }
  std::span<const Facet<2>> boundary() const override { return boundary_; }
  PointPlace place(std::size_t point) const override;
  std::optional<double> drop_volume(std::size_t) const override { return {}; }
  std::span<const double> pressure() const override;
  std::span<const double> repair_pressure() const override { return {}; }
  const Ledger& ledger() const override { return ledger_; }
  Vec<2> velocity_n(std::size_t point) const override;
  /// Linear on straight pieces; nothing in bodies and beyond the box.
  std::optional<double> pressure_at(const Vec<2>& point) const override;
  /// Of gravity [J/kg].
  double potential(const Vec<2>& point) const override { return -spec_.gravity.dot(point); }
  std::vector<Diagnostic> diagnostics() const override;
  std::vector<GoalValue> goals() const override;
  Eigen::MatrixXd added_mass(std::span<const std::size_t> walls) const override;

 private:
  /// Nodes of a wall and what moves them.
  struct WallInMesh {
    std::vector<int> nodes;
    std::unique_ptr<MovingWall> motion;
    Eigen::Index first = 0, numbers = 0;  // of its coordinates and its placement's numbers among all
  };
  /// What lives at t_n.
  struct State {
    Nodes velocity, before;  // at t_{n-1/2}, t_{n-3/2}
    Eigen::VectorXd pressure;
    std::vector<Eigen::VectorXd> placements, rates;  // of walls at t_n, t_{n-1/2}
    double kick = 0, dt = 0;                         // of the last step
    double fastest = 0;                              // speed so far
    long steps = 0;
  };
  /// How the flow answers motions of walls, by a factor.
  struct Answers {
    Eigen::MatrixXd motions;                          // of coordinates, one a column
    std::vector<Eigen::VectorXd> middle, placements;  // of walls in the step's middle and at t_n
    double kick = 0;
    Eigen::MatrixXd impulses, fields;  // what impulses lose; changes of the unknowns that are not given
    long factor = -1;                  // that they are of
  };
  /// Walls that move with velocities + modes y.
  struct WithModes {
    const Eigen::VectorXd& velocities;
    const Eigen::MatrixXd& modes;
    const NextAmplitudes& next;
  };

  void place_walls(const Nodes& at_start);
  void first_placements();
  void start();
  void look_at_mesh();
  std::unique_ptr<MovingWall> motion_of(std::size_t wall, const Nodes& at_start) const;
  Nodes places_on(const std::vector<Eigen::VectorXd>& placements, std::span<const int> walls,
                  const Nodes& at_start) const;
  void adopt(FlowMesh mesh, const Nodes& at_start, std::vector<Eigen::VectorXd> placements);
  MovedMesh mesh_around(const std::vector<Eigen::VectorXd>& placements) const;
  bool is_mesh_worn() const;
  std::optional<MovedMesh> mesh_now() const;
  void remesh();
  void transfer(const FlowMesh& old, const Nodes& places_then, const Nodes& places_now);
  Nodes projected(const Nodes& places, const std::function<Vec<2>(const Vec<2>&)>& field, double time) const;
  static std::vector<char> given_unknowns(const AleFlowSpec& spec, const FlowMesh& mesh,
                                          const FlowEquations& equations);
  static void give_sides(const AleFlowSpec& spec, const FlowMesh& mesh, const FlowEquations& equations, double time,
                         Unknowns& at);
  Nodes places_of(const std::vector<Eigen::VectorXd>& placements) const;
  Nodes wall_velocities(const std::vector<Eigen::VectorXd>& placements, const Eigen::VectorXd& rates) const;
  Eigen::VectorXd all_rates(const Eigen::VectorXd& of_first) const;
  void move_walls(const Eigen::VectorXd& rates);
  void give(const Nodes& walls, Unknowns& at) const;
  Unknowns guess() const;
  Status newton(const WithModes* bodies);
  bool factor(FactoredSlope& tangent);
  Eigen::VectorXd impulse_of(const Eigen::VectorXd& nodal_loads) const;
  Eigen::VectorXd correct(const WithModes& bodies, const Eigen::VectorXd& residual, Eigen::VectorXd& change);
  void find_answers(const FactoredSlope& tangent, Answers& answers) const;
  const Answers& answers_to(const Eigen::MatrixXd& modes);
  void load_mesh(std::istream& in, double remeshings);
  void load_answers(std::istream& in, double rows, double columns, double kick);
  void find_loads();
  void add_buoyancy(Eigen::VectorXd& loads) const;
  StepFields steady_fields(const Nodes& x) const;
  Vec<2> load_at(const Unknowns& at, std::size_t wall) const;
  double power_through_sides() const;
  double potential_energy(const Nodes& places) const;
  void book_work();
  void book_energy(const Nodes& places_before);
  void look();

  AleFlowSpec spec_;
  std::vector<HullLine> lines_;  // at t = 0
  FlowMesh mesh_;
  FlowEquations equations_;
  std::unique_ptr<Extension> extension_;
  MeshQuality quality_;
  std::vector<Eigen::VectorXd> made_at_;  // placements of walls that the mesh was made around
  long remeshings_ = 0, missed_ = 0;
  double bearable_ = worn;         // quality of the worst cell below which a new mesh is wanted
  int first_size_ = 0;             // nodes of the first mesh
  double momentum_of_remesh_ = 0;  // that new meshes have changed, summed
  std::vector<WallInMesh> moved_;
  std::vector<char> wall_node_;
  std::vector<int> wall_of_;  // of each node, -1: none
  GivenUnknowns given_;
  double time_ = 0;
  State state_;
  Nodes x_;  // at t_n
  Ledger ledger_;
  // Factors: of a step before, of the step under way where that does not suit it, of the last solve where neither converges.
  FactoredSlope kept_, of_step_, of_pass_;
  FactoredSlope *first_ = nullptr, *tangent_ = nullptr;  // that a solve from t_n begins with, that is used
  Answers kept_answers_, step_answers_;                  // of a step before, of the step under way
  const Answers* answers_ = &kept_answers_;              // that are used
  // Of the step under way.
  double kick_ = 0, dt_ = 0;
  bool is_begun_ = false, is_solved_ = false;
  StepFields fields_;
  std::vector<Eigen::VectorXd> middle_;  // placements foreseen at t_{n+1/2}
  Eigen::VectorXd rates_;                // of all walls
  Unknowns at_;
  Eigen::VectorXd reactions_, nodal_loads_, impulse_, amplitudes_;
  int iterations_ = 0;
  long factorisations_ = 0;
  // To be looked at.
  std::vector<Isometry<2>> poses_;
  std::vector<AtVertices<2>> vertices_;  // of walls that deform
  std::vector<WallLoad<2>> loads_;
  std::vector<Vec<2>> points_;
  std::vector<std::array<int, 3>> pieces_;
  std::vector<Facet<2>> boundary_;
  mutable std::vector<double> pressure_;
  mutable PieceFinder finder_;
  mutable bool finds_ = false;
  mutable double mesh_seconds_ = 0;
  double assembly_seconds_ = 0, factor_seconds_ = 0, solve_seconds_ = 0;
};

}  // namespace splashdown::ale
