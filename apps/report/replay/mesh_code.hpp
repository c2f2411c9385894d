// Triangles as few bytes: each is put at an edge of those before it, and mostly brings one new point or closes a gap.
//
// An open edge u -> w of a triangle (u, w, o) asks for its neighbour (w, u, v): a code says whether there is one and which
// point v is. Points are numbered in the order in which they come. A new one is expected at u + w - o, the fourth corner of a
// parallelogram, so that what is left to tell of it is small. Source: Touma and Gotsman, Graphics Interface 1998; here with a
// queue of edges, from which any soup of triangles can be told: an edge that three triangles share, or one that is run through
// twice, begins a new patch. Cost: two bits a triangle after compression. viewer: unpack.js reads it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace splashdown::apps {

enum class MeshStep : std::uint8_t {
  none = 0,   ///< the edge has no neighbour that is not told yet
  fresh = 1,  ///< v is a new point
  next = 2,   ///< v ends the open edge that begins at w
  last = 3,   ///< v begins the open edge that ends at u
  named = 4   ///< v is what a reference says
};

/// Where a new point is expected: at u + w - o, new numbers; u = -1: at the origin.
struct Expected {
  int u = -1, w = -1, o = -1;
};

struct MeshCode {
  std::vector<std::uint8_t> steps;        ///< MeshStep; a patch begins with three steps, fresh or named
  std::vector<std::uint32_t> references;  ///< of the named, how many points lie between the newest and it
  std::vector<int> order;                 ///< the old number of each new point; points of no triangle are left out
  std::vector<Expected> expected;         ///< of each new point
};

/// `corners`: three a triangle, numbers of points below `points`. Triangles turn as they did; they begin at any of their corners.
MeshCode mesh_code(const std::vector<int>& corners, std::size_t points);

}  // namespace splashdown::apps
