#include "core/geometry.hpp"
#include "fluid/ale/walls/moving_wall.hpp"

namespace splashdown::ale {
namespace {

class RigidWall final : public MovingWall {
 public:
  RigidWall(const Isometry<2>& pose, const Nodes& nodes) : pose_(pose), nodes_(pose.inverse() * nodes) {}

  Eigen::Index coordinates() const override { return 3; }
  Eigen::VectorXd first() const override { return numbers_of(pose_); }
  Nodes positions(const Eigen::VectorXd& placement) const override { return pose(placement) * nodes_; }
  Eigen::MatrixXd basis(const Eigen::VectorXd& placement) const override {
    const Nodes arms = pose(placement).linear() * nodes_;
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(2 * arms.cols(), 3);
    for (Eigen::Index a = 0; a < arms.cols(); ++a) {
      all(2 * a, 0) = all(2 * a + 1, 1) = 1;
      all(2 * a, 2) = -arms(1, a);
      all(2 * a + 1, 2) = arms(0, a);
    }
    return all;
  }
  Eigen::VectorXd moved(const Eigen::VectorXd& placement, const Eigen::VectorXd& velocities, double dt) const override {
    return numbers_of(splashdown::moved<2>(pose(placement), Twist<2>(velocities), dt));
  }
  Isometry<2> pose(const Eigen::VectorXd& placement) const override {
    Isometry<2> pose = Isometry<2>::Identity();
    pose.matrix().topRows<2>() = placement.reshaped<Eigen::ColMajor>(2, 3);
    return pose;
  }

 private:
  static Eigen::VectorXd numbers_of(const Isometry<2>& pose) {
    return pose.matrix().topRows<2>().reshaped<Eigen::ColMajor>();
  }

  Isometry<2> pose_;
  Nodes nodes_;  // in the wall's frame
};

}  // namespace

MakeMovingWall rigid_wall(const Isometry<2>& pose) {
  return [pose](const Nodes& nodes) { return std::make_unique<RigidWall>(pose, nodes); };
}

}  // namespace splashdown::ale
