#include "fluid/pfem/mesh/sizes/narrow_strips.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {
namespace {

constexpr double slope = 0.45;       // of h: neighbours' volumes differ by three, which their inertia bears
constexpr double least_width = 0.1;  // over h: nearer contact lines merge with the edge

struct Strip {
  Vec<3> at;
  double size, reach;  // of elements; where they are as large as without the strip [m]
};

// A facet of the wall from an edge of the contact line to a node on an edge of the wall, under water.
std::vector<Strip> strips_of(const Nodes<3>& nodes, const Mesh<3>& mesh, const RestingContact& rests) {
  std::map<int, Strip> strips;  // by node
  auto is_contact = [&](int n, int wall) {
    return nodes.tie[n].wall == wall && nodes.surface[n] && !nodes.tie[n].sharp();
  };
  for (const auto& f : mesh.boundary) {
    if (f.wall < 0) continue;
    for (int k = 0; k < 3; ++k) {
      const int a = f.nodes[k], b = f.nodes[(k + 1) % 3], across = f.nodes[(k + 2) % 3];
      const WallTie& tie = nodes.tie[across];
      if (tie.wall != f.wall || !tie.sharp() || nodes.surface[across] || !is_contact(a, f.wall) ||
          !is_contact(b, f.wall))
        continue;
      const Vec<3> along = nodes.x[b] - nodes.x[a], to = nodes.x[across] - nodes.x[a];
      const double width = along.cross(to).norm() / along.norm(), h = nodes.h[a];
      if (width >= h || !rests(a, width) || !rests(b, width)) continue;
      const double size = std::max(width, least_width * h);
      for (int n : f.nodes) {
        Strip& strip = strips.try_emplace(n, Strip{nodes.x[n], size, 0}).first->second;
        strip.size = std::min(strip.size, size);
        strip.reach = std::max(strip.reach, (h - size) / slope);
      }
    }
  }
  std::vector<Strip> found;
  for (const auto& [node, strip] : strips) found.push_back(strip);
  return found;
}

}  // namespace

void resolve_narrow_strips(Nodes<3>& nodes, const Mesh<3>& mesh, const RestingContact& rests) {
  const std::vector<Strip> strips = strips_of(nodes, mesh, rests);
  if (strips.empty()) return;
  Eigen::AlignedBox3d near;
  for (const Strip& s : strips) {
    near.extend((s.at.array() - s.reach).matrix());
    near.extend((s.at.array() + s.reach).matrix());
  }
  in_parallel(nodes.size(), [&](std::size_t i) {
    if (!near.contains(nodes.x[i])) return;
    for (const Strip& s : strips) nodes.h[i] = std::min(nodes.h[i], s.size + slope * (nodes.x[i] - s.at).norm());
  });
}

}  // namespace splashdown::fluid
