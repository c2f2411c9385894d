#include "apps/scene/rules/check.hpp"

#include <fmt/format.h>

#include <limits>

#include "apps/scene/kinds/effect_kind.hpp"
#include "apps/scene/rules/rules.hpp"

namespace splashdown::apps {
namespace {

void check_tank(const Scene& scene, Problems& problems) {
  const auto& tank = *scene.tank;
  const Point size = tank.max - tank.min;
  if (size.head(scene.dimension).minCoeff() <= 0)
    return problems.add("tank.max", "must lie above tank.min on every axis", "Swap them, or mend the signs.");
  const double least = size.head(scene.dimension).minCoeff();
  if (least < smallest_length)
    return problems.add("tank.max",
                        fmt::format("must lie {:g} m above tank.min or more, on every axis", smallest_length),
                        "Mind the units of its lengths.");
  if (scene.fluid && tank.size > least)  // what is not given is that of the liquid
    problems.add(problems.noted("tank.size")        ? "tank.size"
                 : problems.noted("fluid.size.far") ? "fluid.size.far"
                                                    : "fluid.size.surface",
                 fmt::format("must not exceed the tank's smallest side, {:g} m", least), "Use e.g. a tenth of it.");
}

void check_times(const Scene& scene, Problems& problems) {
  if (scene.output.interval > scene.time.end)
    problems.add("output.interval", fmt::format("must not exceed time.end = {:g} s", scene.time.end),
                 "Use 0 for a row every step.");
}

template <int d>
void check_parts(const Scene& scene, const SceneLabels& labels, Problems& problems) {
  if (scene.fluid) check_fluid<d>(scene, labels, problems);
  if (scene.vortex) check_vortex(scene, labels, problems);
  if (scene.ale) check_ale(scene, labels, problems);
  check_bodies<d>(scene, labels, problems);
  check_joints(scene, labels, problems);
  check_records<d>(scene, labels, problems);
  check_limits(scene, labels, problems);
}

}  // namespace

void check_scene(const Scene& read, const SceneLabels& labels, Problems& problems) {
  if (!read.has_fluid() && read.bodies.empty() && !problems.found_in("fluid") && !problems.found_in("body"))
    problems.add("", "the scene is empty: it has neither [fluid] nor [[body]]", "Add one of them.");
  // What could not be read must not be judged by its default.
  Scene scene = read;
  if (scene.tank && !problems.found_in("tank")) check_tank(scene, problems);
  if (problems.found_in("tank")) scene.tank.reset();
  if (problems.found_in("time.end")) scene.time.end = std::numeric_limits<double>::infinity();
  check_times(scene, problems);
  for (const auto* kind : effect_kinds()) kind->check(read, problems);
  scene.dimension == 2 ? check_parts<2>(scene, labels, problems) : check_parts<3>(scene, labels, problems);
}

}  // namespace splashdown::apps
