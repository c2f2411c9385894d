#include "fluid/pfem/mesh/delaunay/delaunay.hpp"

#include <CGAL/Bbox_3.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fluid/pfem/linear/counting_sort.hpp"
#include "fluid/pfem/mesh/delaunay/flips.hpp"
#include "fluid/pfem/mesh/delaunay/triangulation.hpp"
#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {
namespace {

template <int d, class Map>
struct SortTraits;
template <class Map>
struct SortTraits<2, Map> : CGAL::Spatial_sort_traits_adapter_2<Kernel, Map> {
  using CGAL::Spatial_sort_traits_adapter_2<Kernel, Map>::Spatial_sort_traits_adapter_2;
};
template <class Map>
struct SortTraits<3, Map> : CGAL::Spatial_sort_traits_adapter_3<Kernel, Map> {
  using CGAL::Spatial_sort_traits_adapter_3<Kernel, Map>::Spatial_sort_traits_adapter_3;
};

template <int d>
std::vector<typename Cgal<d>::Point> cgal_points(std::span<const Vec<d>> points) {
  std::vector<typename Cgal<d>::Point> out(points.size());
  std::transform(points.begin(), points.end(), out.begin(), Cgal<d>::point);
  return out;
}

template <int d>
std::vector<std::size_t> order_of(const std::vector<typename Cgal<d>::Point>& points) {
  std::vector<std::size_t> order(points.size());
  if (points.empty()) return order;
  std::iota(order.begin(), order.end(), 0);
  using Map = typename CGAL::Pointer_property_map<typename Cgal<d>::Point>::const_type;
  CGAL::spatial_sort<CGAL::Parallel_if_available_tag>(order.begin(), order.end(),
                                                      SortTraits<d, Map>(CGAL::make_property_map(points)));
  return order;
}

template <int d, class Triangulation>
ClosedDelaunay<d> read(const Triangulation& t, std::size_t points) {
  constexpr int far = ClosedDelaunay<d>::far;
  ClosedDelaunay<d> out;
  out.complete = t.number_of_vertices() == points + far;
  t.infinite_vertex()->info() = static_cast<int>(points) + far;
  std::vector<std::decay_t<decltype(*Cgal<d>::cells(t).begin())>> handles;
  for (auto c : Cgal<d>::cells(t)) {
    c->info() = static_cast<int>(handles.size());
    handles.push_back(c);
  }
  out.cells.resize(handles.size());
  out.neighbours.resize(handles.size());
  in_parallel(handles.size(), [&](std::size_t i) {
    for (int k = 0; k <= d; ++k) {
      out.cells[i][k] = handles[i]->vertex(k)->info();
      out.neighbours[i][k] = handles[i]->neighbor(k)->info();
    }
  });
  sort_cells<d>(out, points);
  return out;
}

bool in_parallel_pays(std::size_t points) {
  constexpr std::size_t enough = 10000;
  return threads() > 1 && points >= enough;
}

// The triangulation is that of one thread: CGAL perturbs points that are not in general position by their coordinates, not
// by the order of their insertion. Where points coincide, which of them stays does depend on the order.
ClosedDelaunay<3> triangulated_in_parallel(const std::vector<Kernel::Point_3>& cloud) {
  using Triangulation = TriangulationInSpace<CGAL::Parallel_tag>;
  std::vector<std::pair<Kernel::Point_3, int>> numbered;
  numbered.reserve(cloud.size());
  for (const auto& point : cloud) numbered.emplace_back(point, static_cast<int>(numbered.size()));
  constexpr int cells_of_the_lock_grid = 20;  // along an axis; 10 to 50 make no difference
  const std::size_t points = cloud.size() - ClosedDelaunay<3>::far;
  Triangulation::Lock_data_structure lock(CGAL::bbox_3(cloud.begin(), cloud.end() - ClosedDelaunay<3>::far),
                                          cells_of_the_lock_grid);
  const Triangulation t(numbered.begin(), numbered.end(), &lock);
  return read<3>(t, points);
}

// Inserts the points one after the other, each near the one before.
template <int d>
void insert(const std::vector<typename Cgal<d>::Point>& cloud, typename Cgal<d>::Triangulation& t) {
  typename Cgal<d>::Cell near{};
  for (std::size_t i : order_of<d>(cloud)) {
    const std::size_t before = t.number_of_vertices();
    const auto at = t.insert(cloud[i], near);
    if (t.number_of_vertices() > before) at->info() = static_cast<int>(i);
    near = Cgal<d>::cell_of(at);
  }
}

template <int d>
ClosedDelaunay<d> triangulated(const std::vector<typename Cgal<d>::Point>& cloud) {
  if constexpr (d == 3)
    if (in_parallel_pays(cloud.size()))
      if (auto mesh = triangulated_in_parallel(cloud); mesh.complete) return mesh;
  typename Cgal<d>::Triangulation t;
  insert<d>(cloud, t);
  return read<d>(t, cloud.size() - ClosedDelaunay<d>::far);
}

}  // namespace

