#include "core/surface/repair.hpp"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/intersection.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/merge_border_vertices.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>

#include "core/surface/soup.hpp"
#include "core/surface/surface_file.hpp"
#include "core/surface/wrap.hpp"

namespace splashdown {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = Soup::Kernel;
using Done = std::vector<std::string>;

std::string counted(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

Vec<3> corner(const Shell& shell, Shell::Vertex_index vertex) {
  const auto& p = shell.point(vertex);
  return {p.x(), p.y(), p.z()};
}

/// Points and facets that are there twice, and facets that came to nothing, go.
void cleaned_up(Soup& soup, Done& done) {
  const auto given = soup.polygons.size();
  merge_points(soup);
  pmp::repair_polygon_soup(soup.points, soup.polygons);
  const auto gone = given - std::min(given, soup.polygons.size());
  if (gone > 0) done.push_back(fmt::format("removed {} without area or there twice", counted(gone, "facet", "facets")));
}

struct CountTurned : pmp::Default_orientation_visitor {
  explicit CountTurned(std::size_t& to) : count(&to) {}
  void polygon_orientation_reversed(std::size_t) { ++*count; }
  std::size_t* count;  // CGAL copies its visitors
};

Shell oriented_shell(Soup& soup, Done& done) {
  std::size_t turned = 0;
  const auto points = soup.points.size();
  pmp::orient_polygon_soup(soup.points, soup.polygons, CGAL::parameters::visitor(CountTurned(turned)));
  if (turned > 0)
    done.push_back(fmt::format("turned {} that disagreed with their neighbours",
                               counted(std::min(turned, soup.polygons.size() - turned), "facet", "facets")));
  if (soup.points.size() > points)
    done.push_back("parted facets where more than two meet at an edge or surfaces touch in a point");
  Shell shell;
  pmp::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, shell);
  if (!CGAL::is_triangle_mesh(shell)) pmp::triangulate_faces(shell);
  pmp::remove_degenerate_faces(shell);
  return shell;
}

/// Pieces of so few facets that they are crumbs of the export: open, and not the largest.
void remove_crumbs(Shell& shell, Done& done) {
  std::vector<Shell> parts;
  pmp::split_connected_components(shell, parts);
  if (parts.size() < 2) return;
  std::size_t most = 0, crumbs = 0;
  for (const auto& part : parts) most = std::max<std::size_t>(most, part.number_of_faces());
  Shell kept;
  for (const auto& part : parts) {
    const bool crumb = !CGAL::is_closed(part) && part.number_of_faces() < 4 && part.number_of_faces() < most;
    if (crumb) ++crumbs;
    if (!crumb) CGAL::copy_face_graph(part, kept);
  }
  if (crumbs == 0) return;
  done.push_back(fmt::format("removed {} of fewer than 4 facets", counted(crumbs, "loose piece", "loose pieces")));
  shell = std::move(kept);
}

/// False: a hole is left that no lid fits.
bool close_holes(Shell& shell, Done& done) {
  pmp::merge_duplicated_vertices_in_boundary_cycles(shell);  // holes that touch in a point are two
  const auto stitched = pmp::stitch_borders(shell);
  if (stitched > 0)
    done.push_back(fmt::format("stitched {} of borders", counted(stitched, "pair of edges", "pairs of edges")));
  std::vector<Shell::Halfedge_index> holes;
  pmp::extract_boundary_cycles(shell, std::back_inserter(holes));
  for (const auto start : holes) {
    Eigen::AlignedBox3d box;
    int edges = 0;
    for (const auto edge : CGAL::halfedges_around_face(start, shell))
      box.extend(corner(shell, shell.target(edge))), ++edges;
    std::vector<Shell::Face_index> lid;
    pmp::triangulate_hole(shell, start, std::back_inserter(lid));
    if (lid.empty()) return false;
    done.push_back(fmt::format("put a lid on a hole, around {}, {:.3g} wide, {} edges", text(box.center()),
                               box.diagonal().norm(), edges));
  }
  return true;
}

/// All normals outward, part by part; parts that bound nothing are refused.
std::vector<Shell> outward_parts(const Shell& shell, Done& done) {
  std::vector<Shell> parts;
  pmp::split_connected_components(shell, parts);
  const auto box = CGAL::bbox_3(shell.points().begin(), shell.points().end());
  const double size = std::max({box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()}),
               thin = 1e-9;
  std::size_t turned = 0;
  for (auto& part : parts) {
    const double volume = pmp::volume(part);
    if (std::abs(volume) <= thin * size * size * size && parts.size() == 1)
      throw SurfaceFileError("encloses no volume: it has no thickness", "Give it a thickness, e.g. Blender: Solidify.");
    if (volume >= 0) continue;
    pmp::reverse_face_orientations(part);
    ++turned;
  }
  if (turned > 0)
    done.push_back(parts.size() == 1
                       ? "turned its normals outward: it was inside out"
                       : fmt::format("turned the normals of {} outward", counted(turned, "part", "parts")));
  return parts;
}

bool lies_in(const Shell& inner, const Shell& outer) {
  const CGAL::Side_of_triangle_mesh<Shell, Kernel> side(outer);
  return std::ranges::all_of(inner.vertices(), [&](auto v) { return side(inner.point(v)) == CGAL::ON_BOUNDED_SIDE; });
}

/// Inner skins and voids: no water gets there.
void remove_inner_parts(std::vector<Shell>& parts, Done& done) {
  std::vector<char> inner(parts.size(), 0);
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t k = 0; k < parts.size() && !inner[i]; ++k)
      if (i != k && !inner[k] && pmp::volume(parts[k]) > pmp::volume(parts[i])) inner[i] = lies_in(parts[i], parts[k]);
  std::vector<Shell> kept;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (!inner[i]) kept.push_back(std::move(parts[i]));
  if (kept.size() < parts.size())
    done.push_back(
        fmt::format("removed {}, an inner skin or a void",
                    counted(parts.size() - kept.size(), "part inside another one", "parts inside other ones")));
  parts = std::move(kept);
}

