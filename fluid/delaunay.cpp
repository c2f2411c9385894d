#include "fluid/delaunay.hpp"

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

#include <numeric>

namespace splashdown::fluid {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

template <int d>
struct Cgal;

template <>
struct Cgal<2> {
  using Vertex = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
  using Cell = CGAL::Triangulation_face_base_with_info_2<int, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
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
  using Triangulation =
      CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;
  using Point = Kernel::Point_3;
  using Handle = Triangulation::Cell_handle;
  template <class Map>
  using SortTraits = CGAL::Spatial_sort_traits_adapter_3<Kernel, Map>;
  static Point point(const Vec<3>& x) { return {x.x(), x.y(), x.z()}; }
  static Handle of(Triangulation::Vertex_handle v) { return v->cell(); }
  static auto all(Triangulation& t) { return t.all_cell_handles(); }
  static void keep(Triangulation&, const std::vector<Triangulation::Vertex_handle>&, const std::vector<Facet<3>>&) {}
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
  std::iota(order.begin(), order.end(), 0);
  using Map = typename CGAL::Pointer_property_map<typename Cgal<d>::Point>::const_type;
  CGAL::spatial_sort(order.begin(), order.end(), typename Cgal<d>::template SortTraits<Map>(CGAL::make_property_map(points)));
  return order;
}

}  // namespace

template <int d>
std::vector<std::size_t> spatial_order(std::span<const Vec<d>> points) {
  return order_of<d>(cgal_points<d>(points));
}

template <int d>
Delaunay<d> delaunay(std::span<const Vec<d>> points, const std::vector<Facet<d>>& facets) {
  using C = Cgal<d>;
  const auto cloud = cgal_points<d>(points);
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
  Delaunay<d> out;
  if (t.dimension() < d) return out;
  C::keep(t, at, facets);
  int count = 0;
  for (auto c : C::all(t)) c->info() = t.is_infinite(c) ? -1 : count++;
  out.cells.resize(count);
  out.neighbours.resize(count);
  for (auto c : C::all(t)) {
    if (c->info() < 0) continue;
    for (int k = 0; k <= d; ++k) {
      out.cells[c->info()][k] = c->vertex(k)->info();
      out.neighbours[c->info()][k] = c->neighbor(k)->info();
    }
  }
  return out;
}

template Delaunay<2> delaunay<2>(std::span<const Vec<2>>, const std::vector<Facet<2>>&);
template Delaunay<3> delaunay<3>(std::span<const Vec<3>>, const std::vector<Facet<3>>&);
template std::vector<std::size_t> spatial_order<2>(std::span<const Vec<2>>);
template std::vector<std::size_t> spatial_order<3>(std::span<const Vec<3>>);

}  // namespace splashdown::fluid
