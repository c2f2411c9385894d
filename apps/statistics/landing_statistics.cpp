#include "apps/statistics/landing_statistics.hpp"

#include <cmath>
#include <numbers>

namespace splashdown::apps {

namespace {

constexpr double calm_share = 0.02;  // the usual band of settling times, of the Froude speed sqrt(g L)

/// Speed of heave, roll and pitch of the hull's farthest point.
template <int d>
double oscillation(const Twist<d>& velocity, double reach) {
  double spin = 0;
  if constexpr (d == 2)
    spin = std::abs(velocity(2));
  else
    spin = velocity.template segment<2>(3).norm();
  return std::abs(velocity(d - 1)) + spin * reach;
}

}  // namespace

template <int d>
HullExtent extent_of(const Surface<d>& surface) {
  const auto& x = surface.vertices;
  if (x.cols() == 0) return {};
  return {x.colwise().norm().maxCoeff(), (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).maxCoeff()};
}

template <int d>
void LandingStatistics<d>::add(double time, const LandingReading<d>& reading, const HullExtent& extent) {
  Angles angles = attitude_deg<d>(reading.rotation);
  for (std::size_t k = 0; begun_ && k < angles.size(); ++k) angles[k] = continued(angles[k], now_[k]);
  now_ = angles;
  time_ = time;
  begun_ = true;
  free_ = reading.free;
  height_ = reading.height;
  sinking_ = -reading.velocity(d - 1);
  settled_below_ = calm_share * std::sqrt(standard_gravity * extent.length);
  settled_window_ = 2 * std::numbers::pi * std::sqrt(extent.length / standard_gravity);

  const double tilt = tilt_deg<d>(reading.rotation);
  if (!(tilt > 90))
    over_since_ = -1;
  else if (over_since_ < 0)
    over_since_ = time;

  const bool wet = reading.wetted > 0;
  if (first_contact_ < 0) {
    if (!wet) return;
    first_contact_ = time;
  }
  const bool was_dry = !dry_.empty() && dry_.back()[1] < 0;
  if (!wet && !was_dry) dry_.push_back({time, -1});
  if (wet && was_dry) dry_.back()[1] = time;
  for (std::size_t k = 0; k < now_.size(); ++k) {
    lowest_[k].offer(-now_[k], time);
    highest_[k].offer(now_[k], time);
  }
  tilt_.offer(tilt, time);
  const bool calm = oscillation<d>(reading.velocity, extent.reach) < settled_below_;
  if (!calm)
    calm_since_ = -1;
  else if (calm_since_ < 0)
    calm_since_ = time;
}

template <int d>
LandingSummary LandingStatistics<d>::summary() const {
  LandingSummary summary;
  for (std::size_t k = 0; k < now_.size(); ++k) {
    if (d == 2 && k != 1) continue;
    AngleSummary angle{now_[k], lowest_[k], highest_[k]};
    angle.lowest.value = -angle.lowest.value;
    summary.attitude.emplace_back(attitude_names[k], angle);
  }
  summary.first_contact = first_contact_;
  summary.maximum_tilt = tilt_;
  summary.capsized_since = over_since_;
  summary.dry_intervals = dry_;
  summary.settled_below = settled_below_;
  summary.settled_window = settled_window_;
  summary.height = height_;
  summary.sinking = sinking_;
  if (free_ && calm_since_ >= 0 && time_ - calm_since_ >= settled_window_) summary.settled = calm_since_;
  return summary;
}

template class LandingStatistics<2>;
template class LandingStatistics<3>;
template HullExtent extent_of<2>(const Surface<2>&);
template HullExtent extent_of<3>(const Surface<3>&);

}  // namespace splashdown::apps
