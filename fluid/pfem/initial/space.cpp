// In 3D: walls cut the regions exactly, and CGAL's Mesh_3 fills what is left to the size field. Here: the skin between them.
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/split_graph_into_polylines.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "fluid/pfem/initial/gaps.hpp"
#include "fluid/pfem/initial/space_parts.hpp"

namespace splashdown::fluid {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

constexpr double speck = 1e-10;  // over the liquid's size: shorter edges are roundoff

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

Skin skin_of(const Surface<3>& region, const WallsAt<3>& walls) {
  Skin skin;
  std::vector<Rounded::Vertex_index> at;
  Eigen::AlignedBox3d box;
  for (Eigen::Index v = 0; v < region.vertices.cols(); ++v) {
    const Vec<3> x = region.vertices.col(v);
    at.push_back(skin.mesh.add_vertex({x.x(), x.y(), x.z()}));
    box.extend(x);
  }
  for (Eigen::Index f = 0; f < region.facets.cols(); ++f)
    skin.mesh.add_face(at[region.facets(0, f)], at[region.facets(1, f)], at[region.facets(2, f)]);
  collapse_specks(skin.mesh, speck * box.diagonal().norm());
  for (auto f : skin.mesh.faces()) {
    Vec<3> centre = Vec<3>::Zero();
    for (auto v : skin.mesh.vertices_around_face(skin.mesh.halfedge(f))) centre += vec(skin.mesh.point(v)) / 3;
    const WallTie tie = tie_at<3>(centre, walls);
    skin.on.emplace_back(tie.wall, tie.patch);
  }
  return skin;
}

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

// A liquid's outline, ready to be meshed.
struct Prepared {
  Skin skin;
  Curves curves;
  SizeField<3> field;
};

// Throws GapRefused. Nothing if walls leave nothing of the liquid.
std::optional<Prepared> prepared(const LiquidSpec<3>& liquid, const FluidSpec<3>& spec, const WallsAt<3>& walls) {
  const Surface<3> region = clipped(liquid, walls);
  if (region.facets.cols() == 0) return {};
  Skin skin = skin_of(region, walls);
  Curves curves = curves_of(skin, walls);
  SizeField<3> field = size_field(spec, skin, walls);
  std::vector<std::array<Vec<3>, 2>> edges;
  for (const auto& line : curves.lines)
    for (std::size_t i = 1; i < line.size(); ++i) edges.push_back({vec(line[i - 1]), vec(line[i])});
  refuse_narrow_gaps(edges, field, walls);
  return Prepared{std::move(skin), std::move(curves), std::move(field)};
}

}  // namespace

template <>
OutlineSketch sketch(const LiquidSpec<3>& liquid, const FluidSpec<3>& spec, const WallsAt<3>& walls) {
  const auto start = prepared(liquid, spec, walls);
  if (!start) return {};
  std::vector<SkinFacet> facets;
  const auto& mesh = start->skin.mesh;
  for (auto f : mesh.faces()) {
    SkinFacet facet{{}, start->skin.on[f].first};
    int k = 0;
    for (auto v : mesh.vertices_around_face(mesh.halfedge(f))) facet.corners[k++] = vec(mesh.point(v));
    facets.push_back(facet);
  }
  return {false, narrowest_gap(facets, spec.size, start->field, walls)};
}

template <>
void outline(const LiquidSpec<3>& liquid, const FluidSpec<3>& spec, const WallsAt<3>& walls, InitialLiquid<3>& out) {
  if (const auto start = prepared(liquid, spec, walls))
    fill_within(start->skin.mesh, start->curves, start->field, walls, spec.while_meshing, out);
}

}  // namespace splashdown::fluid
