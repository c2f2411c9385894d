#include "apps/check/cost.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include "apps/build/build.hpp"
#include "apps/check/hull_elements.hpp"
#include "apps/check/step_count.hpp"
#include "apps/scene/mirror.hpp"
#include "apps/scene/outlook/motion_guess.hpp"
#include "apps/scene/scales.hpp"
#include "apps/scene/solid.hpp"
#include "fluid/ale/mesh/node_count.hpp"
#include "fluid/ale/mesh_spec.hpp"

namespace splashdown::apps {
namespace {

using rigid::Surface;
using rigid::Vec;

// Medians of what the shipped examples take of one core: 600 to 15000 nodes in the plane, 4000 to 70000 in space. Each
// is over a node that is counted here; in space runs have a third more of them than are counted.
// tests/benchmark/cost_guess.py compares.
template <int d>
struct Share;
template <>
struct Share<2> {
  static constexpr double bytes_a_node = 2e3;
  static constexpr double seconds_to_start = 1.5e-4;  // a node
  static constexpr double seconds_a_node = 6e-6;
  static constexpr double seconds_a_pass = 0.5e-6;  // a node: one more back-substitution
  // Nodes in jets and in water that rises, over those that an entering hull itself brings: the examples' wedges have
  // about as many, hulls with sizes that were chosen, whose jets are thinner than an element, hardly any.
  static constexpr double jets = 1;
  static constexpr double thrown = 0;
  static double nodes(double h) { return 2 / (std::numbers::sqrt3 * h * h); }
};
template <>
struct Share<3> {
  static constexpr double bytes_a_node = 1e4;
  static constexpr double seconds_to_start = 6e-4;
  static constexpr double seconds_a_node = 5.5e-5;
  static constexpr double seconds_a_pass = 2e-6;
  static constexpr double jets = 1.8;
  // Nodes in water that a hull throws up or leaves behind once it is wet, over those beside it (tests/benchmark/landing_cost.py).
  static constexpr double thrown = 0.8;
  static double nodes(double h) { return std::numbers::sqrt2 / (h * h * h); }
};
constexpr double bytes_of_program = 1e8;
// Cells that an estimate looks at, at most: in about a second several times the nodes that are run unasked.
constexpr std::size_t most_cells = 400'000;

/// The element size that a scene asks for and the liquid it fills, with the bodies where they are at a time. The
/// liquid is that of t = 0: what rises beside a hull is not in it.
template <int d>
class SizeEstimate {
 public:
  SizeEstimate(const Scene& scene, const std::vector<GuessedBody<d>>& bodies, double time) : size_(scene.fluid->size) {
    for (const auto& region : scene.fluid->regions) regions_.emplace_back(outline<d>(region));
    for (const auto& guessed : bodies) {
      const Body& body = *guessed.body;
      const Vec<d> moved = guessed_motion<d>(scene, guessed, time);
      auto hull = guessed.hull;
      hull.vertices.colwise() += moved;
      const auto ends = wetted_ends<d>(scene, guessed, time);
      const double half = ends ? wetted_width<d>(*ends) / 2 : 0;
      bodies_.emplace_back(Solid<d>(hull), size_on_hull(scene, body, wetted_length<d>(scene, guessed, time)));
      for (auto spot : hull_spots<d>(scene, body)) {
        spot.at += moved;
        add(spot);
      }
      if (const double size = size_at_root<d>(scene, body, half); half > 0 && size < body.size) {
        Eigen::Index lowest;
        hull.vertices.row(d - 1).minCoeff(&lowest);
        for (const double side : {-half, half}) {
          Vec<d> root = hull.vertices.col(lowest);
          root[0] += side;
          root[d - 1] = still_water_level<d>(scene).value_or(0);
          add({root, size});
        }
      }
    }
    if (scene.tank) {
      tank_ = extents<d>(*scene.tank);
      tank_size_ = scene.tank->size;
    }
    find_free_surface();
  }

  double growth() const { return size_.growth; }
  double far() const { return size_.far; }
  const std::vector<Solid<d>>& regions() const { return regions_; }

