#include "fluid/inside.hpp"

namespace splashdown::fluid {
namespace {

// Signed crossing of the ray from `c` along +x: +1 where it leaves through the facet, -1 where it enters.
int crossing(const std::array<Vec<2>, 2>& f, const Vec<2>& c) {
  const bool below0 = f[0].y() <= c.y(), below1 = f[1].y() <= c.y();
  if (below0 == below1) return 0;
  const double x = f[0].x() + (c.y() - f[0].y()) * (f[1].x() - f[0].x()) / (f[1].y() - f[0].y());
  if (x <= c.x()) return 0;
  return below0 ? 1 : -1;
}

int crossing(const std::array<Vec<3>, 3>& f, const Vec<3>& c) {
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
InsideTest<d>::InsideTest(std::span<const Vec<d>> x, const std::vector<Facet<d>>& facets) {
  std::vector<double> across;
  corners_.reserve(facets.size());
  across.reserve(facets.size());
  for (const auto& f : facets) {
    std::array<Vec<d>, d> corner;
    for (int k = 0; k < d; ++k) corner[k] = x[f.nodes[k]];
    corners_.push_back(corner);
    across.push_back(corner[0][1]);
  }
  std::sort(across.begin(), across.end());
  constexpr std::size_t facets_per_bin = 4;
  for (std::size_t i = facets_per_bin; i < across.size(); i += facets_per_bin) edges_.push_back(across[i]);
  std::vector<std::array<std::size_t, 2>> range(facets.size());
  start_.assign(edges_.size() + 2, 0);
  for (std::size_t f = 0; f < corners_.size(); ++f) {
    double lo = corners_[f][0][1], hi = lo;
    for (const auto& c : corners_[f]) lo = std::min(lo, c[1]), hi = std::max(hi, c[1]);
    range[f] = {bin(lo), bin(hi)};
    for (std::size_t b = range[f][0]; b <= range[f][1]; ++b) ++start_[b + 1];
  }
  for (std::size_t b = 1; b < start_.size(); ++b) start_[b] += start_[b - 1];
  member_.resize(start_.back());
  std::vector<int> next(start_.begin(), start_.end() - 1);
  for (std::size_t f = 0; f < corners_.size(); ++f)
    for (std::size_t b = range[f][0]; b <= range[f][1]; ++b) member_[next[b]++] = static_cast<int>(f);
}

template <int d>
bool InsideTest<d>::operator()(const Vec<d>& point) const {
  const std::size_t b = bin(point[1]);
  int winding = 0;
  for (int i = start_[b]; i < start_[b + 1]; ++i) winding += crossing(corners_[member_[i]], point);
  return winding > 0;
}

template class InsideTest<2>;
template class InsideTest<3>;

}  // namespace splashdown::fluid
