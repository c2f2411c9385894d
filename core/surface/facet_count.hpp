// A first look at a surface file, in one pass and bounded memory. Internal to the core room.
#pragma once

#include <filesystem>

namespace splashdown {

/// Formats of surface files.
enum class SurfaceFormat { stl_ascii, stl_binary, obj };

/// What a file says it is.
struct FacetCount {
  SurfaceFormat format;  ///< found from the first bytes and the ending
  long facets;           ///< triangles, polygons counted as such
};

/// Throws SurfaceFileError at the first line that is none of the format, and beyond `most_facets`.
FacetCount count_facets(const std::filesystem::path& path);

}  // namespace splashdown
