#include "fluid/pfem/mesh/conservation/free_water.hpp"

#include <algorithm>
#include <cmath>

#include "fluid/pfem/mesh/parts.hpp"

namespace splashdown::fluid {

template <int d>
FreeWater<d>::FreeWater(const Mesh<d>& mesh, const Nodes<d>& nodes, const WallsAt<d>& walls)
    : part_(parts_of(mesh, nodes.size())), kept_(nodes.size(), all) {
  constexpr double roundoff = 1e-9;  // of what is left of a normal that others span
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const WallTie& tie = nodes.tie[i];
    int& kept = kept_[part_[i]];
    if (nodes.spray[i]) kept = drop;
    if (kept < all || tie.wall < 0) continue;
    if (tie.sharp() || tie.patch < 0 || !walls.walls[tie.wall].is_flat(tie.patch)) {
      kept = none;
      continue;
    }
    Vec<d> pushed = directions_[kept] * walls.walls[tie.wall].flat_normal(walls.poses[tie.wall], tie.patch);
    if (pushed.norm() <= roundoff) continue;
    pushed.normalize();
    if (kept == all) {
      kept = static_cast<int>(directions_.size());
      directions_.push_back(Mat<d>::Identity());
    }
    directions_[kept] -= pushed * pushed.transpose();
    if (directions_[kept].trace() < 0.5) kept = none;
  }
  any_ = std::ranges::any_of(part_, [&](int first) { return keeps_any(first); });
}

template <int d>
Vec<d> FreeWater<d>::kept(std::size_t node, const Vec<d>& v) const {
  return directions_[directions_of(node)] * v;
}

template <int d>
auto FreeWater<d>::moments(std::span<const double> volumes, std::span<const Vec<d>> v,
                           std::span<const VelocityMoments<d>> inherited) const -> Moments {
  if (!any_) return {};
  Moments sum(part_.size());
  for (std::size_t i = 0; i < part_.size(); ++i) {
    if (!keeps_any(i)) continue;
    sum[part_[i]] += VelocityMoments<d>::of(volumes[i], v[i]);
    if (!inherited.empty()) sum[part_[i]] += inherited[i];
  }
  return sum;
}

template <int d>
void FreeWater<d>::give_back(const Moments& had, std::span<const double> volumes, std::vector<Vec<d>>& v) const {
  if (!any_) return;
  Moments has_now(part_.size());
  for (std::size_t i = 0; i < part_.size(); ++i)
    if (directions_of(i) != drop) has_now[part_[i]] += VelocityMoments<d>::of(volumes[i], v[i]);
  const auto largest = std::ranges::max_element(has_now, {}, &VelocityMoments<d>::volume) - has_now.begin();
  const auto is_part = [&](std::size_t i) { return part_[i] == static_cast<int>(i) && keeps_any(i); };
  const auto gain = [&](std::size_t first) {
    constexpr double roundoff = 1e-9;
    const double change = has_now[first].volume - had[first].volume;
    return std::abs(change) > roundoff * had[first].volume ? change : 0.0;
  };
  VelocityMoments<d> lost;
  double gained = 0;
  for (std::size_t first = 0; first < part_.size(); ++first) {
    if (!is_part(first)) continue;
    if (gain(first) < 0) lost += VelocityMoments<d>::of(-gain(first), had[first].mean_velocity());
    gained += std::max(0.0, gain(first));
  }
  std::vector<Vec<d>> mean(part_.size(), Vec<d>::Zero());
  Vec<d> left = Vec<d>::Zero();
  for (std::size_t first = 0; first < part_.size(); ++first) {
    if (!is_part(first)) continue;
    mean[first] = (had[first].volume > 0 ? had : has_now)[first].mean_velocity();
    if (const double more = gain(first); more > 0 && lost.volume > 0) {
      const double moved = more * std::min(1.0, lost.volume / gained);
      mean[first] += moved / (had[first].volume + moved) * (lost.mean_velocity() - mean[first]);
    }
    left += kept(first, had[first].momentum - has_now[first].volume * mean[first]);
  }
  if (has_now[largest].volume > 0) mean[largest] += left / has_now[largest].volume;
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (!keeps_any(i)) continue;
    const auto &was = had[part_[i]], &is = has_now[part_[i]];
    if (!has(i)) {
      v[i] += kept(i, mean[part_[i]] - is.mean_velocity());
      continue;
    }
    const double T = was.inner_energy(), T_now = is.inner_energy();
    const double share = T_now > T ? std::sqrt(T / T_now) : 1.0;
    v[i] = mean[part_[i]] + share * (v[i] - is.mean_velocity());
  }
}

template class FreeWater<2>;
template class FreeWater<3>;

}  // namespace splashdown::fluid
