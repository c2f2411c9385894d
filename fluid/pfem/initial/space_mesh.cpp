// In 3D: CGAL's Mesh_3 fills a skin to the size field.
#include <CGAL/Mesh_3/C3T3_helpers.h>
#include <CGAL/Mesh_3/Mesher_3.h>
#include <CGAL/Mesh_3/Protect_edges_sizing_field.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_domain_with_polyline_features_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_3.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fluid/pfem/initial/space_parts.hpp"

namespace splashdown::fluid {
namespace {

using Domain = CGAL::Mesh_domain_with_polyline_features_3<CGAL::Polyhedral_mesh_domain_3<Rounded, Kernel>>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index, Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

// h times a factor, for Mesh_3, which asks for it all the time.
struct Sizing {
  using FT = Kernel::FT;
  using Point_3 = Kernel::Point_3;
  using Index = Domain::Index;
  const SizeField<3>* field;
  double factor;
  const std::function<void()>* meanwhile;
  FT operator()(const Point_3& p, int, const Index&) const {
    if (*meanwhile) (*meanwhile)();
    return factor * (*field)(vec(p));
  }
};

// What make_mesh_3 of CGAL 5.5 does first. It is not called itself: its optimisers, which are not wanted, are a quarter of what there is to
// compile here.
void protect_edges(const Domain& domain, const Sizing& size, Complex& complex) {
  CGAL::Mesh_3::Protect_edges_sizing_field<Complex, Domain, Sizing>(complex, domain, size)(true);
  if (complex.triangulation().dimension() == 3) {
    CGAL::Mesh_3::C3T3_helpers<Complex, Domain>(complex, domain).update_restricted_facets();
    if (complex.number_of_facets() > 0) return;
  }
  // Too few edges to begin with: points of the surface.
  std::vector<std::pair<Kernel::Point_3, Domain::Index>> points;
  domain.construct_initial_points_object()(std::back_inserter(points));
  const auto weighted = complex.triangulation().geom_traits().construct_weighted_point_3_object();
  for (const auto& [point, index] : points) {
    const auto v = complex.triangulation().insert(weighted(point));
    if (v == Triangulation::Vertex_handle()) continue;  // hidden
    complex.set_dimension(v, 2);
    complex.set_index(v, index);
  }
}

// Mesh_3 bounds circumradii from above; these factors, of `scale` 1, make the mean edge about h.
Complex meshed(const Domain& domain, const Sizing& sizing, double scale) {
  namespace params = CGAL::parameters;
  const auto times = [&](double factor) { return Sizing{sizing.field, factor, sizing.meanwhile}; };
  const Sizing edges = times(scale), facets = times(0.75 * scale), cells = times(0.8 * scale), sag = times(0.1);
  const Criteria criteria(params::edge_size = edges, params::facet_angle = 25, params::facet_size = facets,
                          params::facet_distance = sag, params::cell_radius_edge_ratio = 2, params::cell_size = cells);
  Complex complex;
  protect_edges(domain, edges, complex);
  CGAL::Mesh_3::Mesher_3<Complex, Criteria, Domain>(complex, domain, criteria).refine_mesh();
  complex.clear_manifold_info();
  return complex;
}

// Roundoff where edges of bodies meet all but exactly may stop Mesh_3 at one of its assertions. Other points do not lie there.
Complex meshed(const Domain& domain, const Sizing& sizing) {
  for (const double scale : {1.0, 0.97, 0.94, 0.9}) {
    try {
      return meshed(domain, sizing, scale);
    } catch (const CGAL::Failure_exception&) {
    }
  }
  throw std::invalid_argument(
      "no mesh fills the liquid: edges of bodies, tank and surface come closer to each other than a mesh resolves. "
      "Move the bodies by a hundredth of their size, or give them other sizes");
}

// Cells of the liquid. Mesh_3 takes those whose circumcentre lies in it, which in gaps thinner than an element leaves out some
// that do themselves, and holes in the water where they are, and takes some that lie in a wall.
class LiquidCells {
 public:
  LiquidCells(const Complex& complex, const Domain& domain)
      : complex_(complex), is_liquid_(domain.is_in_domain_object()) {}

