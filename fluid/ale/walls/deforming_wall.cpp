#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "fluid/ale/walls/moving_wall.hpp"

namespace splashdown::ale {
namespace {

/// A node on a facet of the surface: how much its two vertices carry of it.
struct Carried {
  std::array<Eigen::Index, 2> vertex;
  std::array<double, 2> weight;
};

Carried carried_by(const Surface<2>& surface, const Vec<2>& x) {
  Carried best{{0, 0}, {1, 0}};
  double least = std::numeric_limits<double>::infinity();
  for (const auto facet : surface.facets.colwise()) {
    const Vec<2> from = surface.vertices.col(facet[0]), along = surface.vertices.col(facet[1]) - from;
    const double share = std::clamp(along.dot(x - from) / along.squaredNorm(), 0.0, 1.0);
    const double distance = (from + share * along - x).squaredNorm();
    if (distance < least) least = distance, best = {{facet[0], facet[1]}, {1 - share, share}};
  }
  return best;
}

class DeformingWall final : public MovingWall {
 public:
  DeformingWall(const Surface<2>& surface, const Nodes& nodes)
      : first_(surface.vertices.reshaped()), offset_(2, nodes.cols()) {
    for (Eigen::Index a = 0; a < nodes.cols(); ++a) {
      carried_.push_back(carried_by(surface, nodes.col(a)));
      offset_.col(a) = nodes.col(a) - interpolated(first_, carried_.back());
    }
  }

  Eigen::Index coordinates() const override { return first_.size(); }
  Eigen::VectorXd first() const override { return first_; }
  Nodes positions(const Eigen::VectorXd& placement) const override {
    Nodes x = offset_;
    for (Eigen::Index a = 0; a < x.cols(); ++a)
      x.col(a) += interpolated(placement, carried_[static_cast<std::size_t>(a)]);
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
  static Vec<2> interpolated(const Eigen::VectorXd& vertices, const Carried& node) {
    return node.weight[0] * vertices.segment<2>(2 * node.vertex[0]) +
           node.weight[1] * vertices.segment<2>(2 * node.vertex[1]);
  }

  Eigen::VectorXd first_;
  std::vector<Carried> carried_;
  Nodes offset_;  // of nodes from the facets that carry them, at t = 0 [m]: the mesh has curves where facets are chords
};

}  // namespace

MakeMovingWall deforming_wall(const Surface<2>& surface) {
  return [surface](const Nodes& nodes) { return std::make_unique<DeformingWall>(surface, nodes); };
}

}  // namespace splashdown::ale
