// Hulls from files: STL (ASCII and binary) and OBJ, watertight triangle meshes.
//
// What a file must be: closed, every edge shared by two facets that agree about the outside, normals outward, no facet
// without area, no facets that cross. One that is not is refused with what, where and a cure, not repaired: a repair
// guesses, and the guess decides about mass and loads. Points that coincide but for rounding are one point (STL has no
// other way to say so), polygons become triangles.
//
// Facets are taken as they are. They need not have the size of the fluid's elements: walls are nearest points of
// facets, found in a tree, and the size of elements at a hull follows from the scene and from the hull's curvature.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "core/types.hpp"

namespace splashdown {

/// More are refused before they are read. A hull of 10 m has facets of 2 cm with this many.
inline constexpr long most_facets = 1'000'000;

/// A file that is refused: what() says the rule that it breaks and where.
class SurfaceFileError : public std::runtime_error {
 public:
  /// `rule`: what is broken, and where in the file; `cure`: what the user may do.
  SurfaceFileError(const std::string& rule, std::string cure) : std::runtime_error(rule), cure_(std::move(cure)) {}
  /// What the user may do about it.
  const std::string& cure() const { return cure_; }

 private:
  std::string cure_;
};

/// What a file holds: a closed surface, normals outward.
struct SurfaceFile {
  Surface<3> surface;  ///< in the units of the file
  int parts = 1;       ///< closed surfaces beside each other
};

/// Throws SurfaceFileError. Coordinates in messages are those of the file.
SurfaceFile read_surface_file(const std::filesystem::path& path);

}  // namespace splashdown
