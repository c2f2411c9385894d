// A viscous incompressible fluid on a grid, in vorticity (vortex in cell), with rigid bodies inside it by penalisation:
//
//   d omega/dt + div(u omega) = nu Laplace omega + curl(f),   u = stream + curl psi,   -Laplace psi = omega
//   f = theta (s - u)/dt
//
// A step from t_{n-1/2} to t_{n+1/2} (the structure's clock): half of the last step's f, advection with u in the
// middle of the step (advection.hpp), the other half, diffusion (diffusion.hpp), one solve for psi (stream_function.hpp),
// the passes that make bodies rigid where they are at t_{n+1/2} (wall.hpp). Morency & Beaugendre, Model. Simul. Eng.
// 2018, 9638430; Coquerelle & Cottet, J. Comput. Phys. 227, 2008. Assumed: plane, laminar, no free surface. Second
// order in the flow, first at sharp bodies.
#pragma once

#include <array>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/status.hpp"
#include "fluid/vortex/penalised/wall.hpp"
#include "fluid/vortex/spec.hpp"
#include "fluid/vortex/wake.hpp"

namespace splashdown::vortex {

/// The flow with its bodies, and how it is looked at.
class GridFlow final : public FluidView<2> {
 public:
  /// Throws std::invalid_argument, with rule and value, for a grid or walls that it cannot have.
  explicit GridFlow(GridFlowSpec spec);

  /// What it was made from.
  const GridFlowSpec& spec() const { return spec_; }
  const NodeField& vorticity() const { return omega_; }  ///< at t_{n-1/2} [1/s]
  double time() const { return time_; }                  ///< t_n [s]
  /// Largest step [s]: no fluid and no hull crosses more than cfl squares, and diffusion stays below a fifth of h^2/nu.
  double stable_dt() const;
  /// Moves the flow to t_{n+1/2} and makes the passes. `answers`: of each wall, whether the fluid moves it. Refused
  /// where particles or hulls cross more than a square, or where a hull leaves the grid.
  Status begin(double kick, double dt, std::span<const char> answers);
  /// Of the begun step, a wall each.
  std::span<const ImpulseLaw> laws() const { return laws_; }
  /// The begun step ends with these twists of the walls [m/s, rad/s]: what is asked from here on is of it.
  void solve(std::span<const Twist<2>> twists);
  /// Accepts it. `poses`: of the walls at t_{n+1}.
  void commit(std::span<const Isometry<2>> poses);
  /// Seconds spent so far in advection, diffusion, Poisson's equation and bodies.
  std::vector<std::pair<std::string, double>> phase_seconds() const;
  void save(std::ostream& out) const;  ///< the state at t_n, bit for bit
  void load(std::istream& in);         ///< throws std::runtime_error for other bytes

  double density() const override { return spec_.density; }
  std::span<const WallSpec<2>> walls() const override { return spec_.walls; }
  std::span<const Isometry<2>> wall_poses() const override { return poses_; }
  std::span<const WallLoad<2>> loads() const override { return loads_; }
  /// Nodes of the grid, row by row, then samples along the hulls, a square apart.
  std::span<const Vec<2>> points() const override { return points_; }
  std::span<const std::array<int, 3>> cells() const override { return cells_; }
  std::span<const Facet<2>> boundary() const override { return boundary_; }
  PointPlace place(std::size_t point) const override;
  std::optional<double> drop_volume(std::size_t) const override { return {}; }
  /// From the momentum equation with what the passes found, when it is asked for: another solve. Zero far away at the
  /// grid's top.
  std::span<const double> pressure() const override;
  std::span<const double> repair_pressure() const override { return {}; }
  const Ledger& ledger() const override { return ledger_; }
  Vec<2> velocity_n(std::size_t point) const override;
  double max_speed() const override;
  /// Bilinear between nodes; nothing in bodies and beyond the grid.
  std::optional<double> pressure_at(const Vec<2>& point) const override;
  /// Of gravity [J/kg].
  double potential(const Vec<2>& point) const override { return -spec_.gravity.dot(point); }
  std::vector<Diagnostic> diagnostics() const override;
  Eigen::MatrixXd added_mass(std::span<const std::size_t> walls) const override;

 private:
  struct Sample {
    Vec<2> at, out;  // in the wall's frame: place, unit normal into the fluid
    int wall;
  };

  void check() const;
  void add_samples();
  void place_samples();
  Vec<2> stream(double time) const { return spec_.stream ? spec_.stream(time) : Vec<2>(Vec<2>::Zero()); }
  bool is_starting() const { return steps_ < 3; }  // without a prediction worth having
  int passes_of(std::size_t wall, bool answers) const;
  void find_answers(double share, std::span<const char> answers);
  void find_answers_together(double share, std::span<const char> answers);
  void pass_together(double share, int passes, std::size_t mover, int mode, std::span<const char> answers);
  Wrench<2> load_by_control_volume(std::size_t wall) const;
  Vec<2> fading(const Vec<2>& stream) const;
  Speeds solve_velocity(const NodeField& omega, double at_time, FaceField& velocity);
  void book(double kick);
  double kinetic_energy(double at_time) const;
  double buoyant_energy() const;
  void solve_pressure() const;
  double node_pressure(const Vec<2>& point) const;
  double filled(const Vec<2>& point) const;

  GridFlowSpec spec_;
  StreamFunction stream_function_;
  Advection advection_;
  Diffusion diffusion_;
  Wake wake_;
  Projections projections_;
  std::vector<PenalisedWall> penalised_;
  // At t_n.
  double time_ = 0, kick_before_ = 0, dt_before_ = 0, speed_ = 0;
  long steps_ = 0;
  std::vector<Isometry<2>> poses_;
  std::vector<Twist<2>> twists_;  // at t_{n-1/2}
  NodeField omega_;
  FaceField velocity_, before_;  // at t_{n-1/2}, t_{n-3/2}
  Ledger ledger_;
  double buoyant_at_start_ = 0;
  // Of the step under way.
  double kick_ = 0, dt_ = 0;
  bool is_begun_ = false;
  NodeField trial_omega_, psi_;
  FaceField trial_velocity_;
  Speeds trial_speeds_;
  std::vector<Twist<2>> trial_twists_;
  std::vector<ImpulseLaw> laws_;
  double ratio_ = 0;  // of its kick to the last one
  std::vector<WallLoad<2>> loads_;
  // To be looked at.
  std::vector<Sample> samples_;
  std::vector<Vec<2>> points_;
  std::vector<std::array<int, 3>> cells_;
  std::vector<Facet<2>> boundary_;
  mutable std::vector<double> pressure_;  // empty: not asked for yet
  double advection_seconds_ = 0, diffusion_seconds_ = 0, poisson_seconds_ = 0, bodies_seconds_ = 0;
};

}  // namespace splashdown::vortex
