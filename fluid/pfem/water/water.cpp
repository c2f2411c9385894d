#include "fluid/pfem/water/water.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fluid/pfem/initial/initial.hpp"
#include "fluid/pfem/mesh/parts.hpp"
#include "fluid/pfem/parallel.hpp"
#include "fluid/pfem/water/collision_bound.hpp"
#include "fluid/pfem/water/wave_bound.hpp"

namespace splashdown::fluid {

template <int d>
Water<d>::Water(FluidSpec<d> from, std::vector<std::unique_ptr<Effect<d>>> with)
    : spec(std::move(from)), effects(std::move(with)) {
  for (const auto& effect : effects) timer.add(effect->name());
  std::vector<Eigen::Index> vertices;  // of walls that deform
  for (const auto& w : spec.walls) {
    walls.emplace_back(w);
    now.poses.push_back(walls.back().place());
    now.velocity.push_back(walls.back().velocity());
    vertices.push_back(w.deforms ? w.surface.vertices.cols() : 0);
  }
  layout = WallLayout<d>(vertices);
  auto liquid = fill<d>(spec, walls_at(now.poses));
  now.nodes = std::move(liquid.nodes);
  now.mesh = std::move(liquid.mesh);
  now.nodes.volume = nodal_volumes(now.mesh, now.nodes.x);
  now.nodes.part = parts_of(now.mesh, now.nodes.size());
  now.chords.assign(walls.size(), 0.0);
  now.displaced = displaced_volumes(now.mesh, now.nodes.x, walls.size(), mirror());
  now.wetted = wetted_measures(now.mesh, now.nodes.x, walls.size());
  now.ledger.volume = now.ledger.volume_initial = enclosed_volume(now.mesh.boundary, now.nodes.x);
}

template <int d>
double Water<d>::stable_dt() const {
  constexpr double never = std::numeric_limits<double>::infinity();
  const double squared = least_in_parallel(now.mesh.cells.size(), [&](std::size_t c) {
    const auto& cell = now.mesh.cells[c];
    // Sheets may deform by more than this; acceptable() refuses steps in which they turn over.
    if (std::all_of(cell.begin(), cell.end(), [&](int n) { return now.nodes.surface[n]; })) return never;
    double least = never;
    for (int i = 0; i < d; ++i)
      for (int j = i + 1; j <= d; ++j) {
        const double rate = (now.nodes.v[cell[i]] - now.nodes.v[cell[j]]).squaredNorm();
        const double length = squared_length(now, cell[i], cell[j]);
        if (length < least * rate) least = length / rate;
      }
    return least;
  });
  double dt = std::min(spec.step.dt_max, spec.step.cfl * std::sqrt(squared));
  dt = std::min({dt, now.acceleration_dt, wave_dt(now.nodes, now.mesh, gravity()),
                 spec.step.cfl * gap_time<d>(now.nodes, now.mesh, walls_at(now.poses))});
  for (const auto& effect : effects) dt = std::min(dt, effect->stable_dt());
  return collision_dt<d>(now.nodes, now.mesh, walls_at(now.poses), now.velocity, spec.step.cfl, dt);
}

template <int d>
Vec<d> Water<d>::gravity() const {
  Vec<d> g = Vec<d>::Zero();
  for (const auto& effect : effects) g += effect->uniform_acceleration();
  return g;
}

template struct Water<2>;
template struct Water<3>;

}  // namespace splashdown::fluid
