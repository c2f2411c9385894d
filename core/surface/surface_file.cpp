#include "core/surface/surface_file.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Projection_traits_3.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "core/surface/soup.hpp"

namespace splashdown {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = Soup::Kernel;
using Polyhedron = CGAL::Surface_mesh<Kernel::Point_3>;

const std::string flip =
    "Flip it in the tool that made it, e.g. Blender: Mesh > Normals > Recalculate Outside, and export "
    "it again.";
const std::string clean =
    "Remove it, e.g. MeshLab: Filters > Cleaning > Merge Close Vertices and Remove Zero Area Faces, and "
    "export it again.";
const std::string triangulate =
    "Cut its facets into triangles, e.g. Blender: Face > Triangulate Faces, and export it again.";
const std::string bridge =
    "Join the rims of both skins, e.g. Blender: Edge > Bridge Edge Loops; for a hull that is closed above, delete the "
    "inner skin and close the outer one.";
const std::string unite = "Join the parts, e.g. Blender: Boolean > Union, or mend the place, and export it again.";

/// A polygon that comes back to a corner encloses nothing that facets could be made of.
void refuse_repeated_corners(const Soup& soup) {
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    auto corners = soup.polygons[f];
    std::sort(corners.begin(), corners.end());
    const auto twice = std::adjacent_find(corners.begin(), corners.end());
    if (twice != corners.end() && corners.size() > 3)  // such triangles have no area
      throw SurfaceFileError(
          fmt::format("has a facet that meets its corner {} twice: number {}", text(soup.at(*twice)), f + 1), clean);
  }
}

void refuse_without_area(const Soup& soup) {
  const double flat = 1e-9 * soup.extent();  // height over the longest edge
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    const auto& polygon = soup.polygons[f];
    Vec<3> area = Vec<3>::Zero();
    double longest = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec<3> a = soup.at(polygon[k]) - soup.at(polygon[0]),
                   b = soup.at(polygon[(k + 1) % polygon.size()]) - soup.at(polygon[0]);
      area += 0.5 * a.cross(b);
      longest = std::max(longest, (b - a).norm());
    }
    if (2 * area.norm() <= flat * longest)
      throw SurfaceFileError(fmt::format("has a facet without area: number {} at {}", f + 1, text(soup.centre(f))),
                             clean);
  }
}

/// What the orientation of a soup runs into.
struct Findings {
  std::vector<std::size_t> turned;
  std::optional<std::array<std::size_t, 3>> crowded_edge;  // ends and facets of an edge with more than two
  std::optional<std::size_t> crowded_point;                // where surfaces touch in a point
};

struct Listener : pmp::Default_orientation_visitor {
  explicit Listener(Findings& to) : findings(&to) {}
  void polygon_orientation_reversed(std::size_t polygon) { findings->turned.push_back(polygon); }
  void non_manifold_edge(std::size_t a, std::size_t b, std::size_t facets) {
    if (!findings->crowded_edge) findings->crowded_edge = {a, b, facets};
  }
  void non_manifold_vertex(std::size_t point, std::size_t) {
    if (!findings->crowded_point) findings->crowded_point = point;
  }
  Findings* findings;  // CGAL copies its visitors
};

/// Some edge belongs to one polygon only.
bool has_open_edge(const Soup& soup) {
  std::map<std::pair<std::size_t, std::size_t>, int> uses;
  for (const auto& polygon : soup.polygons)
    for (std::size_t k = 0; k < polygon.size(); ++k) ++uses[std::minmax(polygon[k], polygon[(k + 1) % polygon.size()])];
  return std::any_of(uses.begin(), uses.end(), [](const auto& use) { return use.second == 1; });
}

/// Facets agree about the outside from here on. What disagreed before, told once it is known that it is to stay; empty: nothing.
std::string oriented(Soup& soup) {
  Findings findings;
  const Soup given = soup;
  pmp::orient_polygon_soup(soup.points, soup.polygons, CGAL::parameters::visitor(Listener(findings)));
  if (findings.crowded_edge) {
    const auto& [a, b, facets] = *findings.crowded_edge;
    throw SurfaceFileError(
        fmt::format("is not the surface of a solid: {} facets meet at the edge from {} to {}; two must", facets,
                    text(given.at(a)), text(given.at(b))),
        unite);
  }
  // Holes that touch in a point meet there like parts: they are told as what they are.
  if (findings.crowded_point && !has_open_edge(given))
    throw SurfaceFileError(fmt::format("is not the surface of a solid: parts of it touch in the point {}",
                                       text(given.at(*findings.crowded_point))),
                           unite);
  if (findings.turned.empty()) return {};
  const std::size_t turned = std::min(findings.turned.size(), given.polygons.size() - findings.turned.size());
  const auto first = findings.turned.front();
  return fmt::format("has facets turned against their neighbours, {} of {}, at {} (facet {})", turned,
                     given.polygons.size(), text(given.centre(first)), first + 1);
}