  double h(const Vec<d>& x) const {
    double h = size_.far;
    for (const auto& [hull, size] : bodies_) h = std::min(h, grown(size, hull.distance(x)));
    if (!tank_.isEmpty()) h = std::min(h, grown(tank_size_, to_tank(x)));
    if (!spots_.empty() && grown(least_spot_, spot_box_.exteriorDistance(x)) < h)
      for (const auto& spot : spots_) h = std::min(h, grown(spot.size, (x - spot.at).norm()));
    if (free_.empty() || h <= size_.surface) return h;
    // On the axis of a round jet all facets are as near: which one is nearest makes no difference.
    constexpr double slack = 0.02;
    const double reach = size_.growth > 0 ? (h - size_.surface) / size_.growth : std::numeric_limits<double>::max();
    const auto nearest = free_.nearest(x, reach, slack);
    return nearest.facet < 0 ? h : std::min(h, grown(size_.surface, std::sqrt(nearest.squared_distance)));
  }

  bool is_liquid(const Vec<d>& x) const {
    if (!tank_.isEmpty() && !tank_.contains(x)) return false;
    for (const auto& [hull, size] : bodies_)
      if (hull.contains(x)) return false;
    return std::any_of(regions_.begin(), regions_.end(), [&](const auto& region) { return region.contains(x); });
  }

 private:
  void add(const fluid::SizeSource<d>& spot) {
    spots_.push_back(spot);
    spot_box_.extend(spot.at);
    least_spot_ = std::min(least_spot_, spot.size);
  }

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
    free_ = FacetTree<d>(all.vertices, all.facets);
  }

  Sizes size_;
  std::vector<Solid<d>> regions_;
  std::vector<std::pair<Solid<d>, double>> bodies_;
  std::vector<fluid::SizeSource<d>> spots_;  // bends, corners, roots of jets
  Extents<d> spot_box_;                      // far from it none of them makes elements smaller
  double least_spot_ = std::numeric_limits<double>::max();
  Extents<d> tank_;
  double tank_size_ = 0;
  FacetTree<d> free_;
};

struct Count {
  double nodes = 0;
  bool at_least = false;  ///< there are more: not all cells could be looked at
};

/// Nodes in a box: cells are halved until h changes little across them, those that hold most nodes first. Cells that
/// are left when enough have been looked at count with the largest h that they can have.
template <int d>
Count nodes_in(const SizeEstimate<d>& estimate, const Extents<d>& all) {
  struct Cell {
    Extents<d> box;
    double h, nodes;
    bool operator<(const Cell& other) const { return nodes < other.nodes; }
  };
  const auto looked_at = [&](const Extents<d>& box) {
    const double h = estimate.h(box.center());
    // h grows by `growth` a metre at most, and what is sorted by must be finite.
    const double least = std::max(h - estimate.growth() * box.diagonal().norm() / 2, 0.1 * h);
    return Cell{box, h, std::min(box.volume() * Share<d>::nodes(least), std::numeric_limits<double>::max())};
  };
  Count count;
  std::priority_queue<Cell> open;
  open.push(looked_at(all));
  std::size_t cells = 1;
  while (!open.empty()) {
    const Cell cell = open.top();
    open.pop();
    const Vec<d> x = cell.box.center();
    const bool coarse = cell.box.sizes().maxCoeff() > std::max(2 * cell.h, 0.25 * cell.h / estimate.growth());
    if (coarse && cells < most_cells) {
      for (int corner = 0; corner < 1 << d; ++corner, ++cells) {
        Extents<d> part(x);
        part.extend(cell.box.corner(static_cast<typename Extents<d>::CornerType>(corner)));
        open.push(looked_at(part));
      }
      continue;
    }
    if (!estimate.is_liquid(x)) continue;
    const double spread = estimate.growth() * cell.box.diagonal().norm() / 2;
    const double widest = coarse ? std::min(cell.h + spread, std::max(cell.h, estimate.far())) : cell.h;
    count.nodes += cell.box.volume() * Share<d>::nodes(widest);
    count.at_least = count.at_least || coarse;
  }
  return count;
}

template <int d>
Count nodes_at(const Scene& scene, const std::vector<GuessedBody<d>>& bodies, double time) {
  const SizeEstimate<d> estimate(scene, bodies, time);
  Extents<d> all;
  for (const auto& region : estimate.regions()) all.extend(region.extents());
  if (scene.tank) all = all.intersection(extents<d>(*scene.tank));
  if (const auto mirror = mirror_of(scene)) all.min()[mirror->axis] = std::max(all.min()[mirror->axis], mirror->at);
  return nodes_in<d>(estimate, all);
}

/// Whether a body comes to the water within the run.
template <int d>
bool enters(const Scene& scene, const std::vector<GuessedBody<d>>& bodies) {
  return std::ranges::any_of(bodies, [&](const GuessedBody<d>& guessed) {
    return wetted_length<d>(scene, guessed, 0) == 0 && wetted_length<d>(scene, guessed, scene.time.end) > 0;
  });
}

/// Squares instead of nodes: measured with one body and one pass of its own.
Cost cost_on_grid(const Scene& scene, double speed) {
  constexpr double bytes_a_square = 890, seconds_a_square = 35e-9,
                   of_flow = 1.7;  // around bodies, over the speed far away
  const auto& fluid = *scene.vortex;
  const auto grid = vortex_spec(scene).grid;
  Cost cost;
  cost.nodes = cost.nodes_most = static_cast<double>(grid.nodes());
  cost.bytes = bytes_a_square * cost.nodes + bytes_of_program;
  cost.seconds_to_start = cost.seconds_per_step = seconds_a_square * cost.nodes;
  cost.dt = scene.time.dt_max;
  if (speed > 0) cost.dt = std::min(cost.dt, scene.time.cfl * fluid.size / (of_flow * speed));
  if (fluid.viscosity > 0) cost.dt = std::min(cost.dt, 0.2 * fluid.size * fluid.size * fluid.density / fluid.viscosity);
  cost.steps = scene.time.end / cost.dt;
  return cost;
}

/// Bytes and seconds are measured with a cylinder and its flag.
Cost cost_between_sides(const Scene& scene) {
  constexpr double bytes_a_node = 15e3, seconds_a_node = 12e-6;
  Cost cost;
  cost.nodes = cost.nodes_most = ale::foreseen_nodes(ale::mesh_spec(ale_spec(scene)));
  cost.bytes = bytes_a_node * cost.nodes + bytes_of_program;
  cost.seconds_per_step = seconds_a_node * cost.nodes;
  cost.seconds_to_start = 5 * cost.seconds_per_step;
  cost.dt = scene.time.dt_max;
  cost.steps = scene.time.end / cost.dt;
  return cost;
}

}  // namespace

