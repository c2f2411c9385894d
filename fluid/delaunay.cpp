#include "fluid/delaunay.hpp"

#include <CGAL/Bbox_3.h>
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <numeric>

#include "fluid/parallel.hpp"

namespace splashdown::fluid {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

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
  using Handle = Triangulation::Face_handle;
  template <class Map>
  using SortTraits = CGAL::Spatial_sort_traits_adapter_2<Kernel, Map>;
  static Point point(const Vec<2>& x) { return {x.x(), x.y()}; }
  static Handle of(Triangulation::Vertex_handle v) { return v->face(); }
  static auto all(Triangulation& t) { return t.all_face_handles(); }
  static void keep(Triangulation& t, const std::vector<Triangulation::Vertex_handle>& at,
                   const std::vector<Facet<2>>& facets) {
    for (const auto& f : facets) {
      const auto a = at[f.nodes[0]], b = at[f.nodes[1]];
      if (a == nullptr || b == nullptr || a == b || t.is_edge(a, b)) continue;
      try {
        t.insert_constraint(a, b);
      } catch (const Triangulation::Intersection_of_constraints_exception&) {
        // Two surfaces have met: the winding number decides what lies between them.
      }
    }
  }
};

template <>
struct Cgal<3> {
  using Vertex = CGAL::Triangulation_vertex_base_with_info_3<int, Kernel>;
  using Cell = CGAL::Triangulation_cell_base_with_info_3<int, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
  using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;
  using Point = Kernel::Point_3;
  using Handle = Triangulation::Cell_handle;
  template <class Map>
  using SortTraits = CGAL::Spatial_sort_traits_adapter_3<Kernel, Map>;
  static Point point(const Vec<3>& x) { return {x.x(), x.y(), x.z()}; }
  static Handle of(Triangulation::Vertex_handle v) { return v->cell(); }
  static auto all(Triangulation& t) { return t.all_cell_handles(); }
  static void keep(Triangulation&, const std::vector<Triangulation::Vertex_handle>&, const std::vector<Facet<3>>&) {}

  // Two threads insert in two thirds of the time that one takes; alone, this one takes a third more.
  using Parallel =
      CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, Cell, CGAL::Parallel_tag>>;
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
  CGAL::spatial_sort(order.begin(), order.end(),
                     typename Cgal<d>::template SortTraits<Map>(CGAL::make_property_map(points)));
  return order;
}

// Corners of each cell ascend, but for the last two where orientation asks for it, and so do cells: where nodes
// follow a space-filling curve, cells near each other are near in memory.
void sort_by_nodes(Delaunay<3>& mesh, std::size_t nodes) {
  using Cell = std::array<int, 4>;
  const std::size_t count = mesh.cells.size();
  in_parallel(count, [&](std::size_t c) {
    Cell &cell = mesh.cells[c], &beyond = mesh.neighbours[c];
    bool even = true;
    for (int last = 3; last > 0; --last)
      for (int k = 0; k < last; ++k)
        if (cell[k] > cell[k + 1]) std::swap(cell[k], cell[k + 1]), std::swap(beyond[k], beyond[k + 1]), even = !even;
    if (!even) std::swap(cell[2], cell[3]), std::swap(beyond[2], beyond[3]);
  });
  std::vector<int> start(nodes + 1, 0), order(count), place(count);
  for (const Cell& cell : mesh.cells) ++start[cell[0] + 1];
  for (std::size_t n = 0; n < nodes; ++n) start[n + 1] += start[n];
  std::vector<int> next(start.begin(), start.end() - 1);
  for (std::size_t c = 0; c < count; ++c) order[next[mesh.cells[c][0]]++] = static_cast<int>(c);
  in_parallel(nodes, [&](std::size_t n) {
    std::sort(order.begin() + start[n], order.begin() + start[n + 1],
              [&](int a, int b) { return mesh.cells[a] < mesh.cells[b]; });
    for (int k = start[n]; k < start[n + 1]; ++k) place[order[k]] = k;
  });
  Delaunay<3> sorted;
  sorted.cells.resize(count);
  sorted.neighbours.resize(count);
  in_parallel(count, [&](std::size_t k) {
    sorted.cells[k] = mesh.cells[order[k]];
    for (int i = 0; i < 4; ++i) {
      const int beyond = mesh.neighbours[order[k]][i];
      sorted.neighbours[k][i] = beyond < 0 ? -1 : place[beyond];
    }
  });
  mesh = std::move(sorted);
}
void sort_by_nodes(Delaunay<2>&, std::size_t) {}  // triangles are few