/// The first two that cross; nothing: none do.
std::optional<std::pair<std::size_t, std::size_t>> crossing(const std::vector<Shell>& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t k = i + 1; k < parts.size(); ++k)
      if (pmp::do_intersect(parts[i], parts[k])) return std::pair(i, k);
  return {};
}

/// Parts that cross become one; nothing: one of them crosses itself, or the union bounds no solid.
std::optional<Shell> united(std::vector<Shell> parts, Done& done) {
  std::size_t joined = 0;
  if (std::ranges::any_of(parts, [](const Shell& part) { return pmp::does_self_intersect(part); })) return {};
  while (const auto pair = crossing(parts)) {
    auto& [a, b] = *pair;
    Shell sum;
    if (!pmp::corefine_and_compute_union(parts[a], parts[b], sum)) return {};
    parts[a] = std::move(sum);
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(b));
    ++joined;
  }
  if (joined > 0)
    done.push_back(fmt::format("united {} parts that crossed to {}", joined + parts.size(), parts.size()));
  Shell whole;
  for (const auto& part : parts) CGAL::copy_face_graph(part, whole);
  return whole;
}

/// Facet by facet; nothing: what is left crosses itself.
std::optional<Surface<3>> mended(Soup soup, Done& done) {
  auto shell = oriented_shell(soup, done);
  remove_crumbs(shell, done);
  if (!close_holes(shell, done)) return {};
  auto parts = outward_parts(shell, done);
  remove_inner_parts(parts, done);
  const auto whole = united(std::move(parts), done);
  if (!whole) return {};
  Soup last = soup_of(*whole);
  Done of_cuts;  // slivers along the cuts of a union: no news
  cleaned_up(last, of_cuts);
  return surface_of(last);
}

}  // namespace

RepairedSurface repaired_surface(const std::filesystem::path& path) {
  RepairedSurface result;
  Soup soup = read_soup(path);
  cleaned_up(soup, result.done);
  if (soup.polygons.empty())
    throw SurfaceFileError("has no facet with an area",
                           "Give it a thickness, e.g. Blender: Solidify, and export it again.");
  if (auto surface = mended(soup, result.done)) {
    result.surface = std::move(*surface);
    return result;
  }
  auto wrap = wrapped(soup);
  result.done = {fmt::format(
      "wrapped it in a closed skin, {:.2g} outside of it, in units of the file: it crosses itself, and no facets "
      "of its own bound a solid. Openings and hollows narrower than {:.2g} are closed",
      wrap.gap, wrap.opening)};
  result.surface = std::move(wrap.surface);
  return result;
}

void write_stl(const std::filesystem::path& path, const Surface<3>& surface) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "w"), std::fclose);
  if (!file) throw std::runtime_error(path.string() + ": cannot be written. Is the folder there, with space in it?");
  fmt::print(file.get(), "solid hull\n");
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
    fmt::print(file.get(), "facet normal 0 0 0\nouter loop\n");
    for (int k = 0; k < 3; ++k) {
      const Vec<3> x = surface.vertices.col(surface.facets(k, f));
      fmt::print(file.get(), "vertex {} {} {}\n", x.x(), x.y(), x.z());
    }
    fmt::print(file.get(), "endloop\nendfacet\n");
  }
  fmt::print(file.get(), "endsolid hull\n");
  if (std::fflush(file.get()) != 0 || std::ferror(file.get()))
    throw std::runtime_error(path.string() + ": cannot be written to the end. Is the disk full?");
}

}  // namespace splashdown
