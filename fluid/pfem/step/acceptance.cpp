// What a step may not do. A step that is refused is tried again with a smaller dt.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fluid/pfem/parallel.hpp"
#include "fluid/pfem/step/step.hpp"

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
Status WaterStep<d>::finite(const StepResult<d>& found) const {
  double sum = 0;
  for (const auto& v : trial_.v_after) sum += v.sum();
  for (const auto& l : found.loads) sum += l.total().sum();
  return std::isfinite(sum) ? Status{} : Status{"the solution is not finite"};
}

template <int d>
Refusal WaterStep<d>::refusal(const StepResult<d>& found) const {
  if (!found.status.ok()) return {found.status};
  if (auto turned = inverted_element(found); !turned.status.ok()) return turned;
  return energy_from_nowhere(found);
}

// Elements that carry pressure deform by a fraction of themselves; `stable_dt` sees to it but for what remeshing
// and contact bring.
template <int d>
Refusal WaterStep<d>::inverted_element(const StepResult<d>& found) const {
  constexpr double most = 4;  // change of an edge over its length: far beyond any CFL number in use
  const double per_rate = dt_ / most;
  const auto margin = [&](std::size_t c) {
    double least = std::numeric_limits<double>::infinity();
    const auto& cell = water_.work.mesh.cells[c];
    if (std::none_of(cell.begin(), cell.end(), [&](int n) { return equation_.unknown()[n] >= 0; })) return least;
    for (int i = 0; i < d; ++i)
      for (int j = i + 1; j <= d; ++j) {
        const double change = per_rate * per_rate * (found.velocity[cell[i]] - found.velocity[cell[j]]).squaredNorm();
        least = std::min(least, squared_length(water_.work, cell[i], cell[j]) - change);
      }
    return least;
  };
  const std::size_t count = water_.work.mesh.cells.size();
  if (least_in_parallel(count, margin) >= 0) return {};
  std::size_t worst = 0;
  double least = margin(0);
  for (std::size_t c = 1; c < count; ++c)
    if (const double m = margin(c); m < least) least = m, worst = c;
  const auto& cell = water_.work.mesh.cells[worst];
  Vec<d> mean = Vec<d>::Zero();
  for (int n : cell) mean += found.velocity[n] / (d + 1);
  int runs_away = -1;
  double most_apart = 0;
  for (int n : cell)
    if (const double apart = (found.velocity[n] - mean).squaredNorm(); may_fly_alone(n) && apart > most_apart)
      most_apart = apart, runs_away = n;
  return {{"an element turns over within the step: " + position_text<d>(water_.work.nodes.x[cell[0]])}, runs_away};
}

// Repair and pressure are projections: what water and walls have after them they had before. Where worn films let them be
// none, the step is no solution.
//
//   T(v) - max(T(v_0), T(v*)) + sum_w I_w . (s_w* + s_w) / 2 - sum_i m_i (u_i - v_i) . u_i <= share of the energies in it
//
// with what the liquid stores as it is compressed. I_w: impulse on wall w; v_0: before the repair, v*: before the pressure, v: after the pressure; u: after the motion along
// walls, which may take nodes along; the lesser of T(v), T(u).
template <int d>
Refusal WaterStep<d>::energy_from_nowhere(const StepResult<d>& found) const {
  double given = 0;
  for (std::size_t w = 0; w < water_.walls.size(); ++w)
    given +=
        (equation_.impulse(w, trial_.phi) + trial_.handed[w]).dot(0.5 * (trial_.s_unloaded[w] + trial_.s_after[w]));
  double taken_along = 0;
  for (std::size_t i = 0; i < found.velocity.size(); ++i)
    if (!water_.work.nodes.spray[i])
      taken_along += water_.spec.density * equation_.lumped_mass()[i] *
                     std::max(0.0, (found.velocity[i] - trial_.v_after[i]).dot(found.velocity[i]));
  const double worked = std::abs(given) + taken_along;
  if (compression_) given += compression_.stored(equation_.unknown(), trial_.phi);
  const double before = std::max(trial_.energy_before, trial_.energy_unloaded);
  const double scale = before + std::abs(given) + taken_along;
  // Kinetic energy is half a step older than what is stored: waves of few steps a period swing by that. Explosions do more.
  constexpr double most_swing = 0.5;
  if (compression_) {
    const auto [stored, then] =
        compression_.internal_energies(equation_.lumped_volume(), equation_.unknown(), trial_.phi);
    if (equation_.kinetic_energy(trial_.v_after) + then > (1 + most_swing) * (before + stored + worked))
      return {{"pressure and compression make energy"}, -1};
  }
  double gain = std::numeric_limits<double>::infinity();
  for (const auto& v : {std::span<const Vec<d>>(found.velocity), std::span<const Vec<d>>(trial_.v_after)}) {
    gain = std::min(gain, equation_.kinetic_energy(v) + given - before - taken_along);
    if (gain <= most_gain * scale) return {};
  }
  std::size_t fastest = 0;
  double most = 0;
  for (std::size_t i = 0; i < found.velocity.size(); ++i) {
    const double change = water_.work.nodes.spray[i] ? 0.0 : (found.velocity[i] - trial_.v[i]).squaredNorm();
    if (change > most) most = change, fastest = i;
  }
  return {{fmt::format("the pressure makes energy: {:.2g} times what there was, {}", gain / scale,
                       position_text<d>(water_.work.nodes.x[fastest]))},
          may_fly_alone(static_cast<int>(fastest)) ? static_cast<int>(fastest) : -1};
}

template class WaterStep<2>;
template class WaterStep<3>;

}  // namespace splashdown::fluid
