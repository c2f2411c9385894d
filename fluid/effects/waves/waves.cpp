#include "fluid/effects/waves/waves.hpp"

#include <algorithm>
#include <cmath>

#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {

template <int d>
double WaveZones<d>::rate_at(const Vec<d>& x) const {
  double deepest = 0;
  for (int k = 0; k < d - 1; ++k)
    if (width[k] > 0) deepest = std::max(deepest, 1 - std::min(x[k] - min[k], max[k] - x[k]) / width[k]);
  const double s = std::min(deepest, 1.0);
  return rate * s * s;
}

template <int d>
double WaveZones<d>::share_at(double t) const {
  if (ramp <= 0 || t >= ramp) return 1;
  const double s = std::max(t, 0.0) / ramp;
  return s * s * (3 - 2 * s);
}

template <int d>
Status Waves<d>::begin(const StepView<d>& step) {
  pulls_.clear();
  const Nodes<d>& nodes = step.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double rate = nodes.spray[i] ? 0.0 : zones_.rate_at(nodes.x[i]);
    if (rate > 0) pulls_.push_back({i, -std::expm1(-rate * step.kick), Vec<d>::Zero()});
  }
  const double back = 0.5 * step.dt_before, t = step.t - back, share = zones_.share_at(t);
  in_parallel(pulls_.size(), [&](std::size_t k) {
    Pull& pull = pulls_[k];
    pull.towards = share * sea_->velocity(nodes.x[pull.node] - back * nodes.v[pull.node], t);
  });
  return {};
}

template <int d>
Status Waves<d>::predict(const StepView<d>&, const Carried<d>& carried, const Predicted<d>& predicted) {
  for (const Pull& pull : pulls_) predicted.v[pull.node] += pull.share * (pull.towards - carried.v[pull.node]);
  return {};
}

template struct WaveZones<2>;
template struct WaveZones<3>;
template class Waves<2>;
template class Waves<3>;

}  // namespace splashdown::fluid
