// Polygons of a surface file as they are read, before anything is known of a surface. Internal to the core room.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace splashdown {

/// Points and the polygons between them.
struct Soup {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;  ///< of its points

  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;

  /// Of a point [units of the file].
  Vec<3> at(std::size_t point) const { return {points[point].x(), points[point].y(), points[point].z()}; }
  Vec<3> centre(std::size_t polygon) const;  ///< mean of a polygon's corners
  Eigen::AlignedBox3d box() const;           ///< around all points
  /// Diagonal of the box.
  double extent() const { return box().diagonal().norm(); }
};

/// Throws SurfaceFileError if the file is no whole mesh.
Soup read_soup(const std::filesystem::path& path);

/// The facets of a surface [m or units of a file].
Soup soup_of(const Surface<3>& surface);
/// The way back; polygons have three corners.
Surface<3> surface_of(const Soup& soup);

/// Triangles that know their neighbours.
using Shell = CGAL::Surface_mesh<Soup::Kernel::Point_3>;

/// The facets of a closed surface, joined along their edges [units of the surface].
Shell shell_of(const Surface<3>& surface);
/// The way back.
Soup soup_of(const Shell& shell);

/// One point for those that rounding has parted: of single precision, which STL files have, or of their digits. How many are
/// gone.
/// Throws SurfaceFileError if all are one.
std::size_t merge_points(Soup& soup);

/// "(1, 2, 3)"
std::string text(const Vec<3>& x);

/// What is told of surfaces that are not closed.
extern const std::string cure_of_open_surface;

}  // namespace splashdown
