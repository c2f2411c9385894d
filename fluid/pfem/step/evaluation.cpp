// What a step reports of its solution: loads, pressures, energies, work.
#include <algorithm>

#include "fluid/pfem/parallel.hpp"
#include "fluid/pfem/step/step.hpp"

namespace splashdown::fluid {

// Loads, pressures and energies of the solution.
template <int d>
void WaterStep<d>::evaluate(StepResult<d>& found) {
  const auto scope = water_.timer.scope(Phase::pressure);
  found.wall_velocities = trial_.s_after;
  found.velocity = trial_.moved.u;
  found.interface_impulse = equation_.laplacian().means(trial_.phi);
  evaluate_loads(found);
  evaluate_pressure(found);
  evaluate_energies(found);
  found.status = finite(found);
}

template <int d>
void WaterStep<d>::evaluate_loads(StepResult<d>& found) const {
  found.loads.assign(water_.walls.size(), {});
  std::vector<WallImpulse<d>> answered;  // with the pressure
  for (std::size_t w = 0; w < water_.walls.size(); ++w) {
    const WallImpulse<d> repair = equation_.impulse(w, trial_.repaired), physical = equation_.impulse(w, trial_.phi);
    const WallImpulse<d> acting = (physical + trial_.on_walls[w] + trial_.handed[w]) / kick_,
                         of_repair = (repair + trial_.repair_handed[w]) / kick_;
    WallLoad<d>& load = found.loads[w];
    load.physical = resultant<d>(water_.work.poses[w], acting);
    load.repair = resultant<d>(water_.work.poses[w], of_repair);
    load.wetted = water_.work.wetted[w];
    const WallImpulse<d> total = acting + of_repair;
    found.power_on_walls += total.dot(0.5 * (trial_.s_after[w] + water_.work.velocity[w]));
    found.at_vertices.push_back(total.vertices);
    answered.push_back(repair + physical + trial_.handed[w] + trial_.repair_handed[w]);
  }
  found.imbalance.assign(water_.walls.size(), Twist<d>::Zero());
  if (equation_.mode_count() > 0)
    equation_.move(
        equation_.response(equation_.on_modes(answered) + trial_.known - equation_.inertia() * trial_.answer),
        found.imbalance);
}

// The corrections' operator D M^-1 D^T hardly sees pressures that change their sign from node to node, so that what it makes of
// noise has them; the Laplacian of the pressure solve allows none. What a step reports is
//
//   p = (phi_0 + S (phi - phi_0)) / kick,   (S q)_i = sum_c V_c mean_c(q) / sum_c V_c
//
// over the cells around a node: loads and motions are those of phi.
template <int d>
void WaterStep<d>::evaluate_pressure(StepResult<d>& found) const {
  const std::size_t count = water_.work.nodes.size();
  found.carried.assign(count, 0.0);
  found.repair_pressure.assign(count, 0.0);
  std::vector<double> corrected(count, 0.0);  // by, [Pa s]
  for (std::size_t i = 0; i < count; ++i) {
    const int k = equation_.unknown()[i];
    if (k < 0) continue;
    found.carried[i] = trial_.phi[k] / kick_;
    found.repair_pressure[i] = trial_.repaired[k] / kick_;
    corrected[i] = trial_.phi[k] - trial_.uncorrected[k];
  }
  const auto& cells = water_.work.mesh.cells;
  std::vector<double> weight(cells.size()), weighted(cells.size());
  in_parallel(cells.size(), [&](std::size_t c) {
    double mean = 0;
    for (int n : cells[c]) mean += corrected[n] / (d + 1);
    weight[c] = std::max(0.0, volume<d>(corners(water_.work.nodes.x, cells[c])));
    weighted[c] = weight[c] * mean;
  });
  found.pressure.assign(count, 0.0);
  in_parallel(count, [&](std::size_t i) {
    if (equation_.unknown()[i] < 0) return;
    double sum = 0, of_all = 0;
    for (const auto [c, k] : equation_.around().around(i)) sum += weighted[c], of_all += weight[c];
    const double smooth = of_all > 0 ? sum / of_all : 0.0;
    found.pressure[i] = found.carried[i] + (smooth - corrected[i]) / kick_;
  });
  for (std::size_t i = 0; i < trial_.of_surface.size(); ++i) found.pressure[i] += trial_.of_surface[i] / kick_;
}

template <int d>
void WaterStep<d>::evaluate_energies(StepResult<d>& found) const {
  const Nodes<d>& nodes = water_.work.nodes;
  Ledger& ledger = found.ledger;
  ledger = water_.work.ledger;
  ledger.work_on_walls += 0.5 * water_.work.dt * found.power_on_walls;
  evaluate_work(found);
  for (const double power : found.power_of_effects) ledger.work_of_effects += 0.5 * water_.work.dt * power;
  ledger.kinetic_energy = 0;
  ledger.potential_energy = ledger.chord_energy;
  if (compression_)
    ledger.potential_energy += compression_.energy(equation_.lumped_volume(), equation_.unknown(), trial_.phi);
  std::vector<Vec<d>> v_n(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double mass = water_.spec.density * (nodes.spray[i] ? nodes.volume[i] : equation_.lumped_mass()[i]);
    v_n[i] = at_t_n(nodes.v[i], found.velocity[i]);
    if (nodes.spray[i]) ledger.kinetic_energy += 0.5 * mass * v_n[i].squaredNorm();
    for (const auto& effect : water_.effects) ledger.potential_energy += mass * effect->potential(nodes.x[i]);
  }
  ledger.kinetic_energy += equation_.kinetic_energy(v_n);
}

// T(a + dv/2) - T(a - dv/2) with the mean a of the velocities before and after the step: what the change dv brings beside the
// pressure, with the mass that the pressure moves. Walls give the rest.
template <int d>
void WaterStep<d>::evaluate_work(StepResult<d>& found) const {
  found.power_of_effects.clear();
  if (trial_.booked.empty()) return;
  std::vector<Vec<d>> low(trial_.v.size()), high(trial_.v.size());
  for (const auto& booked : trial_.booked) {
    in_parallel(low.size(), [&](std::size_t i) {
      const Vec<d> mean = 0.5 * (water_.work.nodes.v[i] + found.velocity[i]), half = 0.5 * booked.change[i];
      low[i] = mean - half, high[i] = mean + half;
    });
    double given = equation_.kinetic_energy(high) - equation_.kinetic_energy(low);
    given += energy_of_drops(high) - energy_of_drops(low);
    for (std::size_t w = 0; w < water_.walls.size(); ++w)
      given += booked.on_walls[w].dot(0.5 * (trial_.s_after[w] + water_.work.velocity[w]));
    found.power_of_effects.push_back(given / kick_);
  }
}

template class WaterStep<2>;
template class WaterStep<3>;

}  // namespace splashdown::fluid
