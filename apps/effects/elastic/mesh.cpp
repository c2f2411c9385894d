// Meshes of elastic bodies, and which of their cells and points regions cover.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <mutex>
#include <numbers>

#include "apps/effects/elastic/solid.hpp"
#include "apps/scene/geometry.hpp"
#include "core/geometry.hpp"
#include "elastic/mesh/gmsh_file.hpp"
#include "elastic/mesh/outline_mesh.hpp"
#include "elastic/mesh/volume_mesh.hpp"

namespace splashdown::apps {
namespace {

/// Even-odd, in the plane.
bool is_within(const std::vector<Point>& polygon, const Point& x) {
  bool inside = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if ((a.y() > x.y()) != (b.y() > x.y()) && x.x() < a.x() + (x.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

/// Corners of a region of the plane; a disc has as many as make chords of about `size`.
std::vector<Vec<2>> corners_of(const ElasticRegion& region, double size) {
  std::vector<Vec<2>> all;
  for (const auto& point : region.points) all.push_back(vec<2>(point));
  if (region.min) {
    const Vec<2> low = vec<2>(*region.min), high = vec<2>(*region.max);
    all = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  }
  if (region.centre) {
    const double around = 2 * std::numbers::pi * *region.radius / size;
    const int n = static_cast<int>(std::clamp(std::ceil(around), 16., 256.));
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * k / n;
      all.push_back(vec<2>(*region.centre) + *region.radius * Vec<2>(std::cos(angle), std::sin(angle)));
    }
  }
  return all;
}

}  // namespace

template <int d>
double meshed_volume(const Body& body, const ElasticTable& table, const elastic::SolidMesh<d>& mesh) {
  if (d == 3 && table.mesh_file.empty()) {
    double sum = 0;
    for (const auto& cell : mesh.cells) {
      Mat<d> sides;
      for (int i = 0; i < d; ++i) sides.col(i) = mesh.nodes.col(cell[i + 1]) - mesh.nodes.col(cell[0]);
      sum += sides.determinant() / factorial<d>;
    }
    return sum;
  }
  return rigid::mass_properties<d>(shape_of<d>(body.shape).surface).mass;
}

MeshInSpace mesh_in_space(const Body& body, const ElasticTable& table) {
  struct Made {
    Surface<3> surface;
    double size;
    MeshInSpace result;
  };
  static std::mutex mutex;
  static std::deque<Made> made;  // checks, notes, walls and the run itself ask for the same
  constexpr std::size_t most = 4;
  const std::lock_guard lock(mutex);
  const auto surface = shape_of<3>(body.shape).surface;
  for (const auto& one : made)
    if (one.size == table.size && one.surface.vertices.cols() == surface.vertices.cols() &&
        one.surface.facets.cols() == surface.facets.cols() && one.surface.vertices == surface.vertices &&
        one.surface.facets == surface.facets)
      return one.result;
  const auto begin = std::chrono::steady_clock::now();
  auto mesh = elastic::volume_mesh(surface, table.size);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (made.size() == most) made.pop_front();
  return made.emplace_back(Made{surface, table.size, {std::move(mesh), seconds}}).result;
}

bool covers(const ElasticRegion& clamp, const Point& point, double roundoff) {
  if (!clamp.points.empty()) return is_within(clamp.points, point);
  if (clamp.centre) return (point - *clamp.centre).norm() <= *clamp.radius + roundoff;
  return ((point - *clamp.min).array() >= -roundoff).all() && ((*clamp.max - point).array() >= -roundoff).all();
}

template <int d>
std::vector<int> parts_of(const ElasticTable& table, const elastic::SolidMesh<d>& mesh) {
  std::vector<int> all(mesh.cells.size(), 0);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    Vec<d> middle = Vec<d>::Zero();
    for (int k = 0; k <= d; ++k) middle += mesh.nodes.col(mesh.cells[c][static_cast<std::size_t>(k)]) / (d + 1);
    for (std::size_t p = 0; p < table.parts.size(); ++p)
      if (covers(table.parts[p].region, in_space<d>(middle), 0)) all[c] = static_cast<int>(p) + 1;
  }
  return all;
}

elastic::InnerLines lines_of(const ElasticTable& table) {
  elastic::InnerLines lines;
  for (const auto& part : table.parts) {
    const auto corners = corners_of(part.region, table.size);
    for (std::size_t k = 0; k < corners.size(); ++k) lines.push_back({corners[k], corners[(k + 1) % corners.size()]});
  }
  return lines;
}

template <int d>
std::optional<elastic::Place<d>> place_in(const elastic::SolidMesh<d>& mesh, const Point& point) {
  constexpr double near = 1e-3;  // of the extent: chords of curved outlines
  return elastic::locate<d>(mesh, vec<d>(point), near * elastic::extent(mesh));
}

template <int d>
elastic::SolidMesh<d> solid_mesh(const Body& body, const ElasticTable& table) {
  if (!table.mesh_file.empty()) return elastic::read_gmsh<d>(table.mesh_file, table.mesh_scale);
  if constexpr (d == 2)
    return elastic::outline_mesh(shape_of<2>(body.shape).surface, table.size, lines_of(table));
  else
    return mesh_in_space(body, table).mesh;
}

template elastic::SolidMesh<2> solid_mesh<2>(const Body&, const ElasticTable&);
template elastic::SolidMesh<3> solid_mesh<3>(const Body&, const ElasticTable&);
template std::vector<int> parts_of<2>(const ElasticTable&, const elastic::SolidMesh<2>&);
template std::vector<int> parts_of<3>(const ElasticTable&, const elastic::SolidMesh<3>&);
template std::optional<elastic::Place<2>> place_in<2>(const elastic::SolidMesh<2>&, const Point&);
template std::optional<elastic::Place<3>> place_in<3>(const elastic::SolidMesh<3>&, const Point&);
template double meshed_volume<2>(const Body&, const ElasticTable&, const elastic::SolidMesh<2>&);
template double meshed_volume<3>(const Body&, const ElasticTable&, const elastic::SolidMesh<3>&);

}  // namespace splashdown::apps
