#include <vector>

#include "core/anchor.hpp"
#include "fluid/ale/walls/moving_wall.hpp"

namespace splashdown::ale {
namespace {

class DeformingWall final : public MovingWall {
 public:
  DeformingWall(const Surface<2>& surface, const Nodes& nodes) : first_(surface.vertices.reshaped()), offset_(nodes) {
    const FacetTree<2> tree(surface.vertices, surface.facets);
    for (auto node : offset_.colwise()) {
      carried_.push_back(anchor_on<2>(surface.vertices, surface.facets, tree, node));
      node -= carried_.back().interpolate(surface.vertices);
    }
  }

  Eigen::Index coordinates() const override { return first_.size(); }
  Eigen::VectorXd first() const override { return first_; }
  Nodes positions(const Eigen::VectorXd& placement) const override {
    const AtVertices<2> vertices = placement.reshaped(2, placement.size() / 2);
    Nodes x = offset_;
    for (Eigen::Index a = 0; a < x.cols(); ++a) x.col(a) += carried_[static_cast<std::size_t>(a)].interpolate(vertices);
    return x;
  }
  Eigen::MatrixXd basis(const Eigen::VectorXd&) const override {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(2 * offset_.cols(), first_.size());
    for (Eigen::Index a = 0; a < offset_.cols(); ++a)
      for (int k = 0; k < 2; ++k)
        for (int axis = 0; axis < 2; ++axis) {
          const auto& [vertex, weight] = carried_[static_cast<std::size_t>(a)];
          all(2 * a + axis, 2 * vertex[static_cast<std::size_t>(k)] + axis) += weight[static_cast<std::size_t>(k)];
        }
    return all;
  }
  Eigen::VectorXd moved(const Eigen::VectorXd& placement, const Eigen::VectorXd& velocities, double dt) const override {
    return placement + dt * velocities;
  }
  Isometry<2> pose(const Eigen::VectorXd&) const override { return Isometry<2>::Identity(); }

 private:
  Eigen::VectorXd first_;
  std::vector<Anchor<2>> carried_;
  Nodes offset_;  // of nodes from the facets that carry them, at t = 0 [m]: the mesh has curves where facets are chords
};

}  // namespace

MakeMovingWall deforming_wall(const Surface<2>& surface) {
  return [surface](const Nodes& nodes) { return std::make_unique<DeformingWall>(surface, nodes); };
}

}  // namespace splashdown::ale
