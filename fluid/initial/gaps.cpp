#include "fluid/initial/gaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "fluid/initial/parts.hpp"

namespace splashdown::fluid {
namespace {

constexpr double narrowest = 0.01;   // over h
constexpr double on_surface = 1e-3;  // of a liquid, over h

[[noreturn]] void refuse(const Wall<3>& a, const Wall<3>& b, const Vec<3>& x, double h, const std::string& why) {
  throw std::invalid_argument(
      fmt::format("the gap between {} and {} at ({:.4g}, {:.4g}, {:.4g}) m {}elements of {:.3g} m. Use smaller ones "
                  "there, move the two apart, or let them touch",
                  a.spec().name, b.spec().name, x.x(), x.y(), x.z(), why, h));
}

bool touches(const Wall<3>& wall, const Isometry<3>& pose, const Vec<3>& x) {
  const double tiny = on_wall * wall.diameter();
  return wall.distance_unsigned(pose, x, 2 * tiny) < tiny;
}

}  // namespace

void refuse_narrow_gaps(std::span<const std::array<Vec<3>, 2>> edges, const SizeField<3>& size,
                        const WallsAt<3>& walls) {
  for (const auto& [from, to] : edges) {
    const Vec<3> middle = 0.5 * (from + to);
    for (std::size_t own = 0; own < walls.walls.size(); ++own) {
      if (!touches(walls.walls[own], walls.poses[own], middle)) continue;
      for (std::size_t w = 0; w < walls.walls.size(); ++w) {
        const Wall<3>& other = walls.walls[w];
        if (w == own || !other.has_creases() || touches(other, walls.poses[w], middle)) continue;
        const auto nearest = other.nearest_crease(walls.poses[w], from, to);
        if (nearest.distance <= on_wall * other.diameter()) continue;
        if (const double h = size(nearest.point); nearest.distance < narrowest * h)
          refuse(walls.walls[own], other, nearest.point, h,
                 fmt::format("is {:.3g} m wide, too narrow for ", nearest.distance));
      }
    }
  }
}

void refuse_holes(const InitialLiquid<3>& mesh, std::span<const LiquidSpec<3>> liquids, const WallsAt<3>& walls) {
  const auto outlines = outlines_of<3>(liquids);
  const auto& nodes = mesh.nodes;
  for (const auto& f : mesh.mesh.boundary) {
    const int wall = nodes.tie[f.nodes[0]].wall;
    auto tied = [&](int n) { return nodes.tie[n].wall >= 0; };
    const auto other = std::ranges::find_if(f.nodes, [&](int n) { return tied(n) && nodes.tie[n].wall != wall; });
    if (f.wall >= 0 || other == f.nodes.end() || !std::ranges::all_of(f.nodes, tied)) continue;
    Vec<3> centre = Vec<3>::Zero();
    double h = 0;
    for (int n : f.nodes) centre += nodes.x[n] / 3, h += nodes.h[n] / 3;
    const bool is_surface = std::ranges::any_of(outlines, [&](const Wall<3>& outline) {
      return outline.distance_unsigned(Isometry<3>::Identity(), centre, h) < on_surface * h;
    });
    if (!is_surface)
      refuse(walls.walls[wall], walls.walls[nodes.tie[*other].wall], centre, h, "cannot be filled with ");
  }
}

}  // namespace splashdown::fluid
