#include "elastic/mesh/volume_mesh.hpp"

#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/exude_mesh_3.h>
#include <CGAL/make_mesh_3.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "elastic/mesh/peel.hpp"

namespace splashdown::elastic {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Skin = CGAL::Surface_mesh<Kernel::Point_3>;
using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel, Skin>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index, Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

/// More cells than a run can bear.
struct TooMany : MeshError {
  TooMany()
      : MeshError("the mesh would have more than 200000 elements",
                  "Use larger elements, or make the thinnest parts of the shape thicker: they get elements as small as "
                  "they are thin.") {}
};

Skin skin_of(const Surface<3>& surface) {
  Skin skin;
  for (Eigen::Index a = 0; a < surface.vertices.cols(); ++a)
    skin.add_vertex({surface.vertices(0, a), surface.vertices(1, a), surface.vertices(2, a)});
  const auto corner = [&](int k, Eigen::Index f) {
    return Skin::Vertex_index(static_cast<Skin::size_type>(surface.facets(k, f)));
  };
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) skin.add_face(corner(0, f), corner(1, f), corner(2, f));
  return skin;
}

/// Mesh_3 bounds circumradii from above: with these factors the longest edge is about `size`, and two thirds of it the mean one, as
/// in the plane.
Complex filled(const Domain& domain, double size) {
  namespace params = CGAL::parameters;
  const Criteria criteria(params::edge_size = 0.7 * size, params::facet_angle = 25, params::facet_size = 0.43 * size,
                          params::facet_distance = 0.05 * size, params::cell_radius_edge_ratio = 2,
                          params::cell_size = 0.48 * size);
  CGAL::get_default_random() = CGAL::Random(0);  // else its seed is the time
  CGAL::Mesh_error_code stop = CGAL::CGAL_MESH_3_NO_ERROR;
  constexpr std::size_t most_corners = 40000;  // of 200 000 cells
  auto complex = CGAL::make_mesh_3<Complex>(
      domain, criteria, params::manifold(), params::no_perturb(), params::no_exude(),
      params::mesh_3_options(params::maximal_number_of_vertices = most_corners, params::pointer_to_error_code = &stop));
  if (stop != CGAL::CGAL_MESH_3_NO_ERROR) throw TooMany();
  CGAL::exude_mesh_3(complex);  // as far as it gets
  return complex;
}

SolidMesh<3> collected(const Complex& complex) {
  std::map<Triangulation::Vertex_handle, int> number;
  std::vector<Vec<3>> points;
  Simplices<3> simplices;
  for (auto c = complex.cells_in_complex_begin(); c != complex.cells_in_complex_end(); ++c) {
    auto& simplex = simplices.emplace_back();
    for (int k = 0; k < 4; ++k) {
      const auto [at, is_new] = number.try_emplace(c->vertex(k), static_cast<int>(points.size()));
      const auto& p = c->vertex(k)->point();
      if (is_new) points.emplace_back(p.x(), p.y(), p.z());
      simplex[static_cast<std::size_t>(k)] = at->second;
    }
  }
  Points<3> corners(3, points.size());
  for (std::size_t a = 0; a < points.size(); ++a) corners.col(static_cast<Eigen::Index>(a)) = points[a];
  constexpr double flat = 0.1;  // a cell of such a mean ratio has a fortieth of a regular one's volume
  return quadratic_mesh<3>(corners, peeled(corners, std::move(simplices), flat));
}

double volume_of(const Surface<3>& surface) {
  double sum = 0;
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f)
    sum += surface.vertices.col(surface.facets(0, f))
               .dot(surface.vertices.col(surface.facets(1, f)).cross(surface.vertices.col(surface.facets(2, f)))) /
           6;
  return sum;
}

double volume_of(const SolidMesh<3>& mesh) {
  double sum = 0;
  for (const auto& cell : mesh.cells) {
    Mat<3> sides;
    for (int i = 0; i < 3; ++i) sides.col(i) = mesh.nodes.col(cell[i + 1]) - mesh.nodes.col(cell[0]);
    sum += sides.determinant() / 6;
  }
  return sum;
}

/// The boundary has no edge where more than two facets meet: such a wall has no inside there.
void require_surface(const SolidMesh<3>& mesh) {
  std::map<std::pair<int, int>, int> count;
  for (const auto& facet : mesh.facets)
    for (int i = 0; i < 3; ++i) ++count[std::minmax(facet[i], facet[(i + 1) % 3])];
  for (const auto& [ends, facets] : count)
    if (facets != 2) throw MeshError("parts of the mesh touch at an edge", "Use smaller elements.");
}

void require_volume(const SolidMesh<3>& mesh, const Surface<3>& surface) {
  constexpr double chords = 0.1;  // a sphere of fifty elements lacks so much
  const double share = volume_of(mesh) / volume_of(surface);
  if (std::abs(share - 1) < chords) return;
  std::ostringstream text;
  text.precision(3);
  text << "the mesh has " << share << " of the shape's volume";
  throw MeshError(text.str(), "Use smaller elements: half of the thinnest part.");
}

}  // namespace

SolidMesh<3> volume_mesh(const Surface<3>& surface, double size) {
  const Skin skin = skin_of(surface);
  constexpr double crease = 30;  // degrees, as of hulls
  constexpr int most = 8;        // the last asks for a fifth
  std::optional<MeshError> last;
  double asked = size;
  CGAL::Random random(0);
  Domain domain(skin, &random);
  domain.detect_features(crease);
  for (int attempt = 0; attempt < most; ++attempt) {
    random = CGAL::Random(0);
    try {
      auto mesh = collected(filled(domain, asked));
      require_surface(mesh);
      require_volume(mesh, surface);
      const double longest = longest_edge(mesh);
      if (longest <= size) return mesh;
      asked *= 0.95 * size / longest;
    } catch (const TooMany&) {
      throw;
    } catch (const MeshError& error) {
      last = error;
      asked *= 0.8;
    } catch (const CGAL::Failure_exception&) {
      last = MeshError("no mesh fills the shape", "Use another size, or give a mesh of Gmsh.");
      asked *= 0.93;
    }
  }
  throw last.value_or(MeshError("no mesh has edges as short as size", "Use another size."));
}

}  // namespace splashdown::elastic