/// CGAL's triangulation of a facet believes that its outline, seen along the normal, does not cross itself. Its test of that takes
/// corners for apart that lie one behind the other.
bool is_simple(std::vector<Kernel::Point_3> corners, const CGAL::Projection_traits_3<Kernel>& plane) {
  if (!CGAL::is_simple_2(corners.begin(), corners.end(), plane)) return false;
  const auto less = plane.less_xy_2_object();
  std::sort(corners.begin(), corners.end(), less);
  const auto behind = [&](const auto& a, const auto& b) { return !less(a, b); };
  return std::adjacent_find(corners.begin(), corners.end(), behind) == corners.end();
}

void refuse_crossed_outlines(const Polyhedron& mesh) {
  for (const auto face : mesh.faces()) {
    std::vector<Kernel::Point_3> corners;
    for (const auto corner : CGAL::vertices_around_face(mesh.halfedge(face), mesh))
      corners.push_back(mesh.point(corner));
    if (corners.size() <= 4) continue;  // a diagonal cuts them
    if (is_simple(corners, CGAL::Projection_traits_3<Kernel>(pmp::compute_face_normal(face, mesh)))) continue;
    const auto& p = corners.front();
    throw SurfaceFileError(fmt::format("has a facet of {} corners whose outline crosses itself, at {}", corners.size(),
                                       text({p.x(), p.y(), p.z()})),
                           triangulate);
  }
}

std::vector<Polyhedron> shells_of(const Polyhedron& mesh) {
  std::vector<Polyhedron> parts;
  pmp::split_connected_components(mesh, parts);
  return parts;
}

/// An open part inside the box of another one: an open boat without its rim.
bool has_open_skins(const Polyhedron& mesh) {
  std::vector<CGAL::Bbox_3> open;
  for (const auto& part : shells_of(mesh))
    if (!CGAL::is_closed(part)) open.push_back(pmp::bbox(part));
  const auto within = [](const CGAL::Bbox_3& inner, const CGAL::Bbox_3& outer) {
    return CGAL::do_overlap(inner, outer) && inner + outer == outer && inner != outer;
  };
  return std::ranges::any_of(
      open, [&](const auto& a) { return std::ranges::any_of(open, [&](const auto& b) { return within(a, b); }); });
}

void refuse_holes(const Polyhedron& mesh) {
  if (CGAL::is_closed(mesh)) return;
  std::vector<Polyhedron::Halfedge_index> holes;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(holes));
  struct Hole {
    int edges = 0;
    Vec<3> centre = Vec<3>::Zero();
  };
  std::vector<Hole> found;
  for (const auto start : holes) {
    Hole hole;
    for (const auto edge : CGAL::halfedges_around_face(start, mesh)) {
      const auto& p = mesh.point(mesh.target(edge));
      hole.centre += Vec<3>(p.x(), p.y(), p.z());
      ++hole.edges;
    }
    hole.centre /= hole.edges;
    found.push_back(hole);
  }
  std::sort(found.begin(), found.end(), [](const Hole& a, const Hole& b) { return a.edges > b.edges; });
  std::string where;
  const std::size_t most = 3;
  for (std::size_t i = 0; i < std::min(most, found.size()); ++i)
    where += fmt::format(", around {} with {} edges", text(found[i].centre), found[i].edges);
  const char* holes_are = found.size() == 1 ? "hole" : "holes";
  const bool skins = has_open_skins(mesh);
  throw SurfaceFileError(fmt::format("is not closed: {} {}{}{}", found.size(), holes_are, where,
                                     skins ? "; of two skins, one inside the other" : ""),
                         skins ? bridge : cure_of_open_surface);
}

