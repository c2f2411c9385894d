#include "core/surface/cut.hpp"

#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>

#include <cmath>

#include "core/surface/soup.hpp"
#include "core/surface/surface_file.hpp"

namespace splashdown {
namespace {

// Two triangles a side; corner number k of 8 has its bit b set where it is at the upper end of axis b.
Shell shell_of(const Eigen::AlignedBox3d& box) {
  Surface<3> surface{Eigen::Matrix3Xd(3, 8), Eigen::Matrix3Xi(3, 12)};
  for (int v = 0; v < 8; ++v)
    for (int k = 0; k < 3; ++k) surface.vertices(k, v) = v >> k & 1 ? box.max()[k] : box.min()[k];
  surface.facets << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
      2, 3, 5, 7, 1, 5, 6, 7, 4, 6, 3, 7,                //
      3, 1, 7, 6, 5, 4, 7, 3, 6, 2, 7, 5;
  return shell_of(surface);
}

/// What rounding and the merging of points have moved off the sides goes back to them.
Vec<3> on_sides(Vec<3> x, const Eigen::AlignedBox3d& box) {
  const double near = 2e-6 * box.diagonal().norm();  // twice what merge_points moves
  for (int k = 0; k < 3; ++k)
    for (const double side : {box.min()[k], box.max()[k]})
      if (std::abs(x[k] - side) <= near) x[k] = side;
  return x;
}

}  // namespace

Surface<3> cut_at_box(const Surface<3>& surface, const Eigen::AlignedBox3d& box) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  auto solid = shell_of(surface), sides = shell_of(box);
  Shell part;
  if (!pmp::corefine_and_compute_intersection(solid, sides, part))
    throw SurfaceFileError("has a part in the tank that is not the surface of a solid",
                           "Move a side of the tank a little, or mend the place.");
  pmp::remove_degenerate_faces(part);
  Soup soup = soup_of(part);
  Surface<3> cut;
  if (soup.polygons.empty()) return cut;
  merge_points(soup);  // where an edge crosses two sides but for rounding
  pmp::repair_polygon_soup(soup.points, soup.polygons);
  cut = surface_of(soup);
  for (auto vertex : cut.vertices.colwise()) vertex = on_sides(vertex, box);
  return cut;
}

}  // namespace splashdown