template <int d>
std::vector<std::size_t> spatial_order(std::span<const Vec<d>> points) {
  return order_of<d>(cgal_points<d>(points));
}

template <int d>
Delaunay<d> delaunay(std::span<const Vec<d>> points, const std::vector<Facet<d>>& facets) {
  return near_part<d>(closed_delaunay<d>(points), points, facets);
}

template <int d>
ClosedDelaunay<d> closed_delaunay(std::span<const Vec<d>> points) {
  const double extent = extent_of<d>(points);
  auto cloud = cgal_points<d>(points);
  for (const auto& x : far_points<d>(extent)) cloud.push_back(Cgal<d>::point(x));
  ClosedDelaunay<d> mesh = triangulated<d>(cloud);
  mesh.extent = extent;
  return mesh;
}

template <int d>
double extent_of(std::span<const Vec<d>> points) {
  double largest = 0;
  for (const auto& x : points) largest = std::max(largest, x.template lpNorm<Eigen::Infinity>());
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::ldexp(1.0, exponent);
}

// A simplex that holds a ball of five extents; no symmetry that points in a row or a lattice might share.
template <>
std::array<Vec<2>, 3> far_points<2>(double extent) {
  return {extent * Vec<2>(16, -9), extent * Vec<2>(1, 17), extent * Vec<2>(-15, -11)};
}

template <>
std::array<Vec<3>, 4> far_points<3>(double extent) {
  return {extent * Vec<3>(16, 13, 11), extent * Vec<3>(-13, -16, 12), extent * Vec<3>(-11, 14, -15),
          extent * Vec<3>(12, -11, -14)};
}

