#include "apps/effects/waves/region.hpp"

#include <vector>

#include "apps/scene/geometry.hpp"

namespace splashdown::apps {
namespace {

// Points of the top, along x first, and their mean height by the trapezoidal rule of both axes.
template <int d>
std::vector<Vec<d>> top_of(const BoxRegion& box, const WavySurface<d>& top) {
  const Vec<d> low = vec<d>(box.min), high = vec<d>(box.max);
  const int across = top.pieces[d - 2] * (d - 2);  // pieces along y, none in the plane
  std::vector<Vec<d>> points;
  double mean = 0, weights = 0;
  for (int j = 0; j <= across; ++j)
    for (int i = 0; i <= top.pieces[0]; ++i) {
      Vec<d> x = high;
      const bool last = i == top.pieces[0], end = j == across;
      if (!last) x[0] = low[0] + (high[0] - low[0]) * i / top.pieces[0];
      if (d == 3 && !end) x[1] = low[1] + (high[1] - low[1]) * j / across;
      const double rise = top.elevation(x),
                   weight = (i == 0 || last ? 0.5 : 1) * (across > 0 && (j == 0 || end) ? 0.5 : 1);
      mean += weight * rise, weights += weight;
      x[d - 1] += rise;
      points.push_back(x);
    }
  for (auto& x : points) x[d - 1] -= mean / weights;
  return points;
}

template <int d>
Surface<d> surface_of(const std::vector<Vec<d>>& points, const std::vector<std::array<int, d>>& facets) {
  Surface<d> surface;
  surface.vertices.resize(d, static_cast<Eigen::Index>(points.size()));
  surface.facets.resize(d, static_cast<Eigen::Index>(facets.size()));
  for (std::size_t i = 0; i < points.size(); ++i) surface.vertices.col(static_cast<Eigen::Index>(i)) = points[i];
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (int k = 0; k < d; ++k)
      surface.facets(k, static_cast<Eigen::Index>(f)) = facets[f][static_cast<std::size_t>(k)];
  return surface;
}

}  // namespace

template <>
Surface<2> wavy_box(const BoxRegion& box, const WavySurface<2>& top) {
  auto points = top_of<2>(box, top);
  std::ranges::reverse(points);
  points.insert(points.begin(), {vec<2>(box.min), Vec<2>(box.max.x(), box.min.y())});
  std::vector<std::array<int, 2>> facets;
  const int count = static_cast<int>(points.size());
  for (int i = 0; i < count; ++i) facets.push_back({i, (i + 1) % count});
  return surface_of<2>(points, facets);
}

// Below each piece of the top's rim a strip of a side goes down to the floor, whose triangles meet in its middle: fans of corners would
// overlap where a wave is steeper than the line of sight to the far end.
template <>
Surface<3> wavy_box(const BoxRegion& box, const WavySurface<3>& top) {
  auto points = top_of<3>(box, top);
  const int nx = top.pieces[0], ny = top.pieces[1];
  const auto at = [&](int i, int j) { return j * (nx + 1) + i; };
  std::vector<std::array<int, 3>> facets;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      facets.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  std::vector<int> rim;  // counter-clockwise from above
  for (int i = 0; i < nx; ++i) rim.push_back(at(i, 0));
  for (int j = 0; j < ny; ++j) rim.push_back(at(nx, j));
  for (int i = nx; i > 0; --i) rim.push_back(at(i, ny));
  for (int j = ny; j > 0; --j) rim.push_back(at(0, j));
  const int around = static_cast<int>(rim.size()), floor = static_cast<int>(points.size()), middle = floor + around;
  for (const int k : rim) {
    Vec<3> below = points[static_cast<std::size_t>(k)];
    below.z() = box.min.z();
    points.push_back(below);
  }
  points.emplace_back(0.5 * (box.min.x() + box.max.x()), 0.5 * (box.min.y() + box.max.y()), box.min.z());
  for (int k = 0; k < around; ++k) {
    const int next = (k + 1) % around;
    facets.push_back({floor + k, floor + next, rim[next]});
    facets.push_back({floor + k, rim[next], rim[k]});
    facets.push_back({middle, floor + next, floor + k});
  }
  return surface_of<3>(points, facets);
}

}  // namespace splashdown::apps