void refuse_crossings(const Polyhedron& mesh) {
  std::vector<std::pair<Polyhedron::Face_index, Polyhedron::Face_index>> crossings;
  pmp::self_intersections<CGAL::Sequential_tag>(mesh, std::back_inserter(crossings));
  if (crossings.empty()) return;
  Vec<3> where = Vec<3>::Zero();
  for (const auto corner : CGAL::vertices_around_face(mesh.halfedge(crossings.front().first), mesh))
    where += Vec<3>(mesh.point(corner).x(), mesh.point(corner).y(), mesh.point(corner).z()) / 3;
  throw SurfaceFileError(
      fmt::format("crosses itself: {} pairs of facets, the first at {}", crossings.size(), text(where)), unite);
}

Vec<3> place(const Polyhedron& part) {
  const auto& p = part.point(*part.vertices().begin());
  return {p.x(), p.y(), p.z()};
}

/// Parts inside other ones are to go, whichever way they are turned; what is wrong with the others is told with them.
void refuse_inner_parts(const std::vector<Polyhedron>& parts, bool turned) {
  if (parts.size() == 1) return;
  std::vector<char> inner(parts.size(), 0);
  for (const auto& outer : parts) {
    const CGAL::Side_of_triangle_mesh<Polyhedron, Kernel> side(outer);
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (&parts[i] != &outer && side(parts[i].point(*parts[i].vertices().begin())) == CGAL::ON_BOUNDED_SIDE)
        inner[i] = 1;
  }
  const auto count = std::ranges::count(inner, 1);
  if (count == 0) return;
  for (std::size_t i = 0; i < parts.size(); ++i) turned = turned || (!inner[i] && pmp::volume(parts[i]) <= 0);
  const auto first = static_cast<std::size_t>(std::ranges::find(inner, 1) - inner.begin());
  const std::string which = count == 1 ? "a part inside another one, an inner skin or a void"
                                       : fmt::format("{} parts inside other ones, inner skins or voids", count);
  throw SurfaceFileError(
      fmt::format("has {}, at {}{}", which, text(place(parts[first])), turned ? "; what is outside is inside out" : ""),
      fmt::format("Delete {} alone: no water gets there; what it means for the mass goes into mass and inertia.{}",
                  count == 1 ? "it" : "them", turned ? " " + flip : ""));
}

void refuse_inside_out(const std::vector<Polyhedron>& parts) {
  std::string where;
  int count = 0;
  for (const auto& part : parts)
    if (pmp::volume(part) <= 0 && ++count == 1) where = text(place(part));
  if (count == 0) return;
  const bool all = count == static_cast<int>(parts.size());
  throw SurfaceFileError(all          ? "is inside out: all its normals point inward"
                         : count == 1 ? fmt::format("has a part that is inside out, at {}", where)
                                      : fmt::format("has {} parts that are inside out, the first at {}", count, where),
                         flip);
}

}  // namespace

SurfaceFile read_surface_file(const std::filesystem::path& path) {
  Soup soup = read_soup(path);
  merge_points(soup);
  refuse_repeated_corners(soup);
  refuse_without_area(soup);
  const std::string disagreement = oriented(soup);
  Polyhedron mesh;
  pmp::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, mesh);
  if (!disagreement.empty() && !CGAL::is_closed(mesh)) throw SurfaceFileError(disagreement, flip);
  refuse_crossed_outlines(mesh);
  if (!CGAL::is_triangle_mesh(mesh)) pmp::triangulate_faces(mesh);
  refuse_holes(mesh);
  const bool crosses = pmp::does_self_intersect<CGAL::Sequential_tag>(mesh);
  const auto parts = shells_of(mesh);
  if (!crosses) refuse_inner_parts(parts, !disagreement.empty());
  if (!disagreement.empty()) throw SurfaceFileError(disagreement, flip);
  if (crosses) refuse_crossings(mesh);
  refuse_inside_out(parts);
  SurfaceFile file;
  file.parts = static_cast<int>(parts.size());
  file.surface.vertices.resize(3, static_cast<Eigen::Index>(mesh.number_of_vertices()));
  file.surface.facets.resize(3, static_cast<Eigen::Index>(mesh.number_of_faces()));
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    file.surface.vertices.col(static_cast<Eigen::Index>(v.idx())) << p.x(), p.y(), p.z();
  }
  Eigen::Index f = 0;
  for (const auto face : mesh.faces()) {
    int k = 0;
    for (const auto corner : CGAL::vertices_around_face(mesh.halfedge(face), mesh))
      file.surface.facets(k++, f) = static_cast<int>(corner.idx());
    ++f;
  }
  return file;
}

}  // namespace splashdown
