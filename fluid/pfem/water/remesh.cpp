// The mesh of a step: sizes, contact, nodes, the triangulation and which of its cells are fluid.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "fluid/pfem/contact/attachment.hpp"
#include "fluid/pfem/contact/separation.hpp"
#include "fluid/pfem/mesh/conservation/field_energy.hpp"
#include "fluid/pfem/mesh/conservation/volume_correction.hpp"
#include "fluid/pfem/mesh/drops/coalescence.hpp"
#include "fluid/pfem/mesh/drops/droplets.hpp"
#include "fluid/pfem/mesh/drops/sheets.hpp"
#include "fluid/pfem/mesh/recognition/hubs.hpp"
#include "fluid/pfem/mesh/sizes/narrow_strips.hpp"
#include "fluid/pfem/mesh/sizes/size_field.hpp"
#include "fluid/pfem/parallel.hpp"
#include "fluid/pfem/water/water.hpp"

namespace splashdown::fluid {

template <int d>
void Water<d>::size_nodes() {
  const SizeField<d> field(spec.size, walls_at(work.poses), work.wetted, work.nodes.x, work.mesh);
  in_parallel(work.nodes.size(),
              [&](std::size_t i) { work.nodes.h[i] = field(work.nodes.x[i], work.nodes.tie[i].wall); });
  if constexpr (d == 3)
    resolve_narrow_strips(work.nodes, work.mesh,
                          [this](int node, double length) { return rests_on_wall(node, length); });
}

// A node that leaves the mesh takes its share of volume along, as far as the mesh has lost it, with the mean velocity of what it carried
// and inherited, and off water that a wall touches no more energy than the field had around it (other water keeps its momentum); one that
// comes back brings it. What stays is owed to the rest, volume and momentum; where no water stays, drops off free water share its momentum.
template <int d>
void Water<d>::book_spray(const std::vector<char>& was_spray) {
  Nodes<d>& nodes = work.nodes;
  double leaving = 0, returning = 0, lost = 0;
  for (const auto& cell : work.mesh.cells) lost -= volume<d>(corners(nodes.x, cell));
  std::size_t heaviest = 0;
  for (std::size_t i = 0; i < was_spray.size(); ++i) {
    const double carried = nodes.volume[i] + nodes.owed[i];
    if (!was_spray[i] || !nodes.spray[i]) lost += carried;
    if (nodes.spray[i] > was_spray[i]) leaving += std::max(0.0, carried);
    if (nodes.spray[i] < was_spray[i]) returning += carried;
    if (!nodes.spray[i] && (nodes.spray[heaviest] || nodes.volume[i] > nodes.volume[heaviest])) heaviest = i;
  }
  work.ledger.spray -= returning;
  const double share = leaving > 0 ? std::clamp(lost / leaving, 0.0, 1.0) : 0.0;
  std::set<int> at_walls;  // parts of the last mesh
  for (std::size_t i = 0; i < was_spray.size() && leaving > 0; ++i)
    if (nodes.tie[i].wall >= 0 && !was_spray[i]) at_walls.insert(nodes.part[i]);
  VelocityMoments<d> flown, left;  // of waters that fly as a whole, where none stays that could have what is left
  std::vector<std::size_t> whole;
  for (std::size_t i = 0; i < was_spray.size(); ++i) {
    if (nodes.spray[i] <= was_spray[i]) continue;
    const double carried = nodes.volume[i] + nodes.owed[i];
    const double flies = share * std::max(0.0, carried), held = share * std::max(0.0, nodes.field_energy[i]);
    const bool at_wall = at_walls.contains(nodes.part[i]);
    auto all = nodes.carried(i);
    Vec<d> v = (all += nodes.inherited[i]).volume > 0 ? all.mean_velocity() : nodes.v[i];
    if (const double has = VelocityMoments<d>::of(flies, v).energy; at_wall && has > held) v *= std::sqrt(held / has);
    const auto drop = VelocityMoments<d>::of(flies, v);
    if (!nodes.spray[heaviest]) {
      nodes.bequeath(i, heaviest);
      nodes.owed[heaviest] -= flies;
      nodes.inherited[heaviest] -= drop;
      nodes.field_energy[heaviest] -= drop.energy;
    } else if (!at_wall) {
      flown += drop, left += all, left -= drop;
      whole.push_back(i);
    }
    nodes.v[i] = v;
    nodes.volume[i] = flies;
    nodes.owed[i] = 0;
    work.ledger.spray += flies;
  }
  if (flown.volume > 0)
    for (std::size_t i : whole) nodes.v[i] += left.momentum / flown.volume;
}

// What nodes that go have carried passes to a neighbour that stays.
template <int d>
void Water<d>::hand_over(const std::vector<char>& goes, const std::vector<std::array<int, d + 1>>& cells) {
  Nodes<d>& nodes = work.nodes;
  for (const auto& cell : cells) {
    const auto heir = std::find_if(cell.begin(), cell.end(), [&](int n) { return !goes[n]; });
    if (heir == cell.end()) continue;
    for (int n : cell) {
      if (goes[n]) nodes.bequeath(n, *heir);
    }
  }
}

// Whether effects that spread momentum leave that of an element's size alone, within a step.
template <int d>
bool Water<d>::is_inviscid(int node) const {
  constexpr double spread = 1e-3;  // of the momentum
  double diffusivity = 0;
  for (const auto& effect : effects) diffusivity += effect->diffusivity(spec.density);
  const double h = work.nodes.h[node];
  return diffusivity * now.dt <= spread * h * h;
}

// Whether water at a wall is so slow along it that it does not get this far within a few times sqrt(h / g), in which waves of an
// element's size pass, and within a few steps.
template <int d>
bool Water<d>::rests_on_wall(int node, double length) const {
  constexpr double few = 4;
  const int wall = work.nodes.tie[node].wall;
  if (wall < 0) return false;
  const Vec<d> of_wall = velocity_at<d>(work.poses[wall], work.velocity[wall], work.nodes.x[node]);
  const double squared_speed = (work.nodes.v[node] - of_wall).squaredNorm(), squared = length * length / (few * few);
  return squared_speed * now.dt * now.dt <= squared && squared_speed * work.nodes.h[node] <= squared * gravity().norm();
}

template <int d>
void Water<d>::collect_drops() {
  Nodes<d>& nodes = work.nodes;
  auto carried = [&](const std::vector<char>& by) {
    double volume = 0;
    for (std::size_t i = 0; i < by.size(); ++i) volume += nodes.spray[i] * by[i] * nodes.volume[i];
    return volume;
  };
  std::vector<char> left = join_drops(nodes);
  const double flying = carried(left);
  absorb_drops(nodes, work.mesh.boundary, walls_at(work.poses), left);
  std::vector<int> kept;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (left[i]) kept.push_back(static_cast<int>(i));
  if (kept.size() == nodes.size()) return;
  work.ledger.spray -= flying - carried(left);
  keep(kept, nodes, work.mesh.boundary);
}

// The nodes that are corners of cells come first, in 3D along a space-filling curve: neighbours are near in memory, and
// in the same block of the smoother. How many they are.
template <int d>
std::size_t Water<d>::put_drops_last() {
  std::vector<int> order(work.nodes.size());
  if constexpr (d == 3) {
    const auto curve = spatial_order<d>(work.nodes.x);
    order.assign(curve.begin(), curve.end());
  } else {
    std::iota(order.begin(), order.end(), 0);
  }
  const auto is_liquid = [&](int i) { return !work.nodes.spray[i]; };
  const auto beyond = std::stable_partition(order.begin(), order.end(), is_liquid);
  const auto liquid = static_cast<std::size_t>(beyond - order.begin());
  if (d == 3 || !std::is_sorted(order.begin(), order.end())) keep(order, work.nodes, work.mesh.boundary);
  return liquid;
}

// The cells of the water. `liquid`: nodes that may be their corners, the first ones.
template <int d>
void Water<d>::cut(std::size_t liquid) {
  Nodes<d>& nodes = work.nodes;
  // To do without nodes that keep the triangulation from the facets of walls. Tips of steep cones take up to seven.
  constexpr int attempts = 8;
  std::vector<Hub<d>> hubs = hubs_of<d>(nodes, walls_at(work.poses));
  const auto recognised = [&] {
    std::vector<Facet<d>> kept;
    if (keeps_facets<d>) kept = smaller_parts_first<d>(work.mesh.boundary, nodes);
    std::vector<Vec<d>> hub_points;
    for (const Hub<d>& hub : hubs) hub_points.push_back(hub.x);
    Delaunay<d> cells =
        triangulation.follow(std::span(nodes.x).first(liquid), std::span(nodes.vertex).first(liquid), kept, hub_points);
    std::iota(nodes.vertex.begin(), nodes.vertex.begin() + static_cast<std::ptrdiff_t>(liquid), 0);
    std::fill(nodes.vertex.begin() + static_cast<std::ptrdiff_t>(liquid), nodes.vertex.end(), -1);
    return recognise<d>(std::move(cells), nodes, work.mesh.boundary, walls_at(work.poses), {}, hubs);
  };
  for (int attempt = 1;; ++attempt) {
    const auto spray = nodes.spray;
    auto found = recognised();
    if (found.hub_in_water) {
      hubs.clear();
      found = recognised();
    }
    if (found.piercing.empty() || attempt == attempts) {
      flat_cells = std::move(found.flat_cells);
      work.mesh = std::move(found);
      if (now.dt > 0) let_sheets_fly<d>(nodes, work.mesh, flat_cells, [&](int i) { return is_inviscid(i); });
      return book_spray(spray);
    }
    nodes.spray = spray;
    std::vector<char> goes(nodes.size(), 0);
    for (int n : found.piercing) goes[n] = 1;
    hand_over(goes, found.cells);
    liquid -= found.piercing.size();
    discard(goes, nodes, work.mesh.boundary);
  }
}

// Gives nodes the energy that the field has around them, for the next mesh to keep: of all water, [J].
template <int d>
double Water<d>::hold_field_energy() {
  work.nodes.field_energy = field_energies(work.mesh, work.nodes);
  return spec.density * std::accumulate(work.nodes.field_energy.begin(), work.nodes.field_energy.end(), 0.0);
}

template <int d>
void Water<d>::prepare() {
  const auto scope = timer.scope(remesh);
  work = now;
  const double energy = hold_field_energy();
  size_nodes();
  attach_nodes<d>(work.nodes, work.mesh, walls_at(work.poses), work.velocity, now.dt);
  if (now.dt > 0)
    adapt<d>(work.nodes, work.mesh, walls_at(work.poses),
             [this](int node, double length) { return rests_on_wall(node, length); });
  collect_drops();
  const double before = water();
  const std::size_t liquid = put_drops_last();
  cut(liquid);
  const double adapted = before - now.ledger.volume;
  settle(before);
  (adapted > 0 ? work.ledger.remesh_created : work.ledger.remesh_deleted) += adapted;
  work.ledger.energy_remesh += hold_field_energy() - energy;
  prepared = true;
}

// What nodes of a new mesh carry, and what its volume has changed by.
template <int d>
void Water<d>::settle(double before) {
  free_water = FreeWater<d>(work.mesh, work.nodes, walls_at(work.poses));
  free_carried = free_water.moments(work.nodes.volume, work.nodes.v, work.nodes.inherited);
  std::ranges::fill(work.nodes.inherited, VelocityMoments<d>{});
  mix_joined<d>(work.mesh, free_water.part(), work.nodes);
  separate<d>(work.nodes, work.mesh, walls_at(work.poses), work.velocity, gravity().norm());
  mix_absorbed(work.nodes, work.mesh);
  follow_hulls(work.poses);
  const double after = water();
  (after > before ? work.ledger.remesh_created : work.ledger.remesh_deleted) += after - before;
  const auto recognised = nodal_volumes(work.mesh, work.nodes.x);
  const auto volumes =
      return_volume(work.nodes, work.mesh, walls_at(work.poses), free_water, recognised, work.nodes.volume);
  free_water.give_back(free_carried, volumes, work.nodes.v);
  limit_field_energy<d>(work.nodes, work.mesh, free_water, recognised, volumes);
  work.ledger.volume = water();
  work.ledger.returned += work.ledger.volume - after;
  work.wetted = wetted_measures(work.mesh, work.nodes.x, walls.size());
}

// A node for which no step is short enough leaves the begun step's mesh as a drop.
template <int d>
void Water<d>::let_fragment_fly(int node) {
  const auto scope = timer.scope(remesh);
  const double before = work.ledger.volume, energy = hold_field_energy();
  const auto spray = work.nodes.spray;
  std::vector<char> flies(work.nodes.size(), 0);
  flies[node] = 1;
  let_fly<d>(work.nodes, work.mesh, flat_cells, flies);
  book_spray(spray);
  settle(before);
  work.ledger.energy_remesh += hold_field_energy() - energy;
}

template struct Water<2>;
template struct Water<3>;

}  // namespace splashdown::fluid
