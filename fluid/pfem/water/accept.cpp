// What the water takes in of a step: where its nodes are and what they carry, and what the motion has made of its volume.
#include <algorithm>
#include <cmath>
#include <limits>

#include "fluid/pfem/contact/ventilation.hpp"
#include "fluid/pfem/mesh/conservation/volume_correction.hpp"
#include "fluid/pfem/parallel.hpp"
#include "fluid/pfem/water/water.hpp"

namespace splashdown::fluid {
namespace {

// Where films turn over, cells count as less than nothing, nodes as nothing.
template <int d>
void carry(Nodes<d>& nodes, std::span<const double> volumes) {
  in_parallel(nodes.size(), [&](std::size_t i) {
    if (nodes.spray[i]) return;
    const double now = std::max(0.0, volumes[i]);
    nodes.owed[i] += nodes.volume[i] - now;
    nodes.volume[i] = now;
  });
}

// Where p = 0 is held, no pressure keeps a node's volume. What it gains while it runs ahead of its neighbours is their
// water, and comes with their momentum. A node that has lost all of its volume has no momentum of its own left: it goes with its
// neighbours. `before`: nodal volumes, before the motion.
template <int d>
void entrain(Nodes<d>& nodes, const Mesh<d>& mesh, const NodeCells<d>& around, std::span<const int> unknown,
             std::span<const double> before) {
  struct Change {
    std::size_t node;
    Vec<d> v;
  };
  std::vector<Change> changes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double gained = nodes.volume[i] - before[i];
    const bool is_empty = nodes.volume[i] == 0;
    if (nodes.spray[i] || nodes.tie[i].sharp() || !(is_empty || (unknown[i] < 0 && gained > 0))) continue;
    VelocityMoments<d> water;  // around it
    for (const auto [c, k] : around.around(i)) {
      const double share = std::max(0.0, volume<d>(corners(nodes.x, mesh.cells[c])));
      for (int n : mesh.cells[c])
        if (n != static_cast<int>(i)) water += VelocityMoments<d>::of(is_empty ? nodes.volume[n] : share, nodes.v[n]);
    }
    if (!(water.volume > 0)) continue;
    const Vec<d> v = water.mean_velocity();
    changes.push_back({i, is_empty ? v : Vec<d>((before[i] * nodes.v[i] + gained * v) / nodes.volume[i])});
  }
  for (const Change& change : changes) nodes.v[change.node] = change.v;
}

// What terms of effects have made of the volume is no debt of the mesh: its sum [m^d].
template <int d>
double take_in(Nodes<d>& nodes, std::span<const double> meant) {
  double sum = 0;
  for (std::size_t i = 0; i < meant.size(); ++i) {
    nodes.owed[i] += meant[i];
    sum += meant[i];
  }
  return sum;
}

}  // namespace

template <int d>
void Water<d>::accept(const Motion<d>& by, std::span<const WallPlace<d>> poses) {
  const StepResult<d>& found = by.found;
  work.ledger = found.ledger;
  work.nodes.p = found.carried;
  work.nodes.compression = by.compression;
  Ledger& ledger = work.ledger;
  const double before = ledger.volume;
  typename WallMotion<d>::Moved moved;
  by.at_walls.move(by.v, poses, by.dt, moved);
  Nodes<d>& nodes = work.nodes;
  const double acceleration_dt = least_in_parallel(nodes.size(), [&](std::size_t i) {
    if (nodes.spray[i]) return std::numeric_limits<double>::infinity();
    const double a = (moved.u[i] - nodes.v[i]).norm() / by.kick;
    return 0.5 * std::sqrt(nodes.h[i] / (a + 1e-300));
  });
  by.at_walls.convect(moved.x, by.dt, moved.u);
  nodes.x = moved.x;
  nodes.v = moved.u;
  nodes.tie = moved.tie;
  const WallsAt<d> arrived{walls, poses};
  std::vector<double> moved_volumes;
  by.around.sum(volume_shares(work.mesh, nodes.x), moved_volumes);
  carry<d>(nodes, moved_volumes);
  entrain(nodes, work.mesh, by.around, by.unknown, by.lumped_volume);
  follow_hulls(poses);
  const double swept = water(), meant = take_in(nodes, by.meant);
  carry<d>(nodes, return_volume(nodes, work.mesh, arrived, free_water, moved_volumes, by.lumped_volume));
  free_water.give_back(by.unloaded, nodes.volume, nodes.v);
  average_wall_pressure<d>(nodes, work.mesh, arrived, found.wall_velocities, by.unknown, by.repaired, by.kick);
  ventilate<d>(nodes, work.mesh, arrived, found.wall_velocities, spec.density, gravity().norm());
  ledger.volume = water();
  ledger.time_integration += swept - before - meant;
  ledger.volume_of_effects += meant;
  ledger.returned += ledger.volume - swept;
  ledger.energy_repair += by.energy_of_repair;
  ledger.work_on_walls = now.ledger.work_on_walls + by.kick * found.power_on_walls;
  ledger.work_of_effects = now.ledger.work_of_effects;
  for (const double power : found.power_of_effects) ledger.work_of_effects += by.kick * power;
  work.acceleration_dt = acceleration_dt;
  work.time += by.dt;
  work.dt = by.dt;
  work.poses.assign(poses.begin(), poses.end());
  work.velocity = found.wall_velocities;
  now = std::move(work);
  prepared = false;
}

template struct Water<2>;
template struct Water<3>;

}  // namespace splashdown::fluid
