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

// Sides are strips between the top's rim and the same points on the floor, whose fan of a corner is flat like the box's.
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
  const int floor = static_cast<int>(points.size());
  const std::array<int, 4> corner{0, nx, nx + ny, 2 * nx + ny};  // in the rim
  for (int c = 0; c < 4; ++c) {
    Vec<3> below = points[static_cast<std::size_t>(rim[static_cast<std::size_t>(corner[c])])];
    below.z() = box.min.z();
    points.push_back(below);
  }
  const int around = static_cast<int>(rim.size());
  for (int c = 0; c < 4; ++c) {  // a side: a fan of its first corner on the floor, and the last triangle
    const int from = corner[c], to = c < 3 ? corner[c + 1] : around, next = floor + (c + 1) % 4;
    for (int k = from; k < to; ++k) facets.push_back({floor + c, rim[(k + 1) % around], rim[k]});
    facets.push_back({floor + c, next, rim[to % around]});
  }
  facets.push_back({floor, floor + 2, floor + 1});
  facets.push_back({floor, floor + 3, floor + 2});
  return surface_of<3>(points, facets);
}

}  // namespace splashdown::apps
