#include "fluid/pfem/mesh/recognition/hubs.hpp"

#include <algorithm>

namespace splashdown::fluid {

template <int d>
std::vector<Hub<d>> hubs_of(const Nodes<d>& nodes, const WallsAt<d>& walls, const Alpha& limit) {
  std::vector<Hub<d>> hubs;
  if (d == 2) return hubs;
  std::vector<double> size(walls.walls.size(), 0.0);  // largest on each wall; 0: it is dry
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (const int w = nodes.tie[i].wall; w >= 0) size[w] = std::max(size[w], nodes.h[i]);
  for (std::size_t w = 0; w < size.size(); ++w) {
    const Wall<d>& wall = walls.walls[w];
    if (size[w] > 0 && !wall.encloses_fluid() && wall.depth_of_centre() > 2 * limit.never * size[w])
      hubs.push_back({static_cast<int>(w), wall.centre_at(walls.poses[w])});
  }
  return hubs;
}

// Asked in the middle of the cell and near the facet across from the hub: water that the hub takes ends there.
template <int d>
bool reach_water(const Delaunay<d>& all, std::span<const Hub<d>> hubs, const Nodes<d>& nodes,
                 const InsideTest<d>& inside) {
  constexpr double near_facet = 0.05;  // of the way from there to the hub
  return std::ranges::any_of(all.at_hubs, [&](const auto& cell) {
    const auto is_hub = [&](int n) { return n >= all.first_hub; };
    const Hub<d>& hub = hubs[*std::ranges::find_if(cell, is_hub) - all.first_hub];
    if (std::ranges::all_of(cell, [&](int n) { return is_hub(n) || nodes.tie[n].wall == hub.wall; })) return false;
    Vec<d> sum = Vec<d>::Zero();
    int others = 0;
    for (int n : cell) {
      if (is_hub(n)) continue;
      sum += nodes.x[n];
      ++others;
    }
    const Vec<d> facet = sum / others;
    return inside((sum + hub.x) / (others + 1)) || inside(facet + near_facet * (hub.x - facet));
  });
}

template std::vector<Hub<2>> hubs_of(const Nodes<2>&, const WallsAt<2>&, const Alpha&);
template std::vector<Hub<3>> hubs_of(const Nodes<3>&, const WallsAt<3>&, const Alpha&);

template bool reach_water(const Delaunay<2>&, std::span<const Hub<2>>, const Nodes<2>&, const InsideTest<2>&);
template bool reach_water(const Delaunay<3>&, std::span<const Hub<3>>, const Nodes<3>&, const InsideTest<3>&);

}  // namespace splashdown::fluid
