#include "fluid/pfem/water/wave_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fluid/pfem/pressure/pressure.hpp"

namespace splashdown::fluid {

template <int d>
double wave_dt(const Nodes<d>& nodes, const Mesh<d>& mesh, const Vec<d>& gravity) {
  const double g = gravity.norm();
  if (!(g > 0)) return std::numeric_limits<double>::infinity();
  std::vector<double> level(nodes.size(), 0.0), measure(nodes.size(), 0.0);
  for (const auto& f : mesh.boundary) {
    if (f.wall >= 0) continue;
    const Vec<d> share = area_vector_of<d>(f, nodes.x) / d;
    for (int n : f.nodes) {
      level[n] += std::max(0.0, -share.dot(gravity) / g);
      measure[n] += share.norm();
    }
  }
  std::vector<char> in_bulk(nodes.size(), 0);
  for (const auto& cell : mesh.cells)
    if (!std::all_of(cell.begin(), cell.end(), [&](int n) { return nodes.surface[n]; }))
      for (int n : cell) in_bulk[n] = 1;
  // A bound for nodes that may carry pressure; lighter ones are held to p = 0 (pressure.cpp).
  double most = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (in_bulk[i] && level[i] > 0 && nodes.volume[i] >= lightest_on_surface * std::pow(measure[i], d / (d - 1.0)))
      most = std::max(most, level[i] / nodes.volume[i]);
  // M^-1 = (1 + z + 2 z^2) M_L^-1, z (d+1)/(d+2) at most. The leapfrog is stable up to 2; at the bound itself a mode is neither
  // damped nor bounded, hence a margin.
  constexpr double margin = 0.9;
  return margin * 2 / std::sqrt(inverse_mass(shortest<d>) * g * most);
}

template double wave_dt(const Nodes<2>&, const Mesh<2>&, const Vec<2>&);
template double wave_dt(const Nodes<3>&, const Mesh<3>&, const Vec<3>&);

}  // namespace splashdown::fluid
