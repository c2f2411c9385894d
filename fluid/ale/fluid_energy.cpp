// What energy the fluid has, gives and gets. The weak equations tested with the mean velocity u of a step are its balance:
//
//   sum r . u = d/dt 1/2 int rho u^2 + 1/2 oint rho u^2 u . n - oint_open u . t + dissipation,
//   t = mu (grad u)^T n + 1/2 rho min(u . n, 0) u
//
// r: reactions of nodes whose velocities are given (equations/flow_equations.hpp), n out of the fluid.
#include "fluid/ale/fluid.hpp"
#include "fluid/ale/mesh/edge_rule.hpp"

namespace splashdown::ale {
/// Of what acts at nodes of sides, less what flows out with the fluid [W/m].
double AleFlow::power_through_sides() const {
  const double theta = fields_.theta;
  const Nodes u = theta * at_.head(2 * mesh_.size()).reshaped(2, mesh_.size()).matrix() + (1 - theta) * fields_.before;
  double power = equations_.open_power(fields_, at_);
  std::vector<char> seen(static_cast<std::size_t>(mesh_.size()), 0);
  for (const auto& edge : mesh_.boundary) {
    if (edge.side < 0) continue;
    at_edge_points(edge, fields_.x, [&](const EdgePoint& point) {
      Vec<2> there = Vec<2>::Zero();
      for (int k = 0; k < 3; ++k) there += point.N[k] * u.col(edge.nodes[static_cast<std::size_t>(k)]);
      power -= 0.5 * spec_.density * there.squaredNorm() * there.dot(point.normal);
    });
    for (const int a : edge.nodes) {
      auto& is_seen = seen[static_cast<std::size_t>(a)];
      if (is_seen || wall_of_[static_cast<std::size_t>(a)] >= 0) continue;
      is_seen = 1;
      power += reactions_.segment<2>(2 * a).dot(u.col(a));
    }
  }
  return power;
}

/// Of gravity, less that of the box without bodies: -rho int g . x = rho oint (g . x)^2/(2 g^2) g . n over hulls [J/m].
double AleFlow::potential_energy(const Nodes& places) const {
  if (spec_.gravity.isZero()) return 0;
  double sum = 0;
  for (const auto& edge : mesh_.boundary) {
    if (edge.wall < 0) continue;
    at_edge_points(edge, places, [&](const EdgePoint& point) {
      const double head = spec_.gravity.dot(point.x - spec_.max);
      sum -= head * head * spec_.gravity.dot(point.normal);
    });
  }
  return 0.5 * spec_.density * sum / spec_.gravity.squaredNorm();
}

/// Of the step that is accepted: work with the mean velocity of its ends, which is what fluid and bodies agree about.
void AleFlow::book_work() {
  const double theta = fields_.theta;
  Eigen::VectorXd before(coordinates(moved_.size()));
  for (std::size_t w = 0; w < moved_.size(); ++w)
    before.segment(moved_[w].first, state_.rates[w].size()) = state_.rates[w];
  ledger_.work_on_walls += impulse_.dot(theta * rates_ + (1 - theta) * before);
  if (!spec_.scheme.is_steady) ledger_.work_of_effects += kick_ * power_through_sides();
}

/// At t_{n-1/2} as velocities are, the mean of both steps' places. A flow that is steady has no way by which its energy came: all of
/// it is given.
void AleFlow::book_energy(const Nodes& places_before) {
  const auto between = [&](auto&& energy) {
    const double now = energy(x_);
    return x_ == places_before ? now : 0.5 * (now + energy(places_before));
  };
  const double before = ledger_.kinetic_energy;
  ledger_.kinetic_energy = between([&](const Nodes& x) { return equations_.kinetic_energy(x, state_.velocity); });
  ledger_.potential_energy = between([&](const Nodes& x) { return potential_energy(x); });
  if (spec_.scheme.is_steady) ledger_.work_of_effects += ledger_.kinetic_energy - before;
}

}  // namespace splashdown::ale
