#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "apps/scene/rules/check.hpp"
#include "apps/scene/rules/rules.hpp"
#include "apps/scene/solid.hpp"

namespace splashdown::apps {
namespace {

template <int d>
using Outlines = std::vector<std::optional<Solid<d>>>;

template <int d>
struct CheckRegionKeys {
  std::string label;
  Problems& problems;

  void operator()(const BoxRegion& box) const {
    const double height = box.max[d - 1] - box.min[d - 1];
    if (vec<d>(box.max - box.min).minCoeff() <= 0)
      problems.add(label + ".max", "must lie above min on every axis", "Swap them, or mend the signs.");
    else if (vec<d>(box.max - box.min).minCoeff() < smallest_length)
      problems.add(label + ".max", fmt::format("must lie {:g} m above min or more, on every axis", smallest_length),
                   "Mind the units of its lengths.");
    else if (std::abs(box.surface_amplitude) >= height)
      problems.add(label + ".surface_amplitude", fmt::format("must stay below the depth of {:g} m", height),
                   "Use a smaller wave.");
  }
  void operator()(const UnionRegion& all) const {
    for (std::size_t i = 0; i < all.parts.size(); ++i)
      std::visit(CheckRegionKeys<d>{fmt::format("{}.part[{}]", label, i), problems}, all.parts[i].shape);
  }
  template <class Other>
  void operator()(const Other&) const {}
};

void check_sizes(const Scene& scene, Problems& problems) {
  const auto& size = scene.fluid->size;
  if (size.far < size.surface && !problems.found_in("fluid.size"))
    problems.add("fluid.size.far", fmt::format("must not be below fluid.size.surface = {:g} m", size.surface),
                 "It is the largest element size.");
  if (!scene.tank) return;
  const double least = (scene.tank->max - scene.tank->min).head(scene.dimension).minCoeff();
  if (least > 0 && size.surface > least)
    problems.add("fluid.size.surface", fmt::format("must not exceed the tank's smallest side, {:g} m", least),
                 "Use e.g. a fiftieth of it.");
}

/// The key that says how large a region is.
const char* key_of_extent(const Region& region) {
  struct Key {
    const char* operator()(const BoxRegion&) const { return ".max"; }
    const char* operator()(const PolygonRegion&) const { return ".points"; }
    const char* operator()(const EllipseRegion&) const { return ".semi_axes"; }
    const char* operator()(const CircleRegion&) const { return ".radius"; }
    const char* operator()(const SphereRegion&) const { return ".radius"; }
    const char* operator()(const SplineRegion&) const { return ".points"; }
    const char* operator()(const RevolvedRegion&) const { return ".profile"; }
    const char* operator()(const UnionRegion&) const { return ".part"; }
  };
  return std::visit(Key{}, region.shape);
}

/// For regions that have no outline.
struct CureOfOutline {
  const char* operator()(const PolygonRegion&) const { return "List the corners in order, each once."; }
  const char* operator()(const SplineRegion&) const { return cure_of_spline; }
  const char* operator()(const RevolvedRegion&) const { return cure_of_profile; }
  const char* operator()(const UnionRegion&) const {
    return "Let the parts overlap, or make them regions of their own.";
  }
  template <class Other>
  const char* operator()(const Other&) const {
    return "Mind the units of its lengths.";
  }
};

template <int d>
void check_region(const Scene& scene, const Region& region, const std::string& label, std::optional<Solid<d>>& boundary,
                  Problems& problems) {
  const double trace = region.velocity_gradient.trace(), scale = region.velocity_gradient.norm();
  // Digits that people write: a trace of a millionth of the rates is meant to be zero.
  if (std::abs(trace) > 1e-6 * scale)
    problems.add(label + ".velocity_gradient",
                 fmt::format("must have zero trace, not {:g} 1/s: the liquid keeps its volume", trace),
                 "Balance its diagonal.");
  try {
    boundary.emplace(outline<d>(region));
  } catch (const std::invalid_argument& error) {
    return problems.add(label + key_of_extent(region), error.what(), std::visit(CureOfOutline{}, region.shape));
  }
  const auto& box = boundary->extents();
  if (scene.fluid->size.surface > box.sizes().minCoeff())
    problems.add("fluid.size.surface",
                 fmt::format("must not exceed the smallest extent of {}, {:g} m", label, box.sizes().minCoeff()),
                 "Use e.g. a twentieth of it.");
  if (!scene.tank) return;
  const Extents<d> tank = extents<d>(*scene.tank);
  if (!tank.isEmpty() && (tank.intersection(box).sizes().array() <= 0).any())
    problems.add(label, fmt::format("lies outside the tank, which spans {} m", text<d>(tank)),
                 "Move the region or enlarge the tank.");
}

}  // namespace

template <int d>
void check_fluid(const Scene& scene, const SceneLabels& labels, Problems& problems) {
  check_sizes(scene, problems);
  const auto& regions = scene.fluid->regions;
  Outlines<d> outlines(regions.size());
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (problems.found_in(labels.regions[i])) continue;
    std::visit(CheckRegionKeys<d>{labels.regions[i], problems}, regions[i].shape);
    if (problems.found_in(labels.regions[i])) continue;
    check_region<d>(scene, regions[i], labels.regions[i], outlines[i], problems);
    for (std::size_t j = 0; j < i; ++j)
      if (outlines[i] && outlines[j] && overlap<d>(*outlines[i], *outlines[j]))
        problems.add(labels.regions[i], "overlaps " + labels.regions[j], "Regions may touch, but not share water.");
  }
}

template void check_fluid<2>(const Scene&, const SceneLabels&, Problems&);
template void check_fluid<3>(const Scene&, const SceneLabels&, Problems&);

}  // namespace splashdown::apps
