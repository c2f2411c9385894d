#include "apps/statistics/attitude.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splashdown::apps {

namespace {

constexpr double degrees = 180 / std::numbers::pi;

}  // namespace

template <int d>
Angles attitude_deg(const Eigen::Matrix<double, d, d>& rotation) {
  const auto& r = rotation;
  if constexpr (d == 2)
    return {0, degrees * std::atan2(r(1, 0), r(0, 0)), 0};
  else
    return {degrees * std::atan2(r(2, 1), r(2, 2)), degrees * std::atan2(r(2, 0), std::hypot(r(0, 0), r(1, 0))),
            degrees * std::atan2(r(1, 0), r(0, 0))};
}

double continued(double angle, double before) { return angle + 360 * std::round((before - angle) / 360); }

template <int d>
double tilt_deg(const Eigen::Matrix<double, d, d>& rotation) {
  // By both projections: the arc cosine alone has lost half of the digits near 0 and 180 degrees.
  const auto up = rotation.col(d - 1);
  return degrees * std::atan2(up.template head<d - 1>().norm(), up(d - 1));
}

template Angles attitude_deg<2>(const Eigen::Matrix<double, 2, 2>&);
template Angles attitude_deg<3>(const Eigen::Matrix<double, 3, 3>&);
template double tilt_deg<2>(const Eigen::Matrix<double, 2, 2>&);
template double tilt_deg<3>(const Eigen::Matrix<double, 3, 3>&);

}  // namespace splashdown::apps
