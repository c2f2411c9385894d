// A closed skin around triangles that bound no solid. Internal to the core room.
#pragma once

#include "core/surface/soup.hpp"
#include "core/types.hpp"

namespace splashdown {

/// A skin, and how near it lies to what is in it.
struct Wrap {
  Surface<3> surface;  ///< closed, normals outward
  double opening = 0;  ///< narrower ones are bridged; hollows narrower than it are filled [units of the file]
  double gap = 0;      ///< by which the skin lies outside of the triangles [units of the file]
};

/// An alpha wrap (Portaneri and others 2022) at a hundredth of the extent. Where it gets inside through openings, so that it
/// encloses less than half of what a coarse one does, it is made coarser until it stays outside.
Wrap wrapped(const Soup& soup);

}  // namespace splashdown
