#include "fluid/pfem/initial/gaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "fluid/pfem/initial/parts.hpp"

namespace splashdown::fluid {
namespace {

constexpr double narrowest = 0.01;   // over h
constexpr double on_surface = 1e-3;  // of a liquid, over h
// A facet between nodes on a surface of radius R is off it by h^2/(8 R) in its centre: so much at R = 1.25 h, over h.
constexpr double on_curved_surface = 0.1;

[[noreturn]] void refuse(const Gap& gap, const WallsAt<3>& walls, const std::string& why) {
  throw GapRefused(
      gap, fmt::format("the gap between {} and {} at ({:.4g}, {:.4g}, {:.4g}) m {}elements of {:.3g} m. Use smaller "
                       "ones there, move the two apart, or let them touch",
                       walls.walls[gap.first].spec().name, walls.walls[gap.second].spec().name, gap.at.x(), gap.at.y(),
                       gap.at.z(), why, gap.size));
}

bool touches(const Wall<3>& wall, const WallPlace<3>& pose, const Vec<3>& x) {
  const double tiny = on_wall * wall.diameter();
  return wall.distance_unsigned(pose, x, 2 * tiny) < tiny;
}

// Looks along facets, in pieces of a quarter of an element where another wall may be near.
class GapSearch {
 public:
  GapSearch(const SizeSpec& spec, const SizeField<3>& size, const WallsAt<3>& walls)
      : growth_(spec.growth), size_(size), walls_(walls) {}

  // Vertices of walls that touch lie on both.
  void mark_touching(std::span<const SkinFacet> skin) {
    for (const auto& facet : skin)
      for (std::size_t w = 0; facet.wall >= 0 && w < walls_.walls.size(); ++w)
        if (w != own(facet) && std::ranges::any_of(facet.corners, [&](const Vec<3>& x) {
              return touches(walls_.walls[w], walls_.poses[w], x);
            }))
          touching_.insert(std::minmax({own(facet), w}));
  }

  void look_at(const SkinFacet& facet) {
    if (facet.wall < 0) return;
    const Vec<3> normal = -area_vector(facet.corners).normalized();  // out of the wall, into the liquid
    for (std::size_t w = 0; w < walls_.walls.size(); ++w)
      if (w != own(facet) && !touching_.contains(std::minmax({own(facet), w})))
        look(facet.corners, normal, own(facet), w);
  }

  const std::optional<Gap>& narrowest() const { return narrowest_; }

 private:
  using Corners = std::array<Vec<3>, 3>;
  static std::size_t own(const SkinFacet& facet) { return static_cast<std::size_t>(facet.wall); }

  void look(const Corners& corners, const Vec<3>& normal, std::size_t wall, std::size_t other) {
    const Vec<3> centre = (corners[0] + corners[1] + corners[2]) / 3;
    double radius = 0;
    for (const Vec<3>& x : corners) radius = std::max(radius, (x - centre).norm());
    const double h = size_(centre, static_cast<int>(wall)), reach = radius + filled_gap * (h + growth_ * radius);
    const auto near = walls_.walls[other].nearest(walls_.poses[other], centre, reach);
    if (std::abs(near.distance) >= reach) return;
    if (radius > quarter_ * h) return halve(corners, normal, wall, other);
    const Vec<3> across = near.point - centre;
    const double width = across.norm();
    const bool faces = across.dot(normal) > facing_ * width && near.normal.dot(normal) < -facing_;
    if (!faces || width >= filled_gap * h) return;
    if (!narrowest_ || width * narrowest_->size < narrowest_->width * h)
      narrowest_ = Gap{wall, other, centre, width, h};
  }

  void halve(const Corners& c, const Vec<3>& normal, std::size_t wall, std::size_t other) {
    int longest = 0;
    const auto length = [&](int k) { return (c[(k + 1) % 3] - c[k]).squaredNorm(); };
    for (int k = 1; k < 3; ++k)
      if (length(k) > length(longest)) longest = k;
    const Vec<3>&from = c[longest], &to = c[(longest + 1) % 3], &apex = c[(longest + 2) % 3];
    const Vec<3> middle = 0.5 * (from + to);
    look({from, middle, apex}, normal, wall, other);
    look({middle, to, apex}, normal, wall, other);
  }

  static constexpr double quarter_ = 0.25;
  static constexpr double facing_ = 0.7;  // cosine: walls that turn away by more leave room beside the narrow place
  double growth_;
  const SizeField<3>& size_;
  const WallsAt<3>& walls_;
  std::set<std::pair<std::size_t, std::size_t>> touching_;
  std::optional<Gap> narrowest_;
};

}  // namespace

std::optional<Gap> narrowest_gap(std::span<const SkinFacet> skin, const SizeSpec& spec, const SizeField<3>& size,
                                 const WallsAt<3>& walls) {
  GapSearch search(spec, size, walls);
  search.mark_touching(skin);
  for (const auto& facet : skin) search.look_at(facet);
  return search.narrowest();
}

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
          refuse({own, w, nearest.point, nearest.distance, h}, walls,
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
    const auto on_outline = [&](const Vec<3>& x, double near) {
      return std::ranges::any_of(outlines, [&](const Wall<3>& outline) {
        return outline.distance_unsigned(Isometry<3>::Identity(), x, h) < near * h;
      });
    };
    const bool is_surface = on_outline(centre, on_surface) ||
                            (on_outline(centre, on_curved_surface) &&
                             std::ranges::all_of(f.nodes, [&](int n) { return on_outline(nodes.x[n], on_surface); }));
    if (!is_surface)
      refuse({static_cast<std::size_t>(wall), static_cast<std::size_t>(nodes.tie[*other].wall), centre, 0, h}, walls,
             "cannot be filled with ");
  }
}

}  // namespace splashdown::fluid