  bool operator()(Triangulation::Cell_handle cell) {
    if (complex_.triangulation().is_infinite(cell)) return false;
    const bool is_taken = complex_.is_in_complex(cell);
    if (is_taken && !is_between_boundaries(cell)) return true;
    const auto [known, fresh] = doubtful_.try_emplace(cell, false);
    if (fresh) known->second = is_taken ? is_liquid(centroid(cell)) : lies_in_liquid(cell);
    return known->second;
  }

 private:
  bool is_liquid(const Vec<3>& at) const { return is_liquid_(Kernel::Point_3(at.x(), at.y(), at.z())).has_value(); }
  static bool is_between_boundaries(Triangulation::Cell_handle cell) {
    return std::ranges::all_of(std::array{0, 1, 2, 3}, [&](int k) { return cell->vertex(k)->in_dimension() < 3; });
  }
  Vec<3> corner(Triangulation::Cell_handle cell, int k) const {
    return vec(complex_.triangulation().point(cell, k).point());
  }
  Vec<3> centroid(Triangulation::Cell_handle cell) const {
    return (corner(cell, 0) + corner(cell, 1) + corner(cell, 2) + corner(cell, 3)) / 4;
  }
  // By its centroid and a point towards each corner.
  bool lies_in_liquid(Triangulation::Cell_handle cell) const {
    const std::array x{corner(cell, 0), corner(cell, 1), corner(cell, 2), corner(cell, 3)};
    const Vec<3> middle = centroid(cell);
    constexpr double towards = 0.9, flat = 1e-9;  // volume over the longest edge's cube
    double longest = 0;
    for (int k = 1; k < 4; ++k)
      for (int j = 0; j < k; ++j) longest = std::max(longest, (x[k] - x[j]).norm());
    if (volume<3>([&](int k) { return x[k]; }) < flat * longest * longest * longest) return false;
    return is_liquid(middle) &&
           std::ranges::all_of(x, [&](const Vec<3>& at) { return is_liquid(middle + towards * (at - middle)); });
  }

  const Complex& complex_;
  const Domain::Is_in_domain is_liquid_;
  std::map<Triangulation::Cell_handle, bool> doubtful_;
};

void append(const Complex& complex, const Domain& domain, const WallsAt<3>& walls, InitialLiquid<3>& out) {
  const auto& triangulation = complex.triangulation();
  LiquidCells is_liquid(complex, domain);
  std::map<Triangulation::Vertex_handle, int> at;
  auto node = [&](Triangulation::Vertex_handle v) {
    const auto [known, fresh] = at.try_emplace(v, 0);
    if (fresh) {
      const Vec<3> x = vec(triangulation.point(v).point());
      known->second =
          out.nodes.add(x, Vec<3>::Zero(), 0, v->in_dimension() < 3 ? tie_at<3>(x, walls) : WallTie{}, false);
    }
    return known->second;
  };
  for (const Triangulation::Cell_handle c : triangulation.finite_cell_handles()) {
    if (!is_liquid(c)) continue;
    for (int k = 0; k < 4; ++k) {
      node(c->vertex(k));
      const auto other = c->neighbor(k);
      if (is_liquid(other)) continue;
      Facet<3> f;
      for (int j = 0; j < 3; ++j) f.nodes[j] = node(c->vertex(opposite<3>[k][j]));
      out.mesh.boundary.push_back(f);
    }
  }
}

}  // namespace

void fill_within(const Rounded& skin, const Curves& curves, const SizeField<3>& field, const WallsAt<3>& walls,
                 const std::function<void()>& meanwhile, InitialLiquid<3>& out) {
  CGAL::Random random(0);
  Domain domain(skin, &random);
  domain.add_features(curves.lines.begin(), curves.lines.end());
  for (const auto& corner : curves.corners) domain.add_corner(corner);
  append(meshed(domain, Sizing{&field, 1, &meanwhile}), domain, walls, out);
}

}  // namespace splashdown::fluid
