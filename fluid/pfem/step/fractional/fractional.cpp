#include "fluid/pfem/step/fractional/fractional.hpp"

#include <algorithm>

#include "fluid/pfem/linear/conjugate_residual.hpp"

namespace splashdown::fluid {
namespace {

constexpr int repairs = 2;
// Of a velocity: what sums over its neighbours round off. Corrections below it have no direction.
constexpr double roundoff = 1e-12;

}  // namespace

// The carried velocity, seen at t_{n-1/2} on the new mesh, creates no volume. Nodes that have come to a wall's edge since
// then share their momentum with it.
template <int d>
Status Fractional<d>::repair() {
  const auto scope = water_.timer.scope(Phase::pressure);
  auto& v = trial_.v;
  auto& r = trial_.r;
  auto& s_before = trial_.s_before;
  const auto& held = equation_.held();
  trial_.repaired.assign(equation_.size(), 0.0);
  trial_.repair_handed.assign(water_.walls.size(), Wrench<d>::Zero());
  Eigen::VectorXd excess = equation_.on_modes(held.excess(v, s_before));
  std::vector<Vec<d>> free = v;  // as if no wall held them
  double energy = equation_.kinetic_energy(v);
  const double drops = energy_of_drops(v);
  trial_.energy_before = energy + drops;
  for (int k = 0; k < repairs; ++k) {
    middle(v, -0.5 * water_.work.dt);
    equation_.flux_residual(trial_.x_mid, v, s_before,
                            water_.centres(water_.moved_poses(s_before, -0.5 * water_.work.dt)), r);
    if (!equation_.solve(r, roughly)) return {"the pressure solve failed"};
    const auto s_0 = s_before;
    const auto free_0 = free;
    const Eigen::VectorXd answer_0 = trial_.answer;
    const double energy_0 = energy;
    auto handed = held.excess(free, s_before);
    answer_to(r, s_before, excess);
    excess.setZero();  // what follows is linear, and answered with the pressure
    equation_.accelerate(r, free);
    const auto handed_after = held.excess(free, s_before);
    for (std::size_t w = 0; w < handed.size(); ++w) handed[w] = handed_after[w] - (k > 0) * handed[w];
    v = free;
    held.hold(v, s_before);
    // It is a projection: what it gives to the water it takes from bodies. Where films are worn to nodes of hardly any mass
    // the truncated one may not be, and counts by a half, a quarter, not at all.
    double taken = 1;
    auto gains = [&] {
      double given = work_of(r, s_0, s_before);
      for (std::size_t w = 0; w < handed.size(); ++w) given += taken * handed[w].dot(0.5 * (s_0[w] + s_before[w]));
      return energy + given > energy_0 + most_gain * (energy_0 + std::abs(given));
    };
    energy = equation_.kinetic_energy(v);
    while (taken > 0 && gains()) {
      const double less = taken > 0.25 ? 0.5 : 0.0;
      taken *= less;
      for (double& impulse : r) impulse *= less;
      for (std::size_t w = 0; w < s_0.size(); ++w) s_before[w] = s_0[w] + less * (s_before[w] - s_0[w]);
      for (std::size_t i = 0; i < v.size(); ++i) free[i] = free_0[i] + less * (free[i] - free_0[i]);
      trial_.answer = answer_0 + less * (trial_.answer - answer_0);
      v = free;
      held.hold(v, s_before);
      energy = equation_.kinetic_energy(v);
    }
    for (std::size_t w = 0; w < handed.size(); ++w) trial_.repair_handed[w] += taken * handed[w];
    for (int i = 0; i < equation_.size(); ++i) trial_.repaired[i] += r[i];
  }
  trial_.energy_repaired = energy + drops;
  return {};
}

// The matrix stands for what `accelerate` and `move` make of an impulse, and is the preconditioner of what they make of it.
template <int d>
Status Fractional<d>::correct(std::span<const double> previous) {
  trial_.uncorrected = trial_.phi;
  Correction<d> left;
  move_nodes();
  if (auto status = what_is_left(previous, left); !status.ok()) return status;
  trial_.energy_unloaded = equation_.kinetic_energy(trial_.v);
  const double least = roundoff * roundoff * trial_.energy_unloaded;
  ConjugateResidual<Correction<d>> iteration(left);
  for (int k = 1; k < corrections<d> && iteration.size() > least; ++k) {
    const Correction<d> tried = iteration.left();
    apply(tried, 1);
    move_nodes();
    if (auto status = what_is_left(previous, left); !status.ok()) return status;
    iteration.step(left);
    apply(tried, -1);
    apply(iteration.last(), 1);
  }
  apply(iteration.left(), std::clamp(iteration.share(), 0.0, 1.0));
  move_nodes();
  return {};
}

template class Fractional<2>;
template class Fractional<3>;

}  // namespace splashdown::fluid
