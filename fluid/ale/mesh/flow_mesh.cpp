#include "fluid/ale/mesh/flow_mesh.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "core/surface/sized_triangles.hpp"
#include "fluid/ale/mesh/wanted_size.hpp"

namespace splashdown::ale {
namespace {

/// Where a vertex lies: arc length on a hole's outline.
struct OnLine {
  int number = -1;  // of its node
  int line = -1;
  double arc = 0;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertices = CGAL::Triangulation_vertex_base_with_info_2<OnLine, Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<Vertices, CGAL::Delaunay_mesh_face_base_2<Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;

Kernel::Point_2 point_of(const Vec<2>& x) { return {x.x(), x.y()}; }

/// Chords of the outlines and the box's sides.
void insert_lines(const MeshSpec& spec, const std::vector<HullLine>& lines, Triangulation& triangles) {
  const Vec<2> a = spec.min, b = spec.max;
  const Kernel::Point_2 box[] = {{a.x(), a.y()}, {b.x(), a.y()}, {b.x(), b.y()}, {a.x(), b.y()}};
  for (int k = 0; k < side_count; ++k) triangles.insert_constraint(box[k], box[(k + 1) % side_count]);
  for (const auto& line : lines) {
    std::vector<Triangulation::Vertex_handle> vertices;
    for (const double cut : line.cuts()) vertices.push_back(triangles.insert(point_of(line.at(cut))));
    for (std::size_t k = 0; k < vertices.size(); ++k)
      triangles.insert_constraint(vertices[k], vertices[(k + 1) % vertices.size()]);
  }
}

/// Points of which each lies in a hole.
std::vector<Kernel::Point_2> seeds_of(const Triangulation& triangles, const std::vector<HullLine>& lines) {
  std::vector<Kernel::Point_2> seeds;
  for (const auto face : triangles.finite_face_handles()) {
    Vec<2> middle = Vec<2>::Zero();
    for (int k = 0; k < 3; ++k) middle += Vec<2>(face->vertex(k)->point().x(), face->vertex(k)->point().y()) / 3;
    if (std::ranges::any_of(lines, [&](const HullLine& line) { return line.holds(middle); }))
      seeds.push_back(point_of(middle));
  }
  return seeds;
}

/// The place of a chord's point on its outline, by its share of the chord; nothing off the outlines.
OnLine place_on(const std::vector<HullLine>& lines, const Vec<2>& x, double roundoff) {
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const auto& cuts = lines[l].cuts();
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      const double from = cuts[k], to = k + 1 < cuts.size() ? cuts[k + 1] : lines[l].length() + cuts[0];
      const Vec<2> a = lines[l].at(from), along = lines[l].at(to) - a;
      const double share = (x - a).dot(along) / along.squaredNorm();
      if (share < -1e-9 || share > 1 + 1e-9 || (a + share * along - x).norm() > roundoff) continue;
      return {.line = static_cast<int>(l), .arc = from + share * (to - from)};
    }
  }
  return {};
}

int side_of(const MeshSpec& spec, const Vec<2>& x) {
  const double away[] = {x.x() - spec.min.x(), spec.max.x() - x.x(), x.y() - spec.min.y(), spec.max.y() - x.y()};
  return static_cast<int>(std::min_element(away, away + side_count) - away);
}

/// Corners of triangles, then the middles of their edges, curved on outlines.
class Collect {
 public:
  Collect(const MeshSpec& spec, const std::vector<HullLine>& lines, Triangulation& triangles)
      : spec_(spec), lines_(lines), triangles_(triangles) {}

  FlowMesh mesh() && {
    const double roundoff = 1e-9 * (spec_.max - spec_.min).norm();
    for (const auto face : triangles_.finite_face_handles())
      for (int k = 0; k < 3 && face->is_in_domain(); ++k) {
        auto& info = face->vertex(k)->info();
        if (info.number >= 0) continue;
        Vec<2> x(face->vertex(k)->point().x(), face->vertex(k)->point().y());
        info = place_on(lines_, x, roundoff);
        info.number = static_cast<int>(nodes_.size());
        if (info.line >= 0) x = lines_[static_cast<std::size_t>(info.line)].at(info.arc);
        nodes_.push_back(x);
      }
    mesh_.corners = static_cast<int>(nodes_.size());
    for (const auto face : triangles_.finite_face_handles())
      if (face->is_in_domain()) add(face);
    mesh_.nodes.resize(2, static_cast<Eigen::Index>(nodes_.size()));
    for (std::size_t a = 0; a < nodes_.size(); ++a) mesh_.nodes.col(static_cast<Eigen::Index>(a)) = nodes_[a];
    return std::move(mesh_);
  }

