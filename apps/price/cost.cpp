#include "apps/price/cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/check/cost.hpp"
#include "apps/scene/read/read.hpp"

namespace splashdown::apps {
namespace {

/// Line through the logarithms of two points.
double power_law(double x0, double y0, double x1, double y1, double x) {
  return y1 * std::pow(x / x1, std::log(y1 / y0) / std::log(x1 / x0));
}

double interpolated(const ExpectedNodes& points, double x) {
  std::size_t k = 1;
  while (k + 1 < points.size() && points[k].first < x) ++k;
  return power_law(points[k - 1].first, points[k - 1].second, points[k].first, points[k].second, x);
}

}  // namespace

ExpectedNodes expected_nodes(const std::filesystem::path& scene, std::vector<std::string> set, double coarsest,
                             double finest) {
  ExpectedNodes points;
  set.emplace_back();
  for (double refine = coarsest; refine < 1.01 * finest; refine *= 2) {
    set.back() = fmt::format("fluid.size.refine={}", refine);
    try {
      const auto file = read_scene(scene, set);
      const auto cost = file.scene.dimension == 2 ? predicted_cost<2>(file.scene) : predicted_cost<3>(file.scene);
      points.emplace_back(refine, 0.5 * (cost.nodes + cost.nodes_most));
    } catch (const SceneError&) {  // finer or coarser than the scene allows: nobody will run it
    }
  }
  if (points.size() < 2) points.clear();
  return points;
}

RunCost::RunCost(const std::vector<Rung>& rungs, ExpectedNodes expected, int dimension)
    : expected_(std::move(expected)), dimension_(dimension) {
  for (const auto& rung : rungs)
    if (rung.spec.role == Role::rung) meshes_.push_back({rung.spec.refine, rung.node_steps, rung.steps});
  std::ranges::sort(meshes_, {}, &Mesh::refine);
  double work = 0;
  for (const auto& rung : rungs) {
    work += rung.node_steps;
    per_node_step_ += rung.seconds - rung.setup_seconds;
    overhead_ += rung.setup_seconds / static_cast<double>(rungs.size());
  }
  if (work > 0) per_node_step_ /= work;
  if (meshes_.size() < 2) return;
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& mesh : meshes_) {
    x += std::log(mesh.refine) / static_cast<double>(meshes_.size());
    y += std::log(mesh.steps) / static_cast<double>(meshes_.size());
  }
  for (const auto& mesh : meshes_) {
    xx += (std::log(mesh.refine) - x) * (std::log(mesh.refine) - x);
    xy += (std::log(mesh.refine) - x) * (std::log(mesh.steps) - y);
  }
  step_exponent_ = std::clamp(xy / xx, 0., 1.);  // steps as long as elements are small, at most
}

double RunCost::beyond(const Mesh& last, double refine) const {
  // A mesh of uniform size, where nothing better is known.
  const double nodes = expected_.empty() ? std::pow(refine / last.refine, dimension_)
                                         : interpolated(expected_, refine) / interpolated(expected_, last.refine);
  return last.node_steps * nodes * std::pow(refine / last.refine, step_exponent_);
}

double RunCost::node_steps(double refine) const {
  if (refine >= meshes_.back().refine) return beyond(meshes_.back(), refine);
  if (refine <= meshes_.front().refine) return beyond(meshes_.front(), refine);
  std::size_t k = 1;
  while (meshes_[k].refine < refine) ++k;
  return power_law(meshes_[k - 1].refine, meshes_[k - 1].node_steps, meshes_[k].refine, meshes_[k].node_steps, refine);
}

double RunCost::seconds(double refine) const { return overhead_ + per_node_step_ * node_steps(refine); }

}  // namespace splashdown::apps
