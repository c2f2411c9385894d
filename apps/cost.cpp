#include "apps/cost.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "apps/build.hpp"
#include "apps/scales.hpp"
#include "apps/solid.hpp"

namespace splashdown::apps {
namespace {

using rigid::Surface;
using rigid::Vec;

// Orders of magnitude of the design (docs/theory.md, cost of a step): mesh and factor of a Laplacian.
template <int d>
struct Share;
template <>
struct Share<2> {
  static constexpr double bytes_a_node = 2e3;
  static constexpr double seconds_a_node = 6e-6;
  static constexpr double seconds_a_pass = 0.5e-6;  // a node: one more back-substitution
  static double nodes(double h) { return 2 / (std::numbers::sqrt3 * h * h); }
};
template <>
struct Share<3> {
  static constexpr double bytes_a_node = 1e4;
  static constexpr double seconds_a_node = 2e-5;
  static constexpr double seconds_a_pass = 5e-6;
  static double nodes(double h) { return std::numbers::sqrt2 / (h * h * h); }
};
constexpr double bytes_of_program = 1e8;

/// The element size that a scene asks for and the liquid it fills, both at t = 0.
template <int d>
class SizeEstimate {
 public:
  explicit SizeEstimate(const Scene& scene) : size_(scene.fluid->size) {
    for (const auto& region : scene.fluid->regions) regions_.emplace_back(outline<d>(region));
    for (const auto& body : scene.bodies) {
      bodies_.emplace_back(Solid<d>(outline<d>(body)), body.size);
      for (const auto& bend : hull_bends<d>(scene, body))
        if (bend.size < body.size) bends_.push_back(bend);
    }
    if (scene.tank) {
      tank_ = extents<d>(*scene.tank);
      tank_size_ = scene.tank->size;
    }
    find_free_surface();
  }

  double growth() const { return size_.growth; }
  const std::vector<Solid<d>>& regions() const { return regions_; }

  double h(const Vec<d>& x) const {
    double h = size_.far;
    for (const auto& [hull, size] : bodies_) h = std::min(h, grown(size, hull.distance(x)));
    if (!tank_.isEmpty()) h = std::min(h, grown(tank_size_, to_tank(x)));
    for (const auto& bend : bends_) h = std::min(h, grown(bend.size, (x - bend.at).norm()));
    if (free_.empty()) return h;
    const auto nearest = free_.nearest(x, std::numeric_limits<double>::max());
    return std::min(h, grown(size_.surface, std::sqrt(nearest.squared_distance)));
  }

  bool is_liquid(const Vec<d>& x) const {
    if (!tank_.isEmpty() && !tank_.contains(x)) return false;
    for (const auto& [hull, size] : bodies_)
      if (hull.contains(x)) return false;
    return std::any_of(regions_.begin(), regions_.end(), [&](const auto& region) { return region.contains(x); });
  }

 private:
  double grown(double size, double distance) const { return size + size_.growth * distance; }

  double to_tank(const Vec<d>& x) const {
    return std::max(0., std::min((x - tank_.min()).minCoeff(), (tank_.max() - x).minCoeff()));
  }

  /// Facets of regions that lie along no wall.
  void find_free_surface() {
    Eigen::Index vertices = 0, facets = 0;
    for (const auto& region : regions_) {
      vertices += region.surface().vertices.cols();
      facets += region.surface().facets.cols();
    }
    Surface<d> all;
    all.vertices.resize(d, vertices);
    all.facets.resize(d, facets);
    vertices = facets = 0;
    for (const auto& region : regions_) {
      const auto& surface = region.surface();
      const double near = 1e-6 * region.extents().diagonal().norm();
      for (Eigen::Index i = 0; i < surface.facets.cols(); ++i) {
        Vec<d> middle = Vec<d>::Zero();
        for (int k = 0; k < d; ++k) middle += surface.vertices.col(surface.facets(k, i)) / d;
        if (!tank_.isEmpty() && !(tank_.contains(middle) && to_tank(middle) > near)) continue;
        all.facets.col(facets++) = surface.facets.col(i).array() + static_cast<int>(vertices);
      }
      all.vertices.middleCols(vertices, surface.vertices.cols()) = surface.vertices;
      vertices += surface.vertices.cols();
    }
    all.facets.conservativeResize(d, facets);
    free_ = fluid::FacetTree<d>(all.vertices, all.facets);
  }

  Sizes size_;
  std::vector<Solid<d>> regions_;
  std::vector<std::pair<Solid<d>, double>> bodies_;
  std::vector<HullBend<d>> bends_;
  Extents<d> tank_;
  double tank_size_ = 0;
  fluid::FacetTree<d> free_;
};

/// Nodes in a box: cells are halved until h changes little across them.
template <int d>
double nodes_in(const SizeEstimate<d>& estimate, const Extents<d>& cell) {
  const Vec<d> x = cell.center();
  const double h = estimate.h(x), side = cell.sizes().maxCoeff();
  if (side > std::max(2 * h, 0.25 * h / estimate.growth())) {
    double sum = 0;
    for (int corner = 0; corner < 1 << d; ++corner) {
      Extents<d> part(x);
      part.extend(cell.corner(static_cast<typename Extents<d>::CornerType>(corner)));
      sum += nodes_in<d>(estimate, part);
    }
    return sum;
  }
  return estimate.is_liquid(x) ? cell.volume() * Share<d>::nodes(h) : 0;
}

template <int d>
double finest(const Scene& scene) {
  double h = scene.fluid->size.surface;
  for (const auto& body : scene.bodies) {
    h = std::min(h, body.size);
    for (const auto& bend : hull_bends<d>(scene, body)) h = std::min(h, bend.size);
  }
  return h;
}

}  // namespace

template <int d>
Cost predicted_cost(const Scene& scene) {
  Cost cost;
  cost.dt = scene.time.dt_max;
  if (scene.fluid) {
    const SizeEstimate<d> estimate(scene);
    Extents<d> all;
    for (const auto& region : estimate.regions()) all.extend(region.extents());
    if (scene.tank) all = all.intersection(extents<d>(*scene.tank));
    cost.nodes = nodes_in<d>(estimate, all);
    const double speed = scales<d>(scene).speed;
    if (speed > 0) cost.dt = std::min(cost.dt, scene.time.cfl * finest<d>(scene) / speed);
  }
  cost.steps = scene.time.end / cost.dt;
  cost.bytes = bytes_of_program + Share<d>::bytes_a_node * cost.nodes;
  cost.seconds_per_step = cost.nodes * (Share<d>::seconds_a_node + (scene.coupling ? 2 * Share<d>::seconds_a_pass : 0));
  return cost;
}

template Cost predicted_cost<2>(const Scene&);
template Cost predicted_cost<3>(const Scene&);

}  // namespace splashdown::apps
