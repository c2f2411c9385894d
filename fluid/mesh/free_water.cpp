#include "fluid/mesh/free_water.hpp"

#include <algorithm>
#include <cmath>

#include "fluid/mesh/parts.hpp"

namespace splashdown::fluid {

template <int d>
FreeWater<d>::FreeWater(const Mesh<d>& mesh, const Nodes<d>& nodes)
    : part_(parts_of(mesh, nodes.size())), free_(nodes.size(), 1) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes.spray[i] || nodes.tie[i].wall >= 0) free_[part_[i]] = 0;
  for (int first : part_) any_ = any_ || free_[first];
}

template <int d>
auto FreeWater<d>::moments(std::span<const double> volumes, std::span<const Vec<d>> v,
                           std::span<const VelocityMoments<d>> inherited) const -> Moments {
  if (!any_) return {};
  Moments sum(part_.size());
  for (std::size_t i = 0; i < part_.size(); ++i) {
    if (!has(i)) continue;
    sum[part_[i]] += VelocityMoments<d>::of(volumes[i], v[i]);
    if (!inherited.empty()) sum[part_[i]] += inherited[i];
  }
  return sum;
}

template <int d>
void FreeWater<d>::give_back(const Moments& had, std::span<const double> volumes, std::vector<Vec<d>>& v) const {
  if (!any_) return;
  Moments all(part_.size());
  for (std::size_t i = 0; i < part_.size(); ++i) all[part_[i]] += VelocityMoments<d>::of(volumes[i], v[i]);
  const auto largest = std::ranges::max_element(all, {}, &VelocityMoments<d>::volume) - all.begin();
  std::vector<Vec<d>> mean(part_.size(), Vec<d>::Zero());
  Vec<d> left = Vec<d>::Zero();
  for (std::size_t first = 0; first < part_.size(); ++first) {
    if (!has(first) || part_[first] != static_cast<int>(first)) continue;
    mean[first] = (had[first].volume > 0 ? had : all)[first].mean_velocity();
    left += had[first].momentum - all[first].volume * mean[first];
  }
  if (all[largest].volume > 0) mean[largest] += left / all[largest].volume;
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (!has(i)) continue;
    const auto &was = had[part_[i]], &is = all[part_[i]];
    const double T = was.inner_energy(), T_now = is.inner_energy();
    const double share = T_now > T ? std::sqrt(T / T_now) : 1.0;
    v[i] = mean[part_[i]] + share * (v[i] - is.mean_velocity());
  }
}

template class FreeWater<2>;
template class FreeWater<3>;

}  // namespace splashdown::fluid
