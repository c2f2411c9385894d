// Lines whose mirror images are lines of the scene: in the plane of symmetry, or in pairs.
#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "apps/effects/lines/lines.hpp"
#include "apps/scene/mirror.hpp"

namespace splashdown::apps {
namespace {

/// All but the places of its ends.
auto make_of(const LineEntry& line) {
  const CatenaryEntry catenary = line.catenary.value_or(CatenaryEntry{});
  const CanopyEntry canopy = line.canopy.value_or(CanopyEntry{});
  return std::make_tuple(line.body, line.other, line.anchor.has_value(), line.length, line.stiffness,
                         line.axial_stiffness, line.damping, line.catenary.has_value(), catenary.weight, catenary.floor,
                         catenary.friction, line.canopy.has_value(), canopy.mass, canopy.drag_area, canopy.start,
                         canopy.inflation, canopy.air_density, line.release.time, line.release.load, line.release.wets);
}

}  // namespace

std::optional<std::string> LinesKind::asymmetry(const Scene& scene, const Mirror& mirror) const {
  const auto& lines = scene.effects.find<Lines>()->all;
  const double size = (scene.tank->max - scene.tank->min).norm();
  const auto lies_at_image = [&](Point a, const Point& b) {
    a[mirror.axis] = 2 * mirror.at - a[mirror.axis];
    return (a - b).norm() <= written_digits * size;
  };
  for (const LineEntry& line : lines) {
    const LineEnds ends = ends_at_start(scene, line);
    if (std::ranges::any_of(lines, [&](const LineEntry& other) {
          const LineEnds there = ends_at_start(scene, other);
          return make_of(line) == make_of(other) && lies_at_image(ends.from, there.from) &&
                 lies_at_image(ends.to, there.to);
        }))
      continue;
    return fmt::format(
        "'{}' has no mirror image: lines lie in the plane, or in pairs that are alike but for their places", line.name);
  }
  return {};
}

}  // namespace splashdown::apps
