#include "fluid/mesh/delaunay/delaunay.hpp"

#include <CGAL/Bbox_3.h>
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fluid/linear/counting_sort.hpp"
#include "fluid/mesh/delaunay/triangulation_3.hpp"
#include "fluid/parallel.hpp"

namespace splashdown::fluid {
namespace {

template <int d>
struct Cgal;

template <>
struct Cgal<2> {
  using Vertex = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
  using Cell =
      CGAL::Triangulation_face_base_with_info_2<int, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
  using Triangulation =
      CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex, Cell>,
                                                 CGAL::No_constraint_intersection_tag>;
  using Point = Kernel::Point_2;
  template <class Map>
  using SortTraits = CGAL::Spatial_sort_traits_adapter_2<Kernel, Map>;
  static Point point(const Vec<2>& x) { return {x.x(), x.y()}; }
  static auto cell_of(Triangulation::Vertex_handle v) { return v->face(); }
};

void keep(Cgal<2>::Triangulation& t, const std::vector<Cgal<2>::Triangulation::Vertex_handle>& at,
          const std::vector<Facet<2>>& facets) {
  for (const auto& f : facets) {
    const auto a = at[f.nodes[0]], b = at[f.nodes[1]];
    if (a == nullptr || b == nullptr || a == b || t.is_edge(a, b)) continue;
    try {
      t.insert_constraint(a, b);
    } catch (const Cgal<2>::Triangulation::Intersection_of_constraints_exception&) {
      // Two surfaces have met: the winding number decides what lies between them.
    }
  }
}

template <>
struct Cgal<3> {
  using Point = Kernel::Point_3;
  template <class Map>
  using SortTraits = CGAL::Spatial_sort_traits_adapter_3<Kernel, Map>;
  static Point point(const Vec<3>& x) { return cgal_point(x); }
  static auto cell_of(const auto& vertex) { return vertex->cell(); }
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
  CGAL::spatial_sort<CGAL::Parallel_if_available_tag>(
      order.begin(), order.end(), typename Cgal<d>::template SortTraits<Map>(CGAL::make_property_map(points)));
  return order;
}

template <class Triangulation>
ClosedDelaunay read(const Triangulation& t, std::size_t points) {
  ClosedDelaunay out;
  out.complete = t.number_of_vertices() == points + ClosedDelaunay::far;
  t.infinite_vertex()->info() = static_cast<int>(points) + ClosedDelaunay::far;
  std::vector<typename Triangulation::Cell_handle> handles;
  handles.reserve(t.number_of_cells());
  for (auto c : t.all_cell_handles()) {
    c->info() = static_cast<int>(handles.size());
    handles.push_back(c);
  }
  out.cells.resize(handles.size());
  out.neighbours.resize(handles.size());
  in_parallel(handles.size(), [&](std::size_t i) {
    for (int k = 0; k < 4; ++k) {
      out.cells[i][k] = handles[i]->vertex(k)->info();
      out.neighbours[i][k] = handles[i]->neighbor(k)->info();
    }
  });
  sort_cells(out, points);
  return out;
}

bool in_parallel_pays(std::size_t points) {
  constexpr std::size_t enough = 10000;
  return threads() > 1 && points >= enough;
}

// The triangulation is that of one thread: CGAL perturbs points that are not in general position by their coordinates, not
// by the order of their insertion. Where points coincide, which of them stays does depend on the order.
ClosedDelaunay triangulated_in_parallel(const std::vector<Kernel::Point_3>& cloud) {
  using Triangulation = TriangulationInSpace<CGAL::Parallel_tag>;
  std::vector<std::pair<Kernel::Point_3, int>> numbered;
  numbered.reserve(cloud.size());
  for (const auto& point : cloud) numbered.emplace_back(point, static_cast<int>(numbered.size()));
  constexpr int cells_of_the_lock_grid = 20;  // along an axis; 10 to 50 make no difference
  const std::size_t points = cloud.size() - ClosedDelaunay::far;
  Triangulation::Lock_data_structure lock(CGAL::bbox_3(cloud.begin(), cloud.end() - ClosedDelaunay::far),
                                          cells_of_the_lock_grid);
  const Triangulation t(numbered.begin(), numbered.end(), &lock);
  return read(t, points);
}

// Inserts the points one after the other, each near the one before: where they went.
template <int d, class Triangulation>
std::vector<typename Triangulation::Vertex_handle> insert(const std::vector<typename Cgal<d>::Point>& cloud,
                                                          Triangulation& t) {
  std::vector<typename Triangulation::Vertex_handle> at(cloud.size());
  decltype(Cgal<d>::cell_of(at.front())) near{};
  for (std::size_t i : order_of<d>(cloud)) {
    const std::size_t before = t.number_of_vertices();
    at[i] = t.insert(cloud[i], near);
    if (t.number_of_vertices() > before) at[i]->info() = static_cast<int>(i);
    near = Cgal<d>::cell_of(at[i]);
  }
  return at;
}

ClosedDelaunay triangulated(const std::vector<Kernel::Point_3>& cloud) {
  if (in_parallel_pays(cloud.size()))
    if (auto mesh = triangulated_in_parallel(cloud); mesh.complete) return mesh;
  TriangulationInSpace<CGAL::Sequential_tag> t;
  insert<3>(cloud, t);
  return read(t, cloud.size() - ClosedDelaunay::far);
}

}  // namespace

template <int d>
std::vector<std::size_t> spatial_order(std::span<const Vec<d>> points) {
  return order_of<d>(cgal_points<d>(points));
}

template <>
Delaunay<2> delaunay<2>(std::span<const Vec<2>> points, const std::vector<Facet<2>>& facets) {
  Cgal<2>::Triangulation t;
  const auto at = insert<2>(cgal_points<2>(points), t);
  Delaunay<2> out;
  if (t.dimension() < 2) return out;
  keep(t, at, facets);
  int count = 0;
  for (auto c : t.all_face_handles()) c->info() = t.is_infinite(c) ? -1 : count++;
  out.cells.resize(count);
  out.neighbours.resize(count);
  for (auto c : t.all_face_handles()) {
    if (c->info() < 0) continue;
    for (int k = 0; k < 3; ++k) {
      out.cells[c->info()][k] = c->vertex(k)->info();
      out.neighbours[c->info()][k] = c->neighbor(k)->info();
    }
  }
  return out;
}

template <>
Delaunay<3> delaunay<3>(std::span<const Vec<3>> points, const std::vector<Facet<3>>&) {
  return near_part(closed_delaunay(points));
}

ClosedDelaunay closed_delaunay(std::span<const Vec<3>> points) {
  const double extent = extent_of(points);
  auto cloud = cgal_points<3>(points);
  for (const auto& x : far_points(extent)) cloud.push_back(cgal_point(x));
  ClosedDelaunay mesh = triangulated(cloud);
  mesh.extent = extent;
  return mesh;
}

double extent_of(std::span<const Vec<3>> points) {
  double largest = 0;
  for (const auto& x : points) largest = std::max(largest, x.lpNorm<Eigen::Infinity>());
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::ldexp(1.0, exponent);
}

// A tetrahedron that holds a ball of five extents; no symmetry that points in a row or a lattice might share.
std::array<Vec<3>, ClosedDelaunay::far> far_points(double extent) {
  return {extent * Vec<3>(16, 13, 11), extent * Vec<3>(-13, -16, 12), extent * Vec<3>(-11, 14, -15),
          extent * Vec<3>(12, -11, -14)};
}

// Corners ascend, but for the last two where orientation asks for it.
void sort_cells(ClosedDelaunay& mesh, std::size_t points) {
  using Cell = std::array<int, 4>;
  in_parallel(mesh.cells.size(), [&](std::size_t c) {
    Cell &cell = mesh.cells[c], &beyond = mesh.neighbours[c];
    if (cell[0] == ClosedDelaunay::gone) return;
    bool even = true;
    for (int last = 3; last > 0; --last)
      for (int k = 0; k < last; ++k)
        if (cell[k] > cell[k + 1]) std::swap(cell[k], cell[k + 1]), std::swap(beyond[k], beyond[k + 1]), even = !even;
    if (!even) std::swap(cell[2], cell[3]), std::swap(beyond[2], beyond[3]);
  });
  // A bucket for each first corner, and the last one for cells that reach far away.
  const int last = static_cast<int>(points);
  auto bucket = [&](const Cell& cell) { return std::max(cell[2], cell[3]) >= last ? last : cell[0]; };
  std::vector<int> start, order, place(mesh.cells.size());
  counting_sort(
      mesh.cells.size(), points + 1, start,
      [&](std::size_t c, auto put) {
        if (const Cell& cell = mesh.cells[c]; cell[0] != ClosedDelaunay::gone) put(bucket(cell), static_cast<int>(c));
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
    for (int i = 0; i < 4; ++i) neighbours[k][i] = place[mesh.neighbours[order[k]][i]];
  });
  mesh.cells = std::move(cells);
  mesh.neighbours = std::move(neighbours);
  mesh.near = static_cast<std::size_t>(start[points]);
}

Delaunay<3> near_part(const ClosedDelaunay& mesh) {
  Delaunay<3> out;
  out.cells.assign(mesh.cells.begin(), mesh.cells.begin() + static_cast<std::ptrdiff_t>(mesh.near));
  out.neighbours.resize(mesh.near);
  in_parallel(mesh.near, [&](std::size_t c) {
    for (int k = 0; k < 4; ++k) {
      const int beyond = mesh.neighbours[c][k];
      out.neighbours[c][k] = static_cast<std::size_t>(beyond) < mesh.near ? beyond : -1;
    }
  });
  return out;
}

template std::vector<std::size_t> spatial_order<2>(std::span<const Vec<2>>);
template std::vector<std::size_t> spatial_order<3>(std::span<const Vec<3>>);

}  // namespace splashdown::fluid