// Corners ascend, but for the last two where orientation asks for it.
template <int d>
void sort_cells(ClosedDelaunay<d>& mesh, std::size_t points) {
  using Cell = typename ClosedDelaunay<d>::Cell;
  constexpr int gone = ClosedDelaunay<d>::gone;
  in_parallel(mesh.cells.size(), [&](std::size_t c) {
    Cell &cell = mesh.cells[c], &beyond = mesh.neighbours[c];
    if (cell[0] == gone) return;
    bool even = true;
    for (int last = d; last > 0; --last)
      for (int k = 0; k < last; ++k)
        if (cell[k] > cell[k + 1]) std::swap(cell[k], cell[k + 1]), std::swap(beyond[k], beyond[k + 1]), even = !even;
    if (!even) std::swap(cell[d - 1], cell[d]), std::swap(beyond[d - 1], beyond[d]);
  });
  // A bucket for each first corner, and the last one for cells that reach far away.
  const int last = static_cast<int>(points);
  auto bucket = [&](const Cell& cell) { return std::max(cell[d - 1], cell[d]) >= last ? last : cell[0]; };
  std::vector<int> start, order, place(mesh.cells.size());
  counting_sort(
      mesh.cells.size(), points + 1, start,
      [&](std::size_t c, auto put) {
        if (const Cell& cell = mesh.cells[c]; cell[0] != gone) put(bucket(cell), static_cast<int>(c));
      },
      [&](std::size_t count) { order.resize(count); }, [&](int to, int c) { order[to] = c; });
  in_parallel(points + 1, [&](std::size_t n) {
    std::sort(order.begin() + start[n], order.begin() + start[n + 1],
              [&](int a, int b) { return mesh.cells[a] < mesh.cells[b]; });
    for (int k = start[n]; k < start[n + 1]; ++k) place[order[k]] = k;
  });
  std::vector<Cell> cells(order.size()), neighbours(order.size());
  in_parallel(order.size(), [&](std::size_t k) {
    cells[k] = mesh.cells[order[k]];
    for (int i = 0; i <= d; ++i) neighbours[k][i] = place[mesh.neighbours[order[k]][i]];
  });
  mesh.cells = std::move(cells);
  mesh.neighbours = std::move(neighbours);
  mesh.near = static_cast<std::size_t>(start[points]);
}

namespace {

template <int d>
Delaunay<d> near_cells(const ClosedDelaunay<d>& mesh, std::size_t points, std::size_t hubs) {
  Delaunay<d> out;
  out.first_hub = static_cast<int>(points - hubs);
  std::vector<int> number(mesh.cells.size(), -1), near;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const int last = *std::max_element(mesh.cells[c].begin(), mesh.cells[c].end());
    if (last < out.first_hub) {
      number[c] = static_cast<int>(near.size());
      near.push_back(static_cast<int>(c));
    } else if (last < static_cast<int>(points)) {
      out.at_hubs.push_back(mesh.cells[c]);
    }
  }
  out.cells.resize(near.size());
  out.neighbours.resize(near.size());
  in_parallel(near.size(), [&](std::size_t i) {
    out.cells[i] = mesh.cells[near[i]];
    for (int k = 0; k <= d; ++k) out.neighbours[i][k] = number[mesh.neighbours[near[i]][k]];
  });
  return out;
}

}  // namespace

template <>
Delaunay<2> near_part(const ClosedDelaunay<2>& mesh, std::span<const Vec<2>> points,
                      const std::vector<Facet<2>>& facets, std::size_t hubs) {
  if (has_edges(mesh, points.size(), facets)) return near_cells(mesh, points.size(), hubs);
  ClosedDelaunay<2> constrained = mesh;
  MovedCells<2> cells(constrained, points);
  Flips(cells).keep(facets);
  return near_cells(constrained, points.size(), hubs);
}

template <>
Delaunay<3> near_part(const ClosedDelaunay<3>& mesh, std::span<const Vec<3>> points, const std::vector<Facet<3>>&,
                      std::size_t hubs) {
  return near_cells(mesh, points.size(), hubs);
}

template Delaunay<2> delaunay<2>(std::span<const Vec<2>>, const std::vector<Facet<2>>&);
template Delaunay<3> delaunay<3>(std::span<const Vec<3>>, const std::vector<Facet<3>>&);
template ClosedDelaunay<2> closed_delaunay<2>(std::span<const Vec<2>>);
template ClosedDelaunay<3> closed_delaunay<3>(std::span<const Vec<3>>);
template double extent_of<2>(std::span<const Vec<2>>);
template double extent_of<3>(std::span<const Vec<3>>);
template void sort_cells<2>(ClosedDelaunay<2>&, std::size_t);
template void sort_cells<3>(ClosedDelaunay<3>&, std::size_t);
template std::vector<std::size_t> spatial_order<2>(std::span<const Vec<2>>);
template std::vector<std::size_t> spatial_order<3>(std::span<const Vec<3>>);

}  // namespace splashdown::fluid
