// Conditions on velocities as rows of matrices. Internal to the rigid-body room.
#pragma once

#include <algorithm>
#include <vector>

#include "rigid/embedding.hpp"
#include "rigid/joint.hpp"

namespace splashdown::rigid {

/// Left sides, a row each, of the velocities of so many bodies.
template <int d>
Eigen::MatrixXd rows_of(const std::vector<Condition<d>>& conditions, Eigen::Index bodies) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(conditions.size()), freedoms<d> * bodies);
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    const auto& c = conditions[static_cast<std::size_t>(r)];
    rows.template block<1, freedoms<d>>(r, freedoms<d> * static_cast<Eigen::Index>(c.body)) += c.first.transpose();
    if (c.other)
      rows.template block<1, freedoms<d>>(r, freedoms<d> * static_cast<Eigen::Index>(*c.other)) += c.second.transpose();
  }
  return rows;
}

/// Right sides, one a condition [m/s, rad/s].
template <int d>
Eigen::VectorXd rates_of(const std::vector<Condition<d>>& conditions) {
  Eigen::VectorXd rates(static_cast<Eigen::Index>(conditions.size()));
  std::ranges::transform(conditions, rates.begin(), &Condition<d>::rate);
  return rates;
}

/// What Bullet says in space, of the bodies' own freedoms.
template <int d>
Condition<d> projected_condition(const Condition<3>& c) {
  const auto lift = embedding<d>();
  return {c.body, c.other, lift.transpose() * c.first, lift.transpose() * c.second, c.rate};
}

/// A stop of a joint as conditions of the coordinate `at`, >= rate within a step dt.
template <int d>
void add_stops(const JointSpec& joint, const JointCoordinate<d>& at, double dt, std::vector<Condition<d>>& conditions) {
  for (const double way : {1.0, -1.0}) {
    const double stop = joint.stops[way > 0 ? 0 : 1];
    if (!std::isfinite(stop)) continue;
    conditions.push_back(
        {at.rate.body, at.rate.other, way * at.rate.first, way * at.rate.second, way * (stop - at.q) / dt});
  }
}

}  // namespace splashdown::rigid
