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
  auto& r = trial_.r;
  const auto& held = equation_.held();
  auto from = begin_repair();
  Eigen::VectorXd excess = equation_.on_modes(held.excess(trial_.v, trial_.s_before));
  std::vector<Vec<d>> free = trial_.v;  // as if no wall held them
  for (int k = 0; k < repairs; ++k) {
    flux_before(r, trial_.repaired);
    if (!equation_.solve(r, roughly)) return {"the pressure solve failed"};
    auto handed = held.excess(free, trial_.s_before);
    answer_to(r, trial_.s_before, excess);
    excess.setZero();  // what follows is linear, and answered with the pressure
    equation_.accelerate(r, free);
    const auto handed_after = held.excess(free, trial_.s_before);
    for (std::size_t w = 0; w < handed.size(); ++w) handed[w] = handed_after[w] - (k > 0) * handed[w];
    take_repair(from, r, free, handed);
  }
  return {};
}

// The matrix stands for what `accelerate` and `move` make of an impulse, and is the preconditioner of what they make of it.
template <int d>
Status Fractional<d>::correct(std::span<const double> previous) {
  trial_.uncorrected = trial_.phi;
  Correction<d> left;
  const auto find = [&]() -> Status {
    if (!move_nodes()) return {"an effect could not follow"};
    what_is_left(previous, left.residual);
    return ask(left);
  };
  if (auto status = find(); !status.ok()) return status;
  trial_.energy_unloaded = equation_.kinetic_energy(trial_.v);
  const double least = roundoff * roundoff * trial_.energy_unloaded;
  ConjugateResidual<Correction<d>> iteration(left);
  for (int k = 1; k < corrections<d> && iteration.size() > least; ++k) {
    const Correction<d> tried = iteration.left();
    apply(tried, 1);
    if (auto status = find(); !status.ok()) return status;
    iteration.step(left);
    apply(tried, -1);
    apply(iteration.last(), 1);
  }
  apply(iteration.left(), std::clamp(iteration.share(), 0.0, 1.0));
  if (!move_nodes()) return {"an effect could not follow"};
  return {};
}

template class Fractional<2>;
template class Fractional<3>;

}  // namespace splashdown::fluid