 private:
  void add(Triangulation::Face_handle face) {
    Cell cell{};
    for (int k = 0; k < 3; ++k) cell[static_cast<std::size_t>(k)] = face->vertex(k)->info().number;
    for (int e = 0; e < 3; ++e) {
      const auto [i, j] = cell_edges[static_cast<std::size_t>(e)];
      const auto &from = face->vertex(i)->info(), &to = face->vertex(j)->info();
      const int opposite = 3 - i - j;
      const bool ends = !face->neighbor(opposite)->is_in_domain() || triangles_.is_infinite(face->neighbor(opposite));
      const auto [at, is_new] =
          middles_.try_emplace(std::minmax(from.number, to.number), static_cast<int>(nodes_.size()));
      if (is_new)
        nodes_.push_back(0.5 *
                         (nodes_[static_cast<std::size_t>(from.number)] + nodes_[static_cast<std::size_t>(to.number)]));
      cell[static_cast<std::size_t>(3 + e)] = at->second;
      if (!ends) continue;
      BoundaryEdge edge{.nodes = {from.number, to.number, at->second}};
      auto& middle = nodes_[static_cast<std::size_t>(at->second)];
      if (from.line >= 0 && from.line == to.line) {
        const auto& line = lines_[static_cast<std::size_t>(from.line)];
        const double arc = line.middle(from.arc, to.arc);
        middle = line.at(arc);
        edge.wall = line.wall_at(arc);
        edge.line = from.line;
        edge.arcs = {from.arc, to.arc, arc};
      } else {
        edge.side = side_of(spec_, middle);
      }
      if ((j - i + 3) % 3 == 2) {  // triangles run counter-clockwise
        std::swap(edge.nodes[0], edge.nodes[1]);
        std::swap(edge.arcs[0], edge.arcs[1]);
      }
      mesh_.boundary.push_back(edge);
    }
    mesh_.cells.push_back(cell);
  }

  const MeshSpec& spec_;
  const std::vector<HullLine>& lines_;
  Triangulation& triangles_;
  FlowMesh mesh_;
  std::vector<Vec<2>> nodes_;
  std::map<std::pair<int, int>, int> middles_;
};

}  // namespace

FlowMesh flow_mesh(const MeshSpec& spec) { return flow_mesh(spec, divided_lines(spec)); }

FlowMesh flow_mesh(const MeshSpec& spec, const std::vector<HullLine>& lines) {
  Triangulation triangles;
  try {
    insert_lines(spec, lines, triangles);
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    throw std::invalid_argument(
        "ale fluid: the outline of a body crosses another one or the box, or is coarser than it is thin");
  }
  const auto seeds = seeds_of(triangles, lines);
  const WantedSize wanted(spec, lines);
  CGAL::refine_Delaunay_mesh_2(triangles, seeds.begin(), seeds.end(),
                               SizedTriangles<Triangulation>([&](const Vec<2>& x) { return wanted.at(x); }));
  return Collect(spec, lines, triangles).mesh();
}

DividedMesh divided(const FlowMesh& mesh) {
  auto parts = split<2>(mesh.nodes, mesh.cells);
  DividedMesh all;
  all.mesh.nodes = std::move(parts.nodes);
  all.mesh.corners = mesh.size();
  all.mesh.cells = std::move(parts.cells);
  all.places = std::move(parts.places);
  for (const auto& edge : mesh.boundary) {
    const auto [from, to, between] = edge.nodes;
    for (const auto& [a, b] : {std::pair(from, between), std::pair(between, to)})
      all.mesh.boundary.push_back({.nodes = {a, b, parts.middle(a, b)}, .wall = edge.wall, .side = edge.side});
  }
  return all;
}

}  // namespace splashdown::ale
