// Hulls in the midst of the water: what their facets take from it or leave to it is no loss or gain.
#include <algorithm>
#include <utility>

#include "fluid/pfem/water/water.hpp"

namespace splashdown::fluid {

// Follows hulls that water was all around, at the poses of `work`, and is around still, at `poses`. What their facets enclose
// more or less is not owed. The potential energy is that of water around a hull which keeps the volume V_0 that it went
// under with: of volume V and centre c before, V' and c' now, and c* where the hull's motion carries c,
//
//   dE = -rho g . (V' c' - V c - V_0 (c* - c)),   V_0 = V - chords
template <int d>
void Water<d>::follow_hulls(std::span<const WallPlace<d>> poses) {
  const auto before = std::exchange(work.displaced, displaced_volumes(work.mesh, work.nodes.x, walls.size(), mirror()));
  std::vector<double> taken(walls.size(), 0.0);
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const DisplacedVolume<d>&from = before[w], &to = work.displaced[w];
    if (!from.is_closed() || !to.is_closed()) {
      work.chords[w] = 0;
      continue;
    }
    taken[w] = to.volume - from.volume;
    const double own = from.volume - work.chords[w];
    const Vec<d> carried = walls[w].carried(work.poses[w], poses[w], from.centre);
    work.ledger.chord_energy -= spec.density * gravity().dot(to.volume * (to.centre - from.centre) +
                                                             taken[w] * from.centre - own * (carried - from.centre));
    work.ledger.hull_chords += taken[w];
    work.chords[w] += taken[w];
  }
  if (std::ranges::all_of(taken, [](double t) { return t == 0; })) return;
  const auto wetted = wetted_measures(work.mesh, work.nodes.x, walls.size());
  for (const auto& facet : work.mesh.boundary) {
    if (facet.wall < 0 || taken[facet.wall] == 0) continue;
    const double share = area_vector_of<d>(facet, work.nodes.x).norm() / (d * wetted[facet.wall]);
    for (const int n : facet.nodes) work.nodes.owed[n] -= share * taken[facet.wall];
  }
}

template struct Water<2>;
template struct Water<3>;

}  // namespace splashdown::fluid
