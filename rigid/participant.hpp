// Rigid bodies as the structure of a coupling: body k is wall k, its coordinates are its twist about the centre of mass
// in the world frame, its placement the first d rows of its pose.
#pragma once

#include <memory>

#include "coupling/participant.hpp"
#include "rigid/bodies.hpp"

namespace splashdown::rigid {

/// Bodies<d> behind the seam: translates between stacked coordinates and twists, wrenches, poses.
template <int d>
class Participant final : public coupling::StructurePart {
 public:
  /// Wall k is body k.
  explicit Participant(std::unique_ptr<Bodies<d>> bodies);
  /// The bodies, to be looked at.
  const Bodies<d>& bodies() const { return *bodies_; }

  double time() const override { return bodies_->time(); }
  /// No body turns by more than half a radian, and what forces ask for.
  double stable_dt() const override;
  void save(std::ostream& out) const override { bodies_->save(out); }
  void load(std::istream& in) override;

  std::string name() const override { return "rigid"; }
  const std::vector<coupling::WallCoordinates>& walls() const override { return walls_; }
  /// 1, and the radius of gyration of bodies that are free.
  const Eigen::VectorXd& scales() const override { return scales_; }
  double length() const override { return length_; }
  /// |V| + |w| times the distance of the farthest vertex.
  Eigen::VectorXd speeds(const coupling::Velocities& velocities) const override;
  coupling::Velocities velocities() const override;

  void begin(const coupling::Step& step) override { bodies_->begin(step.kick, step.dt); }
  coupling::Response response() const override { return bodies_->response(); }
  const coupling::Velocities& solve(const coupling::Impulse& impulse) override;
  const coupling::Velocities& adopt(const coupling::Velocities& velocities) override;
  bool update_contacts(const coupling::Impulse& impulse) override { return bodies_->update_contacts(impulse); }
  coupling::Placement placement() const override;
  void see_wetted(const Eigen::VectorXd& measures) override;
  Status acceptable() const override { return bodies_->acceptable(); }
  void commit() override;

 private:
  void see_released();

  std::unique_ptr<Bodies<d>> bodies_;
  std::vector<coupling::WallCoordinates> walls_;
  Eigen::VectorXd scales_, reach_;
  double length_ = 0;
  coupling::Velocities trial_;
};

extern template class Participant<2>;
extern template class Participant<3>;

}  // namespace splashdown::rigid