template <int d, class Triangulation, class Handles>
void read_cells(const Triangulation& t, const Handles& handles, Delaunay<d>& out) {
  int count = 0;
  for (auto c : handles) c->info() = t.is_infinite(c) ? -1 : count++;
  out.cells.resize(count);
  out.neighbours.resize(count);
  for (auto c : handles) {
    if (c->info() < 0) continue;
    for (int k = 0; k <= d; ++k) {
      out.cells[c->info()][k] = c->vertex(k)->info();
      out.neighbours[c->info()][k] = c->neighbor(k)->info();
    }
  }
}

bool in_parallel_pays(std::size_t points) {
  constexpr std::size_t enough = 10000;
  return threads() > 1 && points >= enough;
}

// The triangulation is that of one thread: CGAL perturbs points that are not in general position by their coordinates, not
// by the order of their insertion. False where points coincide: which of them stays does depend on the order.
bool triangulated_in_parallel(const std::vector<Kernel::Point_3>& cloud, Delaunay<3>& out) {
  using Triangulation = Cgal<3>::Parallel;
  std::vector<std::pair<Kernel::Point_3, int>> numbered;
  numbered.reserve(cloud.size());
  for (const auto& point : cloud) numbered.emplace_back(point, static_cast<int>(numbered.size()));
  constexpr int cells_of_the_lock_grid = 20;  // along an axis; 10 to 50 make no difference
  Triangulation::Lock_data_structure lock(CGAL::bbox_3(cloud.begin(), cloud.end()), cells_of_the_lock_grid);
  Triangulation t(numbered.begin(), numbered.end(), &lock);
  if (t.number_of_vertices() != cloud.size() || t.dimension() < 3) return false;
  read_cells(t, t.all_cell_handles(), out);
  sort_by_nodes(out, cloud.size());
  return true;
}
// CGAL inserts in parallel in space only.
bool triangulated_in_parallel(const std::vector<Kernel::Point_2>&, Delaunay<2>&) { return false; }

}  // namespace

template <int d>
std::vector<std::size_t> spatial_order(std::span<const Vec<d>> points) {
  return order_of<d>(cgal_points<d>(points));
}

template <int d>
Delaunay<d> delaunay(std::span<const Vec<d>> points, const std::vector<Facet<d>>& facets) {
  using C = Cgal<d>;
  const auto cloud = cgal_points<d>(points);
  Delaunay<d> out;
  if (in_parallel_pays(points.size()) && triangulated_in_parallel(cloud, out)) return out;
  typename C::Triangulation t;
  typename C::Handle hint;
  std::vector<typename C::Triangulation::Vertex_handle> at(points.size());
  for (std::size_t i : order_of<d>(cloud)) {
    const std::size_t before = t.number_of_vertices();
    const auto v = t.insert(cloud[i], hint);
    if (t.number_of_vertices() > before) v->info() = static_cast<int>(i);
    at[i] = v;
    hint = C::of(v);
  }
  if (t.dimension() < d) return {};
  C::keep(t, at, facets);
  read_cells(t, C::all(t), out);
  sort_by_nodes(out, points.size());
  return out;
}

template Delaunay<2> delaunay<2>(std::span<const Vec<2>>, const std::vector<Facet<2>>&);
template Delaunay<3> delaunay<3>(std::span<const Vec<3>>, const std::vector<Facet<3>>&);
template std::vector<std::size_t> spatial_order<2>(std::span<const Vec<2>>);
template std::vector<std::size_t> spatial_order<3>(std::span<const Vec<3>>);

}  // namespace splashdown::fluid
