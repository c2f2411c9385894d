// Hulls from files that break the rules of surface_file.hpp, made to keep them, on request.
//
// A repair guesses: a lid over a hole decides what displaces water, a part that is removed what weighs. Hence all that is
// done is told. The steps, by CGAL's Polygon Mesh Processing: points that rounding has parted become one; facets without area and
// facets that are there twice go; facets agree about their outside; borders that coincide are stitched, holes get lids;
// parts turn their normals outward; parts inside others go, parts that cross each other are united. What crosses itself is
// wrapped in a closed skin instead (CGAL's Alpha Wrapping).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace splashdown {

/// A mended hull, and how.
struct RepairedSurface {
  Surface<3> surface;  ///< in the units of the file; closed, normals outward
  std::vector<std::string>
      done;  ///< what was done, a sentence without a full stop each; empty: there was nothing to do
};

/// Throws SurfaceFileError for files that are no whole mesh, and for parts without thickness.
RepairedSurface repaired_surface(const std::filesystem::path& path);

/// Writes an STL file, with all digits. Throws std::runtime_error if it cannot be written.
void write_stl(const std::filesystem::path& path, const Surface<3>& surface);

}  // namespace splashdown
