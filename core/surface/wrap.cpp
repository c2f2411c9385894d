#include "core/surface/wrap.hpp"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <vector>

namespace splashdown {
namespace {

using WrapMesh = CGAL::Surface_mesh<Soup::Kernel::Point_3>;

constexpr double gap_share = 1. / 30;  // of the opening: CGAL's advice

using Triangles = std::vector<std::array<std::size_t, 3>>;

/// Polygons as fans.
Triangles triangles_of(const Soup& soup) {
  Triangles triangles;
  for (const auto& polygon : soup.polygons)
    for (std::size_t k = 2; k < polygon.size(); ++k) triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
  return triangles;
}

WrapMesh wrap_at(const Soup& soup, const Triangles& triangles, double opening) {
  WrapMesh mesh;
  CGAL::alpha_wrap_3(soup.points, triangles, opening, gap_share * opening, mesh);
  return mesh;
}

double volume_of(const WrapMesh& mesh) { return std::abs(CGAL::Polygon_mesh_processing::volume(mesh)); }

}  // namespace

Wrap wrapped(const Soup& soup) {
  constexpr double finest = 0.01, coarsest = 0.05, coarser = 1.5, filled = 0.5;
  const auto triangles = triangles_of(soup);
  const double extent = soup.extent(), solid = filled * volume_of(wrap_at(soup, triangles, coarsest * extent));
  double share = finest;
  WrapMesh mesh = wrap_at(soup, triangles, share * extent);
  while (share < coarsest && volume_of(mesh) < solid) mesh = wrap_at(soup, triangles, (share *= coarser) * extent);
  Wrap wrap{{}, share * extent, gap_share * share * extent};
  wrap.surface.vertices.resize(3, static_cast<Eigen::Index>(mesh.number_of_vertices()));
  wrap.surface.facets.resize(3, static_cast<Eigen::Index>(mesh.number_of_faces()));
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    wrap.surface.vertices.col(static_cast<Eigen::Index>(v)) << p.x(), p.y(), p.z();
  }
  Eigen::Index f = 0;
  for (const auto face : mesh.faces()) {
    Eigen::Index k = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(face), mesh))
      wrap.surface.facets(k++, f) = static_cast<int>(static_cast<std::size_t>(v));
    ++f;
  }
  return wrap;
}

}  // namespace splashdown
