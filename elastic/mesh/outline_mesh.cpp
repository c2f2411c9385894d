#include "elastic/mesh/outline_mesh.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "core/surface/sized_triangles.hpp"

namespace splashdown::elastic {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertices = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<Vertices, CGAL::Delaunay_mesh_face_base_2<Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;

/// Constrained by the outline, and by lines inside where there are any.
Triangulation outlined(const Surface<2>& outline, const InnerLines& lines) {
  Triangulation triangles;
  const auto insert = [&](const Vec<2>& a, const Vec<2>& b) {
    triangles.insert_constraint({a.x(), a.y()}, {b.x(), b.y()});
  };
  try {
    if (lines.empty())
      for (Eigen::Index f = 0; f < outline.facets.cols(); ++f)
        insert(outline.vertices.col(outline.facets(0, f)), outline.vertices.col(outline.facets(1, f)));
    else {
      constexpr double near = 1e-6;  // of the extent: what is drawn to touch does
      const Vec<2> sides = outline.vertices.rowwise().maxCoeff() - outline.vertices.rowwise().minCoeff();
      const auto all = lined(outline, lines, near * sides.maxCoeff());
      for (const auto& [a, b] : all.pieces) insert(all.vertices.col(a), all.vertices.col(b));
    }
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    throw MeshError("the outline crosses itself", "Give its corners in turn, once around.");
  }
  return triangles;
}

SolidMesh<2> collected(Triangulation& triangles) {
  Points<2> corners(2, triangles.number_of_vertices());
  int count = 0;
  for (const auto vertex : triangles.finite_vertex_handles()) {
    corners.col(count) << vertex->point().x(), vertex->point().y();
    vertex->info() = count++;
  }
  Simplices<2> simplices;
  for (const auto face : triangles.finite_face_handles())
    if (face->is_in_domain())
      simplices.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return quadratic_mesh<2>(corners, simplices);
}

}  // namespace

SolidMesh<2> outline_mesh(const Surface<2>& outline, double size, const InnerLines& lines) {
  auto triangles = outlined(outline, lines);
  constexpr double shape = 0.125;  // sin^2 of the least angle that refinement is proven to end with
  CGAL::refine_Delaunay_mesh_2(triangles, CGAL::Delaunay_mesh_size_criteria_2<Triangulation>(shape, size));
  return collected(triangles);
}

SolidMesh<2> outline_mesh(const Surface<2>& outline, const std::function<double(const Vec<2>&)>& size,
                          const InnerLines& lines) {
  auto triangles = outlined(outline, lines);
  const SizedTriangles<Triangulation> criteria(size);
  CGAL::refine_Delaunay_mesh_2(triangles, criteria);
  return collected(triangles);
}

}  // namespace splashdown::elastic
