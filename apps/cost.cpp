#include "apps/cost.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "apps/build.hpp"
#include "apps/scales.hpp"
#include "apps/scene_geometry.hpp"

namespace splashdown::apps {
namespace {

using rigid::Surface;
using rigid::Vec;

// Orders of magnitude of the design (docs/theory.md, cost of a step): mesh and factor of a planar Laplacian.
constexpr double bytes_a_node = 2e3, bytes_of_program = 1e8;
constexpr double seconds_a_node = 6e-6;
constexpr double seconds_a_pass = 0.5e-6;  // a node: one more back-substitution

/// The element size that a scene asks for and the liquid it fills, both at t = 0.
class SizeEstimate {
 public:
  explicit SizeEstimate(const Scene& scene) : size_(scene.fluid->size) {
    for (const auto& region : scene.fluid->regions) regions_.push_back(outline(region));
    for (const auto& body : scene.bodies) {
      bodies_.emplace_back(outline(body), body.size);
      for (const auto& bend : hull_bends(scene, body))
        if (bend.size < body.size) bends_.push_back(bend);
    }
    if (scene.tank) {
      tank_ = Extents(planar(scene.tank->min), planar(scene.tank->max));
      tank_size_ = scene.tank->size;
    }
    for (const auto& region : regions_) add_free_edges(region);
  }

  double growth() const { return size_.growth; }
  const std::vector<Surface<2>>& regions() const { return regions_; }

  double h(const Vec<2>& x) const {
    double h = size_.far;
    for (const auto& [hull, size] : bodies_) h = std::min(h, grown(size, std::abs(signed_distance(hull, x))));
    if (!tank_.isEmpty()) h = std::min(h, grown(tank_size_, to_tank(x)));
    for (const auto& bend : bends_) h = std::min(h, grown(bend.size, (x - bend.at).norm()));
    for (const auto& [a, b] : free_) {
      const Vec<2> edge = b - a;
      const double along = std::clamp((x - a).dot(edge) / edge.squaredNorm(), 0., 1.);
      h = std::min(h, grown(size_.surface, (x - a - along * edge).norm()));
    }
    return h;
  }

  bool is_liquid(const Vec<2>& x) const {
    if (!tank_.isEmpty() && !tank_.contains(x)) return false;
    for (const auto& [hull, size] : bodies_)
      if (signed_distance(hull, x) < 0) return false;
    return std::any_of(regions_.begin(), regions_.end(),
                       [&](const auto& region) { return signed_distance(region, x) < 0; });
  }

 private:
  double grown(double size, double distance) const { return size + size_.growth * distance; }

  double to_tank(const Vec<2>& x) const {
    return std::max(0., std::min((x - tank_.min()).minCoeff(), (tank_.max() - x).minCoeff()));
  }

  /// Edges of a region that lie along no wall are free surface.
  void add_free_edges(const Surface<2>& region) {
    const double near = 1e-6 * extents(region).diagonal().norm();
    for (Eigen::Index i = 0; i < region.facets.cols(); ++i) {
      const Vec<2> a = region.vertices.col(region.facets(0, i)), b = region.vertices.col(region.facets(1, i));
      const Vec<2> middle = 0.5 * (a + b);
      if (tank_.isEmpty() || (tank_.contains(middle) && to_tank(middle) > near)) free_.emplace_back(a, b);
    }
  }

  Sizes size_;
  std::vector<Surface<2>> regions_;
  std::vector<std::pair<Surface<2>, double>> bodies_;
  std::vector<HullBend> bends_;
  Extents tank_;
  double tank_size_ = 0;
  std::vector<std::pair<Vec<2>, Vec<2>>> free_;
};

/// Nodes in a box: cells are halved until h changes little across them.
double nodes_in(const SizeEstimate& estimate, const Extents& cell) {
  const Vec<2> x = cell.center();
  const double h = estimate.h(x), side = cell.sizes().maxCoeff();
  if (side > std::max(2 * h, 0.25 * h / estimate.growth())) {
    double sum = 0;
    for (const auto corner :
         {Extents::BottomLeft, Extents::BottomRight, Extents::TopLeft, Extents::TopRight}) {
      Extents quarter(x);
      quarter.extend(cell.corner(corner));
      sum += nodes_in(estimate, quarter);
    }
    return sum;
  }
  return estimate.is_liquid(x) ? cell.volume() * 2 / (std::numbers::sqrt3 * h * h) : 0;
}

double finest(const Scene& scene) {
  double h = scene.fluid->size.surface;
  for (const auto& body : scene.bodies) {
    h = std::min(h, body.size);
    for (const auto& bend : hull_bends(scene, body)) h = std::min(h, bend.size);
  }
  return h;
}

}  // namespace

Cost predicted_cost(const Scene& scene) {
  Cost cost;
  cost.dt = scene.time.dt_max;
  if (scene.fluid) {
    const SizeEstimate estimate(scene);
    Extents all;
    for (const auto& region : estimate.regions()) all.extend(extents(region));
    if (scene.tank) all = all.intersection(Extents(planar(scene.tank->min), planar(scene.tank->max)));
    cost.nodes = nodes_in(estimate, all);
    const double speed = scales(scene).speed;
    if (speed > 0) cost.dt = std::min(cost.dt, scene.time.cfl * finest(scene) / speed);
  }
  cost.steps = scene.time.end / cost.dt;
  cost.bytes = bytes_of_program + bytes_a_node * cost.nodes;
  cost.seconds_per_step = cost.nodes * (seconds_a_node + (scene.coupling ? 2 * seconds_a_pass : 0));
  return cost;
}

}  // namespace splashdown::apps
