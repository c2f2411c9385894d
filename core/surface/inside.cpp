#include "core/surface/inside.hpp"

#include <cmath>
#include <numeric>

namespace splashdown {
namespace {

const Vec<2>& turned(const Vec<2>& x) { return x; }
Vec<3> turned(const Vec<3>& x) { return {x.z(), x.x(), x.y()}; }

template <int d>
std::array<Vec<d>, d> turned_corners(const Facet<d>& f, std::span<const Vec<d>> x) {
  std::array<Vec<d>, d> corner;
  for (int k = 0; k < d; ++k) corner[k] = turned(x[f.nodes[k]]);
  return corner;
}

// Signed crossing of the ray from `c` along axis 0: +1 where it leaves through the facet, -1 where it enters.
int crossing(const std::array<Vec<2>, 2>& f, const Vec<2>& c) {
  const bool below0 = f[0].y() <= c.y(), below1 = f[1].y() <= c.y();
  if (below0 == below1) return 0;
  const double x = f[0].x() + (c.y() - f[0].y()) * (f[1].x() - f[0].x()) / (f[1].y() - f[0].y());
  if (x <= c.x()) return 0;
  return below0 ? 1 : -1;
}

int crossing(const std::array<Vec<3>, 3>& f, const Vec<3>& c) {
  const auto all_below = [&](int axis) { return f[0][axis] < c[axis] && f[1][axis] < c[axis] && f[2][axis] < c[axis]; };
  const auto all_above = [&](int axis) { return f[0][axis] > c[axis] && f[1][axis] > c[axis] && f[2][axis] > c[axis]; };
  if (all_below(0) || all_below(1) || all_above(1) || all_below(2) || all_above(2)) return 0;
  // Edge functions in the (y, z) plane. A point on an edge belongs to the facet on one side of it alone,
  // told by the edge's direction around the facet.
  std::array<double, 3> e;
  for (int k = 0; k < 3; ++k) {
    const Vec<3> a = f[(k + 1) % 3] - c, b = f[(k + 2) % 3] - c;
    e[k] = a.y() * b.z() - a.z() * b.y();
  }
  const double area = e[0] + e[1] + e[2];
  if (area == 0) return 0;
  const double turn = area > 0 ? 1.0 : -1.0;
  for (int k = 0; k < 3; ++k) {
    const Vec<3> along = turn * (f[(k + 2) % 3] - f[(k + 1) % 3]);
    const bool owns = along.z() > 0 || (along.z() == 0 && along.y() < 0);
    if (turn * e[k] < 0 || (e[k] == 0 && !owns)) return 0;
  }
  const double x = (e[0] * f[0].x() + e[1] * f[1].x() + e[2] * f[2].x()) / area;
  if (x <= c.x()) return 0;
  return area > 0 ? 1 : -1;
}

}  // namespace

template <int d>
void InsideTest<d>::Bins::fill(std::span<const int> items, const std::vector<std::array<double, 2>>& range,
                               std::size_t per_bin) {
  std::vector<double> lower;
  lower.reserve(items.size());
  for (int i : items) lower.push_back(range[i][0]);
  std::sort(lower.begin(), lower.end());
  // Items that pile up behind each other, as those of a wall along the rays, reach into bins in proportion to their number:
  // fewer bins then.
  constexpr std::size_t bins_an_item = 8;
  std::vector<std::array<std::size_t, 2>> reach(items.size());  // first and last bin
  std::size_t entries = 0;
  do {
    edges.clear();
    for (std::size_t i = per_bin; i < lower.size(); i += per_bin) edges.push_back(lower[i]);
    entries = 0;
    for (std::size_t k = 0; k < items.size(); ++k) {
      reach[k] = {of(range[items[k]][0]), of(range[items[k]][1])};
      entries += reach[k][1] - reach[k][0] + 1;
    }
    per_bin *= 4;
  } while (entries > bins_an_item * items.size());
  start.assign(edges.size() + 2, 0);
  for (const auto& [first, last] : reach)
    for (std::size_t b = first; b <= last; ++b) ++start[b + 1];
  for (std::size_t b = 1; b < start.size(); ++b) start[b] += start[b - 1];
  member.resize(start.back());
  std::vector<int> next(start.begin(), start.end() - 1);
  for (std::size_t k = 0; k < items.size(); ++k)
    for (std::size_t b = reach[k][0]; b <= reach[k][1]; ++b) member[next[b]++] = items[k];
}

template <int d>
InsideTest<d>::InsideTest(std::span<const Vec<d>> x, const std::vector<Facet<d>>& facets) {
  corners_.reserve(facets.size());
  std::array<std::vector<std::array<double, 2>>, 3> range;
  for (const auto& f : facets) {
    const auto& corner = corners_.emplace_back(turned_corners(f, x));
    for (int axis = 1; axis < d; ++axis) {
      double low = corner[0][axis], high = low;
      for (const auto& c : corner) low = std::min(low, c[axis]), high = std::max(high, c[axis]);
      range[axis].push_back({low, high});
    }
  }
  std::vector<int> all(facets.size());
  std::iota(all.begin(), all.end(), 0);
  constexpr std::size_t facets_per_bin = 4;
  if constexpr (d == 2) {
    slabs_.fill(all, range[1], facets_per_bin);
  } else {
    // As many slabs as bins in a slab.
    slabs_.fill(all, range[1],
                std::max(facets_per_bin, static_cast<std::size_t>(std::sqrt(facets_per_bin * facets.size()))));
    cells_.resize(slabs_.count());
    for (std::size_t s = 0; s < cells_.size(); ++s) cells_[s].fill(slabs_[s], range[2], facets_per_bin);
  }
}

template <int d>
std::span<const int> InsideTest<d>::near(const Vec<d>& point) const {
  const std::size_t slab = slabs_.of(point[1]);
  if constexpr (d == 2) return slabs_[slab];
  return cells_[slab][cells_[slab].of(point[d - 1])];
}

template <int d>
bool InsideTest<d>::operator()(const Vec<d>& x) const {
  const Vec<d> point = turned(x);
  int winding = 0;
  for (int i : near(point)) winding += crossing(corners_[i], point);
  return winding > 0;
}

template <int d>
bool is_inside(std::span<const Vec<d>> x, const std::vector<Facet<d>>& facets, const Vec<d>& point) {
  int winding = 0;
  const Vec<d> from = turned(point);
  for (const auto& f : facets) winding += crossing(turned_corners(f, x), from);
  return winding > 0;
}

template bool is_inside<2>(std::span<const Vec<2>>, const std::vector<Facet<2>>&, const Vec<2>&);
template bool is_inside<3>(std::span<const Vec<3>>, const std::vector<Facet<3>>&, const Vec<3>&);
template class InsideTest<2>;
template class InsideTest<3>;

}  // namespace splashdown
