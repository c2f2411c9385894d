// Elastic bodies as a part of a coupling. They have no walls yet that a fluid could press on: their coordinates are none, and
// nothing but their own loads moves them. Every body takes the step with its own scheme, from t_n to t_{n+1}.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/solids_view.hpp"
#include "coupling/participant.hpp"
#include "elastic/assembly/solid.hpp"
#include "elastic/steps/scheme.hpp"

namespace splashdown::elastic {

/// A point whose displacement is looked at.
template <int d>
struct NamedPlace {
  std::string name;
  Place<d> place;
};

/// An elastic body, its loads and how it is stepped.
template <int d>
struct SolidSpec {
  BodySpec<d> body;                 ///< its pose and velocity are those of the undeformed body at t = 0
  std::unique_ptr<Solid<d>> solid;  ///< in the world frame at t = 0, with its clamps and point masses
  std::function<std::unique_ptr<Scheme>(Dynamics)> scheme;
  Rayleigh damping = {};
  Vec<d> gravity = Vec<d>::Zero();           ///< [m/s^2]
  std::function<Field(double)> forces = {};  ///< on nodes besides the weight, at a time [N, N/m]; empty: none
  std::vector<NamedPlace<d>> points = {};
};

/// Elastic bodies, each by itself.
template <int d>
class Participant final : public coupling::StructurePart, public SolidsView<d> {
 public:
  /// At t = 0. Throws std::invalid_argument for bodies without mass.
  explicit Participant(std::vector<SolidSpec<d>> specs);

  double time() const override { return time_; }
  double stable_dt() const override;
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;

  std::string name() const override { return "elastic"; }
  const std::vector<coupling::WallCoordinates>& walls() const override { return walls_; }
  const Eigen::VectorXd& scales() const override { return none_; }
  double length() const override;
  Eigen::VectorXd speeds(const coupling::Velocities&) const override { return {}; }
  coupling::Velocities velocities() const override { return {}; }
  void begin(const coupling::Step& step) override;
  coupling::Response response() const override { return {}; }
  const coupling::Velocities& solve(const coupling::Impulse& impulse) override;
  const coupling::Velocities& adopt(const coupling::Velocities&) override { return none_; }
  coupling::Placement placement() const override { return {}; }
  coupling::Status acceptable() const override { return status_; }
  void commit() override;

  std::size_t size() const override { return bodies_.size(); }
  const BodySpec<d>& spec(std::size_t body) const override { return bodies_.at(body).spec.body; }
  const BodyState<d>& state(std::size_t body) const override { return bodies_.at(body).state; }
  const Twist<d>& velocity_n(std::size_t body) const override { return bodies_.at(body).state.velocity; }
  const Twist<d>& acceleration_n(std::size_t body) const override { return bodies_.at(body).acceleration; }
  Deformation<d> deformation(std::size_t body) const override;
  std::vector<Diagnostic> displacements() const override;
  /// Newton iterations of all steps so far.
  long iterations() const;

 private:
  struct Moving {
    SolidSpec<d> spec;
    std::unique_ptr<Scheme> scheme = nullptr;
    SolidState now = {}, next = {};
    BodyState<d> state = {};
    Twist<d> acceleration = Twist<d>::Zero();
  };
  void look(Moving& body) const;

  std::vector<Moving> bodies_;
  std::vector<coupling::WallCoordinates> walls_;
  Eigen::VectorXd none_;
  coupling::Status status_;
  double time_ = 0, dt_ = 0;
};

extern template class Participant<2>;
extern template class Participant<3>;

}  // namespace splashdown::elastic
