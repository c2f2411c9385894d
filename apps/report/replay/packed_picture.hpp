// A moving picture as bytes, for unpack.js.
//
// Places are whole steps from the low corner of all that is seen. A step is a 32nd of the length that one edge in a hundred is
// shorter than: no place is off by more than half of it on an axis, a 64th of a short edge. Water has new triangles in each
// frame (mesh_code.hpp). A body is told once, and then as a rigid motion in each frame: place and unit quaternion (x, y, z, qx,
// qy, qz, qw). Points of one that bends are first moved, within the place of the first frame. Pressures are 255ths of where the colours end. In space the water has none: its colours tell its height.
#pragma once

#include <string>

#include "apps/report/replay/moving_picture.hpp"

namespace splashdown::apps {

/// {"dimension", "names", "low" [m], "step" [m], "pressure" [Pa], "above", "bodies": [{"points", "cells", "bends"}], "frames": [{"time",
/// "points", "cells", "steps", "references", "poses"}], "arrays": [{"name", "size", "count"}]}: `above`: some pressures are.
/// "mirror" {"axis", "at" [m]} where one half is told. The numbers of what the arrays of bytes hold, one after the other. An
/// array of `size` bytes a number has all their first bytes, then all second ones and so on. They are those of bodies, then of
/// frames: "steps" and "references" (mesh_code.hpp), "x", "y", "z" (how far places are from where they are expected),
/// "segments" (of bodies in the plane, from number to number), "water" (pressures, as places), "hulls" (pressures, from frame
/// to frame), "bends_x" and so on (ways of points of bodies that bend, from frame to frame). Differences of places and segments have their sign in the lowest bit; those of pressures are modulo 256.
struct PackedPicture {
  std::string json;
  std::string bytes;
  double limit = 0;  ///< where the colours end [Pa]; 0: there are none
  double step = 0;   ///< of places [m]
};

/// Throws std::runtime_error if a body has other points in another frame.
PackedPicture packed(const MovingPicture& picture);

}  // namespace splashdown::apps
