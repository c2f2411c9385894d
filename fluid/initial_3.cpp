// In space: walls cut the regions exactly (corefinement), and CGAL's Mesh_3 fills what is left to the size field.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_domain_with_polyline_features_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polyhedral_mesh_domain_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/split_graph_into_polylines.h>
#include <CGAL/make_mesh_3.h>

#include <boost/graph/adjacency_list.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "fluid/initial_parts.hpp"

namespace splashdown::fluid {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Surface_mesh<CGAL::Exact_predicates_exact_constructions_kernel::Point_3>;
using Rounded = CGAL::Surface_mesh<Kernel::Point_3>;
using Domain = CGAL::Mesh_domain_with_polyline_features_3<CGAL::Polyhedral_mesh_domain_3<Rounded, Kernel>>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index, Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

constexpr double speck = 1e-10;  // over the liquid's size: shorter edges are roundoff

Vec<3> vec(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

Exact exact(const Surface<3>& surface, const Isometry<3>& pose) {
  Exact mesh;
  std::vector<Exact::Vertex_index> at;
  for (Eigen::Index v = 0; v < surface.vertices.cols(); ++v) {
    const Vec<3> x = pose * Vec<3>(surface.vertices.col(v));
    at.push_back(mesh.add_vertex({x.x(), x.y(), x.z()}));
  }
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f)
    mesh.add_face(at[surface.facets(0, f)], at[surface.facets(1, f)], at[surface.facets(2, f)]);
  return mesh;
}

Exact clipped(const LiquidSpec<3>& liquid, const WallsAt<3>& walls) {
  Exact region = exact(liquid.boundary, Isometry<3>::Identity());
  for (std::size_t w = 0; w < walls.walls.size(); ++w) {
    Exact wall = exact(walls.walls[w].spec().surface, walls.poses[w]), cut;
    bool simple;
    if (walls.walls[w].encloses_fluid()) {
      pmp::reverse_face_orientations(wall);
      simple = pmp::corefine_and_compute_intersection(region, wall, cut);
    } else {
      simple = pmp::corefine_and_compute_difference(region, wall, cut);
    }
    if (!simple)
      throw std::invalid_argument("the liquid around '" + walls.walls[w].spec().name +
                                  "' would meet itself in an edge or a corner: move the body or the liquid a little");
    region = std::move(cut);
  }
  region.collect_garbage();
  return region;
}

// The liquid's boundary as a triangle mesh and what each facet of it lies on.
struct Skin {
  Rounded mesh;
  std::vector<std::pair<int, int>> on;  // of facets: wall and its patch, -1 and -1: free surface
};

// Edges of hull and liquid that cross all but in a corner leave edges of roundoff's length.
void collapse_specks(Rounded& mesh, double length) {
  for (bool again = true; again;) {
    again = false;
    for (auto e : mesh.edges()) {
      const auto half = mesh.halfedge(e);
      const Vec<3> between = vec(mesh.point(mesh.source(half))) - vec(mesh.point(mesh.target(half)));
      if (between.norm() >= length || !CGAL::Euler::does_satisfy_link_condition(e, mesh)) continue;
      CGAL::Euler::collapse_edge(e, mesh);
      again = true;
      break;
    }
  }
  mesh.collect_garbage();
}

Skin skin_of(const Exact& region, const WallsAt<3>& walls) {
  Skin skin;
  std::map<Exact::Vertex_index, Rounded::Vertex_index> at;
  for (auto v : region.vertices()) {
    const auto& p = region.point(v);
    at[v] = skin.mesh.add_vertex({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
  }
  Eigen::AlignedBox3d box;
  for (auto f : region.faces()) {
    std::array<Rounded::Vertex_index, 3> corner;
    int k = 0;
    for (auto v : region.vertices_around_face(region.halfedge(f)))
      box.extend(vec(skin.mesh.point(corner[k++] = at[v])));
    skin.mesh.add_face(corner[0], corner[1], corner[2]);
  }
  collapse_specks(skin.mesh, speck * box.diagonal().norm());
  for (auto f : skin.mesh.faces()) {
    Vec<3> centre = Vec<3>::Zero();
    for (auto v : skin.mesh.vertices_around_face(skin.mesh.halfedge(f))) centre += vec(skin.mesh.point(v)) / 3;
    const WallTie tie = tie_at<3>(centre, walls);
    skin.on.emplace_back(tie.wall, tie.patch);
  }
  return skin;
}

struct Curves {
  std::vector<std::vector<Kernel::Point_3>> lines;
  std::vector<Kernel::Point_3> corners;  // on no line
};

// Delaunay refinement grows a surface from what it knows of it: of one without curves and corners, a smooth body under
// water, it would know nothing, and leave it out. Vertices far from each other stand for it as corners.
void seed_smooth_parts(Rounded mesh, Curves& curves) {
  constexpr std::size_t seeds =
      12;  // four span a tetrahedron; as many as an icosahedron has are spread about evenly on a ball
  auto part = mesh.add_property_map<Rounded::Face_index, std::size_t>("f:part").first;
  const std::size_t count = pmp::connected_components(mesh, part);
  std::vector<std::vector<Kernel::Point_3>> vertices(count);
  std::set<Kernel::Point_3> known(curves.corners.begin(), curves.corners.end());
  for (const auto& line : curves.lines) known.insert(line.begin(), line.end());
  std::vector<char> is_known(count, 0);
  for (auto v : mesh.vertices()) {
    const std::size_t of = part[mesh.face(mesh.halfedge(v))];
    vertices[of].push_back(mesh.point(v));
    if (known.contains(mesh.point(v))) is_known[of] = 1;
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (is_known[k]) continue;
    const auto& points = vertices[k];
    std::vector<double> apart(points.size(), std::numeric_limits<double>::max());  // squared, from the seeds
    std::size_t farthest = 0;
    for (std::size_t seed = 0; seed < seeds && apart[farthest] > 0; ++seed) {
      curves.corners.push_back(points[farthest]);
      for (std::size_t i = 0; i < points.size(); ++i)
        apart[i] = std::min(apart[i], CGAL::squared_distance(points[i], curves.corners.back()));
      farthest = static_cast<std::size_t>(std::max_element(apart.begin(), apart.end()) - apart.begin());
    }
  }
}

struct LineCollector {
  const boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, Kernel::Point_3>& graph;
  std::vector<std::vector<Kernel::Point_3>>& lines;
  void start_new_polyline() { lines.emplace_back(); }
  void add_node(std::size_t v) { lines.back().push_back(graph[v]); }
  void end_polyline() {}
};

// Where walls, smooth patches of them and the free surface meet each other; sharp vertices of walls.
Curves curves_of(const Skin& skin, const WallsAt<3>& walls) {
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, Kernel::Point_3>;
  const auto& mesh = skin.mesh;
  Graph graph;
  std::map<Rounded::Vertex_index, std::size_t> at;
  auto node = [&](Rounded::Vertex_index v) {
    const auto [known, fresh] = at.try_emplace(v, 0);
    if (fresh) known->second = boost::add_vertex(mesh.point(v), graph);
    return known->second;
  };
  auto normal = [&](Rounded::Face_index f) {
    std::array<Vec<3>, 3> corner;
    int k = 0;
    for (auto v : mesh.vertices_around_face(mesh.halfedge(f))) corner[k++] = vec(mesh.point(v));
    return Vec<3>(area_vector(corner).normalized());
  };
  for (auto e : mesh.edges()) {
    const auto half = mesh.halfedge(e);
    const auto f = mesh.face(half), g = mesh.face(mesh.opposite(half));
    const bool free = skin.on[f].first < 0 && skin.on[g].first < 0;
    if (skin.on[f] != skin.on[g] || (free && normal(f).dot(normal(g)) < least_smooth_cosine))
      boost::add_edge(node(mesh.source(half)), node(mesh.target(half)), graph);
  }
  auto is_end = [&](std::size_t v, const Graph& g) {
    if (boost::degree(v, g) != 2) return true;
    const auto [first, last] = boost::adjacent_vertices(v, g);
    const Vec<3> x = vec(g[v]), a = vec(g[*first]), b = vec(g[*std::next(first)]);
    return (x - a).normalized().dot((b - x).normalized()) < least_smooth_cosine;
  };
  Curves curves;
  LineCollector collector{graph, curves.lines};
  CGAL::split_graph_into_polylines(graph, collector, is_end);
  for (auto v : mesh.vertices())
    if (!at.contains(v) && tie_at<3>(vec(mesh.point(v)), walls).vertex >= 0) curves.corners.push_back(mesh.point(v));
  seed_smooth_parts(mesh, curves);
  return curves;
}

// h times a factor, for Mesh_3.
struct Sizing {
  using FT = Kernel::FT;
  using Point_3 = Kernel::Point_3;
  using Index = Domain::Index;
  const SizeField<3>* field;
  double factor;
  FT operator()(const Point_3& p, int, const Index&) const { return factor * (*field)(vec(p)); }
};

SizeField<3> size_field(const FluidSpec<3>& spec, const Skin& skin, const WallsAt<3>& walls) {
  std::vector<Vec<3>> x;
  for (auto v : skin.mesh.vertices()) x.push_back(vec(skin.mesh.point(v)));
  Mesh<3> mesh;
  for (auto f : skin.mesh.faces()) {
    Facet<3> facet;
    int k = 0;
    for (auto v : skin.mesh.vertices_around_face(skin.mesh.halfedge(f))) facet.nodes[k++] = static_cast<int>(v);
    facet.wall = skin.on[f].first;
    mesh.boundary.push_back(facet);
  }
  return SizeField<3>(spec.size, walls, std::vector<double>(walls.walls.size(), 0.0), x, mesh);
}

// Mesh_3 bounds circumradii from above; these factors make the mean edge about h.
Complex meshed(const Domain& domain, const SizeField<3>& field) {
  namespace params = CGAL::parameters;
  const Sizing edges{&field, 1.0}, facets{&field, 0.75}, cells{&field, 0.8}, sag{&field, 0.1};
  const Criteria criteria(params::edge_size = edges, params::facet_angle = 25, params::facet_size = facets,
                          params::facet_distance = sag, params::cell_radius_edge_ratio = 2, params::cell_size = cells);
  return CGAL::make_mesh_3<Complex>(domain, criteria, params::no_perturb(), params::no_exude());
}

void append(const Complex& complex, const WallsAt<3>& walls, InitialLiquid<3>& out) {
  const auto& triangulation = complex.triangulation();
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
  for (auto c = complex.cells_in_complex_begin(); c != complex.cells_in_complex_end(); ++c)
    for (int k = 0; k < 4; ++k) {
      node(c->vertex(k));
      const auto other = c->neighbor(k);
      if (complex.is_in_complex(other)) continue;
      Facet<3> f;
      for (int j = 0; j < 3; ++j) f.nodes[j] = node(c->vertex(opposite<3>[k][j]));
      out.mesh.boundary.push_back(f);
    }
}

}  // namespace

template <>
void outline(const LiquidSpec<3>& liquid, const FluidSpec<3>& spec, const WallsAt<3>& walls, InitialLiquid<3>& out) {
  const Exact region = clipped(liquid, walls);
  if (region.number_of_faces() == 0) return;
  const Skin skin = skin_of(region, walls);
  const auto field = size_field(spec, skin, walls);
  CGAL::Random random(0);
  Domain domain(skin.mesh, &random);
  const Curves curves = curves_of(skin, walls);
  domain.add_features(curves.lines.begin(), curves.lines.end());
  for (const auto& corner : curves.corners) domain.add_corner(corner);
  append(meshed(domain, field), walls, out);
}

}  // namespace splashdown::fluid
