#include "fluid/pfem/mesh/drops/droplets.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/facet_tree.hpp"
#include "core/surface/inside.hpp"

namespace splashdown::fluid {
namespace {

std::vector<int> drops_among(const std::vector<char>& spray, const std::vector<char>& left) {
  std::vector<int> drops;
  for (std::size_t i = 0; i < spray.size(); ++i)
    if (spray[i] && left[i]) drops.push_back(static_cast<int>(i));
  return drops;
}

/// Whether there is water before a drop that touches a wall: its middle lies half its size, `touch`, off the wall that it slides
/// on, and the liquid's facets are chords of a wall that is curved.
template <int d>
bool slides_under_water(const Vec<d>& x, double touch, double h, const WallsAt<d>& at, const InsideTest<d>& inside) {
  constexpr double chord = 0.05;  // farther off a wall than this, over h, facets of a wall that is resolved are not
  for (std::size_t w = 0; w < at.walls.size(); ++w) {
    if (!at.walls[w].may_touch(at.poses[w], x, touch)) continue;
    const auto near = at.walls[w].nearest(at.poses[w], x, touch);
    if (near.distance >= touch) continue;
    for (const double off : {touch, chord * h})
      if (inside(near.point + off * near.normal)) return true;
  }
  return false;
}

}  // namespace

template <int d>
double drop_size(double volume) {
  return d == 2 ? std::sqrt(2 * volume / std::numbers::sqrt3) : std::cbrt(std::numbers::sqrt2 * volume);
}

template <int d>
std::vector<char> join_drops(Nodes<d>& nodes) {
  std::vector<char> left(nodes.size(), 1);
  auto drops = drops_among(nodes.spray, left);
  double largest = 0;
  for (int i : drops) largest = std::max(largest, drop_size<d>(nodes.volume[i]));
  std::sort(drops.begin(), drops.end(),
            [&](int a, int b) { return nodes.x[a].x() != nodes.x[b].x() ? nodes.x[a].x() < nodes.x[b].x() : a < b; });
  for (std::size_t p = 0; p < drops.size(); ++p) {
    const int a = drops[p];
    if (!left[a]) continue;
    const double swept = nodes.x[a].x();
    for (std::size_t q = p + 1; q < drops.size() && nodes.x[drops[q]].x() - swept < largest; ++q) {
      const int b = drops[q];
      if (!left[b] || !(nodes.tie[a] == nodes.tie[b])) continue;
      const double Va = nodes.volume[a], Vb = nodes.volume[b];
      const double reach = 0.5 * (drop_size<d>(Va) + drop_size<d>(Vb));
      if ((nodes.x[a] - nodes.x[b]).squaredNorm() >= reach * reach) continue;
      if (drop_size<d>(Va + Vb) > std::min(nodes.h[a], nodes.h[b])) continue;
      const double share = Va + Vb > 0 ? Va / (Va + Vb) : 0.5;
      nodes.x[a] = share * nodes.x[a] + (1 - share) * nodes.x[b];
      nodes.v[a] = share * nodes.v[a] + (1 - share) * nodes.v[b];
      nodes.volume[a] = Va + Vb;
      nodes.field_energy[a] += nodes.field_energy[b];
      left[b] = 0;
    }
  }
  return left;
}

template <int d>
void absorb_drops(Nodes<d>& nodes, const std::vector<Facet<d>>& boundary, const WallsAt<d>& walls,
                  std::vector<char>& left) {
  // To give way by more than this, over h, would be no small change of the surface: such a drop hands over its momentum, and
  // its volume is owed.
  constexpr double most = 0.25;
  const auto drops = drops_among(nodes.spray, left);
  if (drops.empty()) return;
  std::vector<std::array<Vec<d>, d>> free;
  std::vector<int> facet;
  std::vector<Vec<d>> area(nodes.size(), Vec<d>::Zero());
  for (std::size_t f = 0; f < boundary.size(); ++f) {
    if (boundary[f].wall >= 0) continue;
    free.push_back(corners_of(boundary[f], nodes.x));
    facet.push_back(static_cast<int>(f));
    const Vec<d> share = area_vector_of<d>(boundary[f], nodes.x) / d;
    for (int n : boundary[f].nodes) area[n] += share;
  }
  if (free.empty()) return;
  const FacetTree<d> surface(free);
  const InsideTest<d> inside(nodes.x, boundary);
  for (int i : drops) {
    const double V = nodes.volume[i], touch = 0.5 * drop_size<d>(V);
    auto hit = surface.nearest(nodes.x[i], touch);
    if (hit.facet < 0) {
      if (!inside(nodes.x[i]) && !slides_under_water<d>(nodes.x[i], touch, nodes.h[i], walls, inside)) continue;
      hit = surface.nearest(nodes.x[i], std::numeric_limits<double>::max());
      if (hit.facet < 0) continue;
    }
    const auto& corners = boundary[facet[hit.facet]].nodes;
    const bool fits =
        std::all_of(corners.begin(), corners.end(), [&](int n) { return V / d < most * nodes.h[n] * area[n].norm(); });
    for (int n : corners) {
      const double before = nodes.volume[n], share = V / d;
      if (fits && nodes.tie[n].wall < 0) nodes.x[n] += share / area[n].squaredNorm() * area[n];
      if (before + share > 0) nodes.v[n] = (before * nodes.v[n] + share * nodes.v[i]) / (before + share);
      nodes.volume[n] = before + share;
      nodes.field_energy[n] += nodes.field_energy[i] / d;
    }
    left[i] = 0;
  }
}

template double drop_size<2>(double);
template double drop_size<3>(double);
template std::vector<char> join_drops(Nodes<2>&);
template std::vector<char> join_drops(Nodes<3>&);
template void absorb_drops(Nodes<2>&, const std::vector<Facet<2>>&, const WallsAt<2>&, std::vector<char>&);
template void absorb_drops(Nodes<3>&, const std::vector<Facet<3>>&, const WallsAt<3>&, std::vector<char>&);

}  // namespace splashdown::fluid
