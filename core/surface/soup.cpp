#include "core/surface/soup.hpp"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <fmt/format.h>

#include <array>
#include <map>
#include <optional>

#include "core/surface/facet_count.hpp"
#include "core/surface/surface_file.hpp"

namespace splashdown {

const std::string cure_of_open_surface =
    "Close it in the tool that made it, e.g. Blender: 3D-Print Toolbox > Make Manifold, or MeshLab: "
    "Filters > Remeshing > Close Holes, and export it again.";

Vec<3> Soup::centre(std::size_t polygon) const {
  Vec<3> sum = Vec<3>::Zero();
  for (const auto point : polygons[polygon]) sum += at(point);
  return sum / static_cast<double>(polygons[polygon].size());
}

Eigen::AlignedBox3d Soup::box() const {
  Eigen::AlignedBox3d all;
  for (std::size_t i = 0; i < points.size(); ++i) all.extend(at(i));
  return all;
}

std::string text(const Vec<3>& x) { return fmt::format("({:g}, {:g}, {:g})", x.x(), x.y(), x.z()); }

Soup read_soup(const std::filesystem::path& path) {
  const auto expected = count_facets(path);
  Soup soup;
  const bool good = expected.format == SurfaceFormat::obj
                        ? CGAL::IO::read_OBJ(path.string(), soup.points, soup.polygons)
                        : CGAL::IO::read_STL(path.string(), soup.points, soup.polygons);
  long triangles = 0;
  bool whole = good;
  for (const auto& polygon : soup.polygons) {
    triangles += static_cast<long>(polygon.size()) - 2;
    for (const auto point : polygon) whole = whole && point < soup.points.size();
  }
  for (std::size_t i = 0; i < soup.points.size(); ++i) whole = whole && soup.at(i).allFinite();
  if (!whole || triangles != expected.facets)
    throw SurfaceFileError(
        fmt::format("is not a whole mesh: {} of {} facets could be read", triangles, expected.facets),
        "Export it again as STL or OBJ.");
  if (triangles < 4)
    throw SurfaceFileError(fmt::format("has {} facets; a closed surface has at least 4", triangles),
                           cure_of_open_surface);
  return soup;
}

Soup soup_of(const Surface<3>& surface) {
  Soup soup;
  for (Eigen::Index i = 0; i < surface.vertices.cols(); ++i)
    soup.points.emplace_back(surface.vertices(0, i), surface.vertices(1, i), surface.vertices(2, i));
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
    auto& corners = soup.polygons.emplace_back();
    for (int k = 0; k < 3; ++k) corners.push_back(static_cast<std::size_t>(surface.facets(k, f)));
  }
  return soup;
}

Surface<3> surface_of(const Soup& soup) {
  Surface<3> surface;
  surface.vertices.resize(3, static_cast<Eigen::Index>(soup.points.size()));
  surface.facets.resize(3, static_cast<Eigen::Index>(soup.polygons.size()));
  for (std::size_t i = 0; i < soup.points.size(); ++i) surface.vertices.col(static_cast<Eigen::Index>(i)) = soup.at(i);
  for (std::size_t f = 0; f < soup.polygons.size(); ++f)
    for (int k = 0; k < 3; ++k)
      surface.facets(k, static_cast<Eigen::Index>(f)) = static_cast<int>(soup.polygons[f][static_cast<std::size_t>(k)]);
  return surface;
}

Shell shell_of(const Surface<3>& surface) {
  Soup soup = soup_of(surface);
  Shell shell;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, shell);
  return shell;
}

Soup soup_of(const Shell& shell) {
  Soup soup;
  CGAL::Polygon_mesh_processing::polygon_mesh_to_polygon_soup(shell, soup.points, soup.polygons);
  return soup;
}

std::size_t merge_points(Soup& soup) {
  const Vec<3> origin = soup.box().min();
  const double near = 1e-6 * soup.extent();
  if (!(near > 0))
    throw SurfaceFileError(fmt::format("has no extent: all its points are at {}", text(origin)), "Export it again.");
  using Cell = std::array<long, 3>;
  std::map<Cell, std::vector<std::size_t>> cells;
  std::vector<Soup::Kernel::Point_3> points;
  std::vector<std::size_t> now(soup.points.size());
  const auto cell_of = [&](const Vec<3>& x) {
    const Vec<3> count = (x - origin) / near;
    return Cell{std::lround(count.x()), std::lround(count.y()), std::lround(count.z())};
  };
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    const Vec<3> x = soup.at(i);
    const Cell cell = cell_of(x);
    std::optional<std::size_t> same;
    for (int k = 0; k < 27 && !same; ++k) {
      const auto found =
          cells.find({cell[0] + (k % 3 + 1) % 3 - 1, cell[1] + (k / 3 % 3 + 1) % 3 - 1, cell[2] + (k / 9 + 1) % 3 - 1});
      if (found == cells.end()) continue;
      for (const auto other : found->second)
        if ((Vec<3>(points[other].x(), points[other].y(), points[other].z()) - x).norm() <= near) same = other;
    }
    if (!same) {
      same = points.size();
      points.push_back(soup.points[i]);
      cells[cell].push_back(*same);
    }
    now[i] = *same;
  }
  const std::size_t gone = soup.points.size() - points.size();
  soup.points = std::move(points);
  for (auto& polygon : soup.polygons)
    for (auto& point : polygon) point = now[point];
  return gone;
}

}  // namespace splashdown
