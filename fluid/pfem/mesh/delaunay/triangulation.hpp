// CGAL's Delaunay triangulations in plane and space, for the sources of this folder alone.
#pragma once

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include "fluid/pfem/types.hpp"

namespace splashdown::fluid {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Vertices and cells carry their number.
template <class Concurrency>
using TriangulationInSpace = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_with_info_3<int, Kernel>,
                                                 CGAL::Triangulation_cell_base_with_info_3<
                                                     int, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>,
                                                 Concurrency>>;
/// Vertices and faces carry their number.
using TriangulationInThePlane = CGAL::Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>,
                                                 CGAL::Triangulation_face_base_with_info_2<int, Kernel>>>;

/// The two under the same names.
template <int d>
struct Cgal;

/// In the plane.
template <>
struct Cgal<2> {
  /// Of CGAL.
  using Triangulation = TriangulationInThePlane;
  /// Handle of a face.
  using Cell = Triangulation::Face_handle;
  /// Of its kernel.
  using Point = Kernel::Point_2;
  /// The same point [m].
  static Point point(const Vec<2>& x) { return {x.x(), x.y()}; }
  /// One of the faces around a vertex.
  static Cell cell_of(Triangulation::Vertex_handle v) { return v->face(); }
  /// All faces, those at infinity included.
  static auto cells(const Triangulation& t) { return t.all_face_handles(); }
};

/// In three dimensions.
template <>
struct Cgal<3> {
  /// Of CGAL, on one thread.
  using Triangulation = TriangulationInSpace<CGAL::Sequential_tag>;
  /// Handle of a cell.
  using Cell = Triangulation::Cell_handle;
  /// Of its kernel.
  using Point = Kernel::Point_3;
  /// The same point [m].
  static Point point(const Vec<3>& x) { return {x.x(), x.y(), x.z()}; }
  /// One of the cells around a vertex.
  static auto cell_of(const auto& vertex) { return vertex->cell(); }
  /// All cells, those at infinity included.
  static auto cells(const auto& t) { return t.all_cell_handles(); }
};

/// Opens CGAL's predicates, which perturb points in special position as its triangulations do, to cells that those do
/// not hold.
template <int d>
class Predicates : private Cgal<d>::Triangulation {
 public:
  /// Of CGAL's kernel.
  using Point = typename Cgal<d>::Point;

  /// Of a cell with these corners: exact.
  CGAL::Orientation orientation(const std::array<const Point*, d + 1>& p) const {
    if constexpr (d == 2)
      return Base::orientation(*p[0], *p[1], *p[2]);
    else
      return Base::orientation(*p[0], *p[1], *p[2], *p[3]);
  }
  /// Of a positive cell's circumsphere.
  bool within_sphere(const std::array<const Point*, d + 1>& p, const Point& x) const {
    if constexpr (d == 2)
      return Base::side_of_oriented_circle(*p[0], *p[1], *p[2], x, true) == CGAL::ON_POSITIVE_SIDE;
    else
      return Base::side_of_oriented_sphere(*p[0], *p[1], *p[2], *p[3], x, true) == CGAL::ON_POSITIVE_SIDE;
  }

 private:
  using Base = typename Cgal<d>::Triangulation;
};

}  // namespace splashdown::fluid
