// Writes the hull of this example, a fuselage with blunt wings, as ASCII STL to the standard output:
//
//   cmake --build build/release --target uav_hull && build/release/examples/uav_landing/uav_hull > uav.stl
//
// Fuselage and wing are superellipsoids, joined by a fillet. CGAL's Mesh_3 (Boissonnat and Oudot 2005) makes
// triangles of it that are watertight by construction. x points to the nose, z up, the origin is the middle
// of the fuselage; metres.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/facets_in_complex_3_to_triangle_mesh.h>
#include <CGAL/make_mesh_3.h>
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
using Eigen::Vector3d;

/// ((|u|^n + |w|^n)^(m/n) + |v|^m)^(1/m) = 1 in x / semi_axes: sections of exponent n across the axis v, m
/// along it.
struct Superellipsoid {
  Vector3d centre, semi_axes;
  int axis;
  double section, along;

  double value(const Vector3d& x) const {
    const Vector3d r = ((x - centre).array() / semi_axes.array()).abs();
    const double across = std::pow(r[(axis + 1) % 3], section) + std::pow(r[(axis + 2) % 3], section);
    return std::pow(std::pow(across, along / section) + std::pow(r[axis], along), 1 / along) - 1;
  }
  /// Distance from the surface to first order, value / |gradient| [m]; negative inside.
  double distance(const Vector3d& x) const {
    constexpr double step = 1e-5;
    Vector3d gradient;
    for (int k = 0; k < 3; ++k)
      gradient[k] = (value(x + step * Vector3d::Unit(k)) - value(x - step * Vector3d::Unit(k))) / (2 * step);
    return value(x) / std::max(gradient.norm(), 1.0);
  }
};

const Superellipsoid fuselage{{0, 0, 0}, {1.2, 0.28, 0.24}, 0, 2.5, 2.5};
const Superellipsoid wing{{0.05, 0, 0.14}, {0.28, 1.1, 0.07}, 1, 2.5, 4.0};
constexpr double fillet = 0.12;  // width of the blend [m]

/// Union of both with a fillet: the polynomial smooth minimum.
double hull(const Kernel::Point_3& p) {
  const Vector3d x(p.x(), p.y(), p.z());
  const double a = fuselage.distance(x), b = wing.distance(x);
  const double overlap = std::max(fillet - std::abs(a - b), 0.0) / fillet;
  return std::min(a, b) - 0.25 * fillet * overlap * overlap;
}

}  // namespace

int main() {
  const Domain domain = Domain::create_implicit_mesh_domain(hull, Kernel::Sphere_3(CGAL::ORIGIN, 4.0),
                                                            CGAL::parameters::relative_error_bound = 1e-6);
  const Criteria criteria(CGAL::parameters::facet_angle = 25, CGAL::parameters::facet_size = 0.08,
                          CGAL::parameters::facet_distance = 0.004);
  const Complex complex =
      CGAL::make_mesh_3<Complex>(domain, criteria, CGAL::parameters::no_perturb(), CGAL::parameters::no_exude());
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  CGAL::facets_in_complex_3_to_triangle_mesh(complex, surface);

  fmt::print("solid uav\n");
  for (const auto facet : surface.faces()) {
    fmt::print("facet normal 0 0 0\nouter loop\n");
    for (const auto vertex : CGAL::vertices_around_face(surface.halfedge(facet), surface)) {
      const auto& p = surface.point(vertex);
      fmt::print("vertex {:.5f} {:.5f} {:.5f}\n", p.x(), p.y(), p.z());
    }
    fmt::print("endloop\nendfacet\n");
  }
  fmt::print("endsolid uav\n");
}
