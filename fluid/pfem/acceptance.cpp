// What a step may not do. A step that is refused is tried again with a smaller dt.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fluid/pfem/fluid_state.hpp"
#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {
namespace {

template <int d>
std::string position_text(const Vec<d>& x) {
  std::string text = fmt::format("{:.4g}", x[0]);
  for (int k = 1; k < d; ++k) text += fmt::format(", {:.4g}", x[k]);
  return "at (" + text + ") m";
}

}  // namespace

template <int d>
Status Fluid<d>::State::finite(const StepResult<d>& found) const {
  double sum = 0;
  for (const auto& v : trial.v_after) sum += v.sum();
  for (const auto& l : found.loads) sum += l.total().sum();
  return std::isfinite(sum) ? Status{} : Status{"the solution is not finite"};
}

template <int d>
Refusal Fluid<d>::State::refusal() const {
  if (!result.status.ok()) return {result.status};
  if (auto found = inverted_element(); !found.status.ok()) return found;
  return energy_from_nowhere();
}

// Elements that carry pressure deform by a fraction of themselves; `stable_dt` sees to it but for what remeshing
// and contact bring.
template <int d>
Refusal Fluid<d>::State::inverted_element() const {
  constexpr double most = 4;  // change of an edge over its length: far beyond any CFL number in use
  const double per_rate = dt / most;
  const auto margin = [&](std::size_t c) {
    double least = std::numeric_limits<double>::infinity();
    const auto& cell = work.mesh.cells[c];
    if (std::none_of(cell.begin(), cell.end(), [&](int n) { return equation.unknown()[n] >= 0; })) return least;
    for (int i = 0; i < d; ++i)
      for (int j = i + 1; j <= d; ++j) {
        const double change = per_rate * per_rate * (result.velocity[cell[i]] - result.velocity[cell[j]]).squaredNorm();
        least = std::min(least, squared_length(work, cell[i], cell[j]) - change);
      }
    return least;
  };
  const std::size_t count = work.mesh.cells.size();
  if (least_in_parallel(count, margin) >= 0) return {};
  std::size_t worst = 0;
  double least = margin(0);
  for (std::size_t c = 1; c < count; ++c)
    if (const double m = margin(c); m < least) least = m, worst = c;
  const auto& cell = work.mesh.cells[worst];
  Vec<d> mean = Vec<d>::Zero();
  for (int n : cell) mean += result.velocity[n] / (d + 1);
  int runs_away = -1;
  double most_apart = 0;
  for (int n : cell)
    if (const double apart = (result.velocity[n] - mean).squaredNorm(); may_fly_alone(n) && apart > most_apart)
      most_apart = apart, runs_away = n;
  return {{"an element turns over within the step: " + position_text<d>(work.nodes.x[cell[0]])}, runs_away};
}

// Repair and pressure are projections: what water and walls have after them they had before. Where worn films let them be
// none, the step is no solution.
//
//   T(v) - max(T(v_0), T(v*)) + sum_w I_w . (s_w* + s_w) / 2 - sum_i m_i (u_i - v_i) . u_i <= share of the energies in it
//
// I_w: impulse on wall w; v_0: before the repair, v*: before the pressure, v: after the pressure; u: after the motion along
// walls, which may take nodes along; the lesser of T(v), T(u).
template <int d>
Refusal Fluid<d>::State::energy_from_nowhere() const {
  double given = 0;
  for (std::size_t w = 0; w < walls.size(); ++w)
    given += (equation.impulse(w, trial.phi) + trial.handed[w]).dot(0.5 * (trial.s_unloaded[w] + trial.s_after[w]));
  double taken_along = 0;
  for (std::size_t i = 0; i < result.velocity.size(); ++i)
    if (!work.nodes.spray[i])
      taken_along += spec.density * equation.lumped_volume()[i] *
                     std::max(0.0, (result.velocity[i] - trial.v_after[i]).dot(result.velocity[i]));
  const double before = std::max(trial.energy_before, trial.energy_unloaded);
  const double scale = before + std::abs(given) + taken_along;
  double gain = std::numeric_limits<double>::infinity();
  for (const auto& v : {std::span<const Vec<d>>(result.velocity), std::span<const Vec<d>>(trial.v_after)}) {
    gain = std::min(gain, equation.kinetic_energy(v) + given - before - taken_along);
    if (gain <= most_gain * scale) return {};
  }
  std::size_t fastest = 0;
  double most = 0;
  for (std::size_t i = 0; i < result.velocity.size(); ++i) {
    const double change = work.nodes.spray[i] ? 0.0 : (result.velocity[i] - trial.v[i]).squaredNorm();
    if (change > most) most = change, fastest = i;
  }
  return {{fmt::format("the pressure makes energy: {:.2g} times what there was, {}", gain / scale,
                       position_text<d>(work.nodes.x[fastest]))},
          may_fly_alone(static_cast<int>(fastest)) ? static_cast<int>(fastest) : -1};
}

template struct Fluid<2>::State;
template struct Fluid<3>::State;

}  // namespace splashdown::fluid
