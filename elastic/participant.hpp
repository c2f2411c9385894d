// Elastic bodies as a part of a coupling. A body with a wall has the velocities of the vertices of its surface as coordinates,
// vertex by vertex, world frame; its placement are the places of these vertices. It is stepped as walls/wall.hpp says. A body
// without one meets no fluid: its coordinates are none, and it takes the step with its own scheme, from t_n to t_{n+1}.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/solids_view.hpp"
#include "coupling/participant.hpp"
#include "elastic/goals/goals.hpp"
#include "elastic/steps/scheme.hpp"
#include "elastic/walls/wall.hpp"

namespace splashdown::elastic {

/// What is looked at in a point: a vector, or Green's strain.
enum class PointSignal { displacement, velocity, acceleration, strain };

/// A point of the solid that is looked at.
template <int d>
struct NamedPlace {
  std::string name;
  Place<d> place;
  std::vector<PointSignal> signals = {PointSignal::displacement};
};

/// The exact term's coordinates of a body that a fluid presses on.
struct WallChoice {
  int modes = 0;           ///< the lowest natural modes, rigid ones of free bodies among them; 0: all nodes
  bool all_nodes = false;  ///< move, with modes too: the exact term has the modes, passes bring the rest
};

/// An elastic body, its loads and how it is stepped.
template <int d>
struct SolidSpec {
  BodySpec<d> body;                 ///< its pose and velocity are those of the undeformed body at t = 0
  std::unique_ptr<Solid<d>> solid;  ///< in the world frame at t = 0, with its clamps and point masses
  std::function<std::unique_ptr<Scheme>(Dynamics)> scheme;
  Rayleigh damping = {};
  double unresolved = 0;                     ///< of walls: Dynamics::unresolved
  Vec<d> gravity = Vec<d>::Zero();           ///< [m/s^2]
  std::function<Field(double)> forces = {};  ///< on nodes besides the weight, at a time [N, N/m]; empty: none
  std::function<Field(double)> drive = {};  ///< velocities of held nodes (Dynamics); of bodies with a wall; empty: none
  std::vector<std::string> parts = {};      ///< names of the solid's materials behind the first
  std::vector<NamedPlace<d>> points = {};
  std::vector<SolidGoal<d>> goals = {};  ///< whose errors are asked for; displacements: of equilibria
  /// `forces` as other meshes of the body have them; empty: there are none.
  std::function<Field(const Solid<d>&, double)> forces_on = {};
  bool from_equilibrium = false;  ///< begins in equilibrium with the loads of t = 0, else undeformed; not with a wall
  std::optional<WallChoice> wall = {};  ///< how it meets a fluid, without `scheme`; empty: not at all
};

/// Elastic bodies, each by itself.
template <int d>
class Participant final : public coupling::StructurePart, public SolidsView<d> {
 public:
  /// At t = 0. Throws std::invalid_argument for bodies without mass, and where there is no equilibrium to begin with.
  explicit Participant(std::vector<SolidSpec<d>> specs);

  double time() const override { return time_; }
  double stable_dt() const override;
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;

  std::string name() const override { return "elastic"; }
  const std::vector<coupling::WallCoordinates>& walls() const override { return walls_; }
  const Eigen::VectorXd& scales() const override { return scales_; }
  double length() const override;
  Eigen::VectorXd speeds(const coupling::Velocities& velocities) const override;
  coupling::Velocities velocities() const override;
  void begin(const coupling::Step& step) override;
  coupling::Response response() const override;
  const coupling::Velocities& solve(const coupling::Impulse& impulse) override;
  const coupling::Velocities& adopt(const coupling::Velocities& velocities) override;
  /// A body that is not linear has another free velocity where an impulse bends it.
  bool update_contacts(const coupling::Impulse& impulse) override;
  coupling::Placement placement() const override;
  coupling::Status acceptable() const override;
  void commit() override;

  std::size_t size() const override { return bodies_.size(); }
  const BodySpec<d>& spec(std::size_t body) const override { return bodies_.at(body).spec.body; }
  const BodyState<d>& state(std::size_t body) const override { return bodies_.at(body).state; }
  const Twist<d>& velocity_n(std::size_t body) const override { return bodies_.at(body).state.velocity; }
  const Twist<d>& acceleration_n(std::size_t body) const override { return bodies_.at(body).acceleration; }
  Deformation<d> deformation(std::size_t body) const override;
  DeformedSurface<d> deformed(std::size_t body) const override;
  std::vector<Diagnostic> signals() const override;
  std::vector<GoalValue> goals() const override;
  /// The surface of a body with a wall at t = 0, world frame: a wall of the fluid has the same. Throws std::out_of_range.
  const Surface<d>& surface(std::size_t body) const { return bodies_.at(body).wall->boundary().surface; }
  /// Of all nodes of a body at t_n: their velocities just before the kick of t_n, accelerations of the step before, if it has
  /// a wall.
  const SolidState& motion(std::size_t body) const { return bodies_.at(body).now; }
  /// Momentum of a body at t_n, just before the kick of t_n if it has a wall.
  Momenta<d> momenta(std::size_t body) const;
  /// U + p.v/2 of a body at t_n, just before the kick of t_n if it has a wall: what its equations keep between kicks [J, J/m].
  double energy(std::size_t body) const;
  /// Newton iterations of all steps so far.
  long iterations() const;

 private:
  struct Moving {
    SolidSpec<d> spec;
    std::unique_ptr<Scheme> scheme = nullptr;
    std::unique_ptr<ElasticWall<d>> wall = nullptr;
    Eigen::Index first = 0, count = 0;  // of its coordinates
    SolidState now = {}, next = {};
    BodyState<d> state = {};
    Twist<d> acceleration = Twist<d>::Zero();
  };
  void start(Moving& body);
  /// Puts a body where its loads of t = 0 hold it.
  void settle(Moving& body, const Dynamics& dynamics);
  void look(Moving& body) const;
  /// Each wall of the trial.
  template <class Each>
  const coupling::Velocities& try_walls(const Each& each);

  std::vector<Moving> bodies_;
  std::vector<coupling::WallCoordinates> walls_;
  Eigen::VectorXd scales_;
  coupling::Velocities trial_;
  coupling::Status status_;
  double time_ = 0, dt_ = 0;
};

extern template class Participant<2>;
extern template class Participant<3>;

}  // namespace splashdown::elastic
