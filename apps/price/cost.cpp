#include "apps/price/cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/check/cost.hpp"
#include "apps/scene/read/read.hpp"

namespace splashdown::apps {
namespace {

// Of ladders of wedge_drop, capsule_drop_2d and uav_landing from an eighth of their refinement on.
constexpr Usual steps_by_refine{0.75, 0.15};
constexpr Usual nodes_by_expected{1, 0.15};
constexpr Usual step_by_nodes{1.1, 0.15};
constexpr Usual around_by_nodes{0.5, 0.25};
// Of a run's seconds when other processes come and go [log].
constexpr double clock_noise = 0.2;
/// Of the exponent between two meshes: laws bend.
constexpr double pair_deviation = 0.3;

/// Line through the logarithms of two points.
double power_law(double x0, double y0, double x1, double y1, double x) {
  return y1 * std::pow(x / x1, std::log(y1 / y0) / std::log(x1 / x0));
}

/// The mean of what is usual and of all pairs, each with the weight of its deviation.
double exponent_of(const std::vector<double>& pairs, Usual usual) {
  const double prior = 1 / (usual.deviation * usual.deviation), each = 1 / (pair_deviation * pair_deviation);
  double weight = prior, sum = prior * usual.exponent;
  for (const double exponent : pairs)
    if (std::isfinite(exponent)) weight += each, sum += each * exponent;
  return std::max(sum / weight, 0.);
}

}  // namespace

ExpectedNodes expected_nodes(const std::filesystem::path& scene, std::vector<std::string> set, double coarsest,
                             double finest, double seconds) {
  ExpectedNodes points;
  const auto before = read_scene(scene, set).scene;
  if (!before.has_fluid()) return points;
  set.emplace_back();
  for (double refine = coarsest; refine < 1.01 * finest; refine *= 2) {
    set.back() = fmt::format("fluid.size.refine={}", refine);
    try {
      const auto file = read_scene(scene, set);
      const auto cost = file.scene.dimension == 2 ? predicted_cost<2>(file.scene) : predicted_cost<3>(file.scene);
      points.emplace_back(refine, 0.5 * (cost.nodes + cost.nodes_most));
      if (points.size() > 1 && cost.seconds_to_start + cost.steps * cost.seconds_per_step > seconds) break;
    } catch (const SceneError&) {  // finer or coarser than the scene allows: nobody will run it
    }
  }
  if (points.size() < 2) points.clear();
  return points;
}

double PowerLaw::at(double x) const { return std::exp(level) * std::pow(x, exponent); }

PowerLaw PowerLaw::of(const std::vector<std::pair<double, double>>& points, Usual usual, double noise) {
  const auto n = static_cast<double>(points.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [a, b] : points) x += std::log(a) / n, y += std::log(b) / n;
  for (const auto& [a, b] : points) {
    xx += (std::log(a) - x) * (std::log(a) - x);
    xy += (std::log(a) - x) * (std::log(b) - y);
  }
  const double prior = noise * noise / (usual.deviation * usual.deviation);
  const double exponent = std::max((xy + prior * usual.exponent) / (xx + prior), 0.);
  return {y - exponent * x, exponent};
}

RunCost::RunCost(const std::vector<Rung>& rungs, ExpectedNodes expected, int dimension)
    : expected_(std::move(expected)), dimension_(dimension) {
  std::vector<std::pair<double, double>> around, step;
  for (const auto& rung : rungs) {
    const double nodes = rung.node_steps / rung.steps, outside = rung.setup_seconds + rung.output_seconds;
    if (rung.spec.role == Role::rung) meshes_.push_back({rung.spec.refine, nodes, rung.steps});
    if (outside > 0) around.emplace_back(nodes, outside);
    if (rung.seconds > outside) step.emplace_back(nodes, (rung.seconds - outside) / rung.steps);
  }
  std::ranges::sort(meshes_, {}, &Mesh::refine);
  step_ = PowerLaw::of(step, step_by_nodes, clock_noise);
  around_ = PowerLaw::of(around, around_by_nodes, clock_noise);
  if (around.empty()) around_.level = -HUGE_VAL;
}

double RunCost::expected(double refine) const {
  // A mesh of uniform size, where nothing better is known.
  if (expected_.empty()) return std::pow(refine, dimension_);
  std::size_t k = 1;
  while (k + 1 < expected_.size() && expected_[k].first < refine) ++k;
  return power_law(expected_[k - 1].first, expected_[k - 1].second, expected_[k].first, expected_[k].second, refine);
}

double RunCost::beyond(const Mesh& last, double refine, double Mesh::*what) const {
  const bool of_nodes = what == &Mesh::nodes;
  const auto x = [&](double at) { return of_nodes ? expected(at) : at; };
  std::vector<double> pairs;
  for (const auto& mesh : meshes_)
    if (&mesh != &last) pairs.push_back(std::log(mesh.*what / last.*what) / std::log(x(mesh.refine) / x(last.refine)));
  const double exponent = exponent_of(pairs, of_nodes ? nodes_by_expected : steps_by_refine);
  return last.*what * std::pow(x(refine) / x(last.refine), exponent);
}

double RunCost::quantity(double refine, double Mesh::*what) const {
  if (refine >= meshes_.back().refine) return beyond(meshes_.back(), refine, what);
  if (refine <= meshes_.front().refine) return beyond(meshes_.front(), refine, what);
  std::size_t k = 1;
  while (meshes_[k].refine < refine) ++k;
  return power_law(meshes_[k - 1].refine, meshes_[k - 1].*what, meshes_[k].refine, meshes_[k].*what, refine);
}

double RunCost::seconds(double refine) const {
  const double mean = nodes(refine);
  return around_.at(mean) + steps(refine) * step_.at(mean);
}

}  // namespace splashdown::apps
