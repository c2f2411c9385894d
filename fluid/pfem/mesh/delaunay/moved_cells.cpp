#include "fluid/pfem/mesh/delaunay/moved_cells.hpp"

#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {

template <int d>
MovedCells<d>::MovedCells(ClosedDelaunay<d>& m, std::span<const Vec<d>> points)
    : mesh(m), infinity(static_cast<int>(points.size()) + ClosedDelaunay<d>::far), at(infinity) {
  in_parallel(points.size(), [&](std::size_t i) { at[i] = Cgal<d>::point(points[i]); });
  const auto far = far_points<d>(mesh.extent);
  std::transform(far.begin(), far.end(), at.begin() + static_cast<std::ptrdiff_t>(points.size()), Cgal<d>::point);
}

template <int d>
bool MovedCells<d>::lost_a_corner(const Cell& cell) {
  return std::any_of(cell.begin(), cell.end(), [](int n) { return n < 0; });
}

template <int d>
auto MovedCells<d>::points_of(const Cell& cell) const -> std::array<const typename Cgal<d>::Point*, d + 1> {
  std::array<const typename Cgal<d>::Point*, d + 1> p;
  for (int k = 0; k <= d; ++k) p[k] = &at[cell[k]];
  return p;
}

template <int d>
CGAL::Orientation MovedCells<d>::orientation(const Cell& cell) const {
  return is_.orientation(points_of(cell));
}

template <int d>
bool MovedCells<d>::in_conflict(const Cell& cell, int point) const {
  return is_.within_sphere(points_of(cell), at[point]);
}

template <int d>
bool MovedCells<d>::locally_delaunay(const FacetAt& f) const {
  const FacetAt other = beyond(f);
  const int opposite = mesh.cells[other.cell][other.corner];
  return opposite < 0 || opposite == infinity || !in_conflict(mesh.cells[f.cell], opposite);
}

template <int d>
FacetAt MovedCells<d>::beyond(const FacetAt& f) const {
  const int cell = mesh.neighbours[f.cell][f.corner];
  const Cell& back = mesh.neighbours[cell];
  int corner = d;  // (without a jump: each step asks this of every facet)
  for (int k = d - 1; k >= 0; --k) corner = back[k] == f.cell ? k : corner;
  return {cell, corner};
}

template <int d>
std::array<int, d> MovedCells<d>::facet_of(const Cell& cell, int corner) {
  auto facet = facet_nodes(cell, corner);
  if constexpr (d == 3) std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
  return facet;
}

template <int d>
int MovedCells<d>::locate(int point, int start) const {
  int c = start;
  for (std::size_t step = 0; step < mesh.cells.size() && finite(mesh.cells[c]); ++step) {
    int through = -1;
    for (int k = 0; k <= d && through < 0; ++k) {
      Cell towards = mesh.cells[c];
      towards[k] = point;
      if (orientation(towards) == CGAL::NEGATIVE) through = k;
    }
    if (through < 0) return c;
    c = mesh.neighbours[c][through];
  }
  return c;
}

template class MovedCells<2>;
template class MovedCells<3>;

}  // namespace splashdown::fluid