template <int d>
Cost predicted_cost(const Scene& scene) {
  if (scene.ale) return cost_between_sides(scene);
  if (scene.vortex) return cost_on_grid(scene, scales<d>(scene).speed);
  Cost cost;
  double mean = 0;
  if (scene.fluid) {
    const auto bodies = guessed_bodies<d>(scene);
    const double thrown = Share<d>::thrown > 0 && enters<d>(scene, bodies) ? Share<d>::thrown : 0,
                 beside = thrown > 0 ? nodes_at<d>(scene, {}, 0).nodes : 0;  // of the water without its bodies
    // Times at which the bodies' places are looked at: quarters of the run, by the trapezoidal rule.
    const bool moves = std::ranges::any_of(scene.bodies, [](const Body& body) { return body.motion != Motion::fixed; });
    const int quarters = moves ? 4 : 0;
    for (int i = 0; i <= quarters; ++i) {
      auto [nodes, at_least] = nodes_at<d>(scene, bodies, quarters > 0 ? scene.time.end * i / quarters : 0);
      if (i == 0) cost.nodes = nodes;
      if (i > 0) nodes += std::max({0., Share<d>::jets * (nodes - cost.nodes), thrown * (nodes - beside)});
      cost.nodes_most = std::max(cost.nodes_most, nodes);
      cost.at_least = cost.at_least || at_least;
      mean += quarters > 0 ? nodes * (i == 0 || i == quarters ? 0.5 : 1) / quarters : nodes;
      if (at_least) {  // large enough to be asked about: the other times cost time and say nothing new
        mean = nodes;
        break;
      }
    }
    cost.without_hollows = scene.fluid->size.hollow && std::ranges::none_of(scene.bodies, [](const Body& body) {
                             return jet_thickness<d>(body, 1).has_value();
                           });
    cost.steps = predicted_steps<d>(scene, bodies);
  } else {
    cost.steps = scene.time.end / scene.time.dt_max;
  }
  cost.dt = scene.time.end / cost.steps;
  cost.bytes = bytes_of_program + Share<d>::bytes_a_node * cost.nodes_most;
  cost.seconds_to_start = cost.nodes * Share<d>::seconds_to_start;
  cost.seconds_per_step = mean * (Share<d>::seconds_a_node + (scene.coupling ? 2 * Share<d>::seconds_a_pass : 0));
  return cost;
}

template Cost predicted_cost<2>(const Scene&);
template Cost predicted_cost<3>(const Scene&);

double predicted_seconds(const Scene& scene) {
  const auto cost = scene.dimension == 2 ? predicted_cost<2>(scene) : predicted_cost<3>(scene);
  return cost.seconds_to_start + cost.steps * cost.seconds_per_step;
}

}  // namespace splashdown::apps
