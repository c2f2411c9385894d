#include "core/surface/clip.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/clip.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace splashdown {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polyhedron = CGAL::Surface_mesh<Kernel::Point_3>;

/// Of the box's diagonal: what is nearer to a side lies in it.
constexpr double flush = 1e-10;

template <int d>
Vec<d> snapped(Vec<d> x, const Eigen::AlignedBox<double, d>& box) {
  const double near = flush * box.diagonal().norm();
  for (int k = 0; k < d; ++k)
    for (const double side : {box.min()[k], box.max()[k]})
      if (std::abs(x[k] - side) <= near) x[k] = side;
  return x;
}

/// What of a polygon lies where sign x_k <= sign side (Sutherland and Hodgman 1974).
std::vector<Vec<2>> below(const std::vector<Vec<2>>& polygon, int k, double sign, double side) {
  std::vector<Vec<2>> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double over_a = sign * (a[k] - side), over_b = sign * (b[k] - side);
    if (over_a <= 0) kept.push_back(a);
    if ((over_a < 0 && over_b > 0) || (over_a > 0 && over_b < 0)) {
      Vec<2> cut = a + over_a / (over_a - over_b) * (b - a);
      cut[k] = side;
      kept.push_back(cut);
    }
  }
  return kept;
}

}  // namespace

template <>
Surface<2> clipped_to_box(const Surface<2>& surface, const Eigen::AlignedBox2d& box) {
  std::vector<Vec<2>> polygon;  // outlines are closed polylines in order
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f)
    polygon.emplace_back(surface.vertices.col(surface.facets(0, f)));
  for (int k = 0; k < 2; ++k) {
    polygon = below(polygon, k, -1, box.min()[k]);
    polygon = below(polygon, k, 1, box.max()[k]);
  }
  std::vector<Vec<2>> distinct;
  const double near = flush * box.diagonal().norm();
  for (auto& x : polygon) {
    x = snapped<2>(x, box);
    if (distinct.empty() || (x - distinct.back()).norm() > near) distinct.push_back(x);
  }
  while (distinct.size() > 1 && (distinct.back() - distinct.front()).norm() <= near) distinct.pop_back();
  Surface<2> part;
  if (distinct.size() < 3) return part;
  const auto n = static_cast<Eigen::Index>(distinct.size());
  part.vertices.resize(2, n);
  part.facets.resize(2, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    part.vertices.col(i) = distinct[static_cast<std::size_t>(i)];
    part.facets.col(i) << static_cast<int>(i), static_cast<int>((i + 1) % n);
  }
  return part;
}

template <>
Surface<3> clipped_to_box(const Surface<3>& surface, const Eigen::AlignedBox3d& box) {
  Polyhedron mesh;
  std::vector<Polyhedron::Vertex_index> vertices;
  for (Eigen::Index v = 0; v < surface.vertices.cols(); ++v) {
    const Vec<3> x = snapped<3>(surface.vertices.col(v), box);
    vertices.push_back(mesh.add_vertex({x.x(), x.y(), x.z()}));
  }
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
    const auto corner = [&](int k) { return vertices[static_cast<std::size_t>(surface.facets(k, f))]; };
    mesh.add_face(corner(0), corner(1), corner(2));
  }
  const Kernel::Iso_cuboid_3 cuboid({box.min().x(), box.min().y(), box.min().z()},
                                    {box.max().x(), box.max().y(), box.max().z()});
  try {
    pmp::clip(mesh, cuboid, CGAL::parameters::clip_volume(true).throw_on_self_intersection(true));
  } catch (const pmp::Corefinement::Self_intersection_exception&) {
    throw std::invalid_argument("its facets cross each other");
  }
  pmp::triangulate_faces(mesh);
  mesh.collect_garbage();
  Surface<3> part;
  part.vertices.resize(3, static_cast<Eigen::Index>(mesh.number_of_vertices()));
  part.facets.resize(3, static_cast<Eigen::Index>(mesh.number_of_faces()));
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    part.vertices.col(static_cast<Eigen::Index>(v)) = snapped<3>({p.x(), p.y(), p.z()}, box);
  }
  Eigen::Index f = 0;
  for (const auto face : mesh.faces()) {
    int k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(face))) part.facets(k++, f) = static_cast<int>(v);
    ++f;
  }
  return part;
}

}  // namespace splashdown
