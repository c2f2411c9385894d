#include "fluid/pfem/step/monolithic/monolithic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fluid/pfem/linear/generalised_conjugate_residual.hpp"

namespace splashdown::fluid {
namespace {

// Of a velocity: what sums over its neighbours round off. Less has no direction.
constexpr double roundoff_of_sums = 1e-12;
// What the repair leaves of its flux the pressure takes out.
constexpr double repaired_to = 1e-2;
// Of what the pressure does to velocities: a step that leaves more is none.
constexpr double most_left = 1e-2;

template <int d>
std::vector<Vec<d>> difference(std::span<const Vec<d>> a, std::span<const Vec<d>> b) {
  std::vector<Vec<d>> out(a.size());
  in_parallel(a.size(), [&](std::size_t i) { out[i] = a[i] - b[i]; });
  return out;
}

}  // namespace

// In a frame that moves with the water and without viscosity tau is half the interval over which the pressure acts. Elements
// are as large as the ball of their volume.
template <int d>
std::vector<double> Monolithic<d>::shares() const {
  constexpr double half = 0.5;
  const auto& cells = water_.work.mesh.cells;
  std::vector<double> theta(cells.size(), half);
  double diffusivity = 0;
  for (const auto& effect : water_.effects)
    if (effect->follows()) diffusivity += effect->diffusivity(water_.spec.density);
  if (!(spec_.speed > 0) && diffusivity == 0) return theta;
  constexpr double unit_ball = d == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3;
  in_parallel(cells.size(), [&](std::size_t c) {
    const double volume = std::max(0.0, fluid::volume<d>(corners(water_.work.nodes.x, cells[c])));
    const double radius = std::pow(volume / unit_ball, 1.0 / d);
    theta[c] = spec_.speed > 0 ? radius / (spec_.speed * kick_)
                               : 1 / std::hypot(2.0, 3 * diffusivity * kick_ / (radius * radius));
  });
  return theta;
}

template <int d>
template <class Find, class Apply>
auto Monolithic<d>::converge(Find find, Apply add, double enough) -> Left {
  constexpr int passes = 4, most = 40;  // of Picard; steps in one, twice what any mesh has needed to 1e-8
  Correction<d> left;
  for (int pass = 0;; ++pass) {
    if (auto status = find(left); !status.ok()) return {status};
    if (const double size = left.dot(left); size <= enough || pass == passes) return {{}, size};
    GeneralisedConjugateResidual<Correction<d>> iteration(left);
    for (int k = 0; k < most && iteration.size() > enough; ++k) {
      const Correction<d> tried = iteration.left();
      add(tried, 1);
      if (auto status = find(left); !status.ok()) return {status};
      iteration.step(left);
      add(tried, -1);
      add(iteration.last(), 1);
    }
  }
}

template <int d>
void Monolithic<d>::find_repair(const Unrepaired& from, const Unrepaired* seen, Repair& found) {
  const auto& held = equation_.held();
  const auto theta = shares();
  auto& impulses = found.impulses;
  auto& free = found.free;  // as if no wall held them
  trial_.v = from.free, trial_.s_before = from.s, trial_.answer = from.answer;
  flux_before(impulses, {}, seen);
  Correction<d> first;
  first.residual = impulses;
  if (!equation_.solve(impulses, closely)) {
    found.left.status = {"the pressure solve failed"};
    return;
  }
  first.impulse = impulses;
  found.enough =
      std::max(repaired_to * repaired_to * first.dot(first), roundoff_of_sums * roundoff_of_sums * from.energy);
  answer_to(impulses, trial_.s_before, equation_.on_modes(held.excess(trial_.v, trial_.s_before)));
  const auto find = [&](Correction<d>& left) {
    free = from.free;
    equation_.accelerate(impulses, free);
    trial_.v = free;
    held.hold(trial_.v, trial_.s_before);
    flux_before(left.residual, impulses, seen);
    equation_.stabilise(impulses, difference<d>(free, from.free), theta, left.residual);
    return ask(left);
  };
  const auto add = [&](const Correction<d>& correction, double share) {
    for (std::size_t i = 0; i < impulses.size(); ++i) impulses[i] += share * correction.impulse[i];
    for (std::size_t w = 0; w < trial_.s_before.size(); ++w) trial_.s_before[w] += share * correction.walls[w];
    if (equation_.mode_count() > 0) trial_.answer += share * correction.answer;
  };
  found.left = converge(find, add, found.enough);
}

// Where an impulse throws nodes, the place that they seem to come from may run away from the iteration. It is then left where
// the carried velocities see it: no smaller step would mend it, because it is that of the last step.
template <int d>
Status Monolithic<d>::repair() {
  const auto scope = water_.timer.scope(Phase::pressure);
  auto from = begin_repair();
  Repair found{.impulses = trial_.r, .free = {}, .left = {}};
  find_repair(from, nullptr, found);
  if (found.left.status.ok() && found.left.size > found.enough) find_repair(from, &from, found);
  if (!found.left.status.ok()) return found.left.status;
  take_repair(from, found.impulses, found.free, equation_.held().excess(found.free, trial_.s_before));
  return {};
}

template <int d>
Status Monolithic<d>::correct(std::span<const double> previous) {
  const auto theta = shares();
  const auto change = [&] { return has_followers() ? pushed() : difference<d>(trial_.v_after, trial_.v); };
  const auto find = [&](Correction<d>& left) -> Status {
    if (!move_nodes()) return {"an effect could not follow"};
    what_is_left(previous, left.residual);
    equation_.stabilise(trial_.phi, change(), theta, left.residual);
    return ask(left);
  };
  if (!move_nodes()) return {"an effect could not follow"};
  trial_.energy_unloaded = equation_.kinetic_energy(trial_.v);
  // Twice the energy of what the pressure does to velocities is r^T A^-1 r of what it takes out.
  const double done = 2 * equation_.kinetic_energy(change());
  const double enough =
      std::max(spec_.tolerance * spec_.tolerance * done, roundoff_of_sums * roundoff_of_sums * trial_.energy_unloaded);
  const auto add = [this](const Correction<d>& correction, double share) { apply(correction, share); };
  const Left left = converge(find, add, enough);
  if (!left.status.ok()) return left.status;
  if (left.size > std::max(enough, most_left * most_left * done)) return {"velocity and pressure do not agree"};
  settle_bodies();
  trial_.uncorrected = trial_.phi;  // nothing in it alternates
  return {};
}

template class Monolithic<2>;
template class Monolithic<3>;

}  // namespace splashdown::fluid
