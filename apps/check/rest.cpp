#include "apps/check/rest.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "apps/build/build.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/scales.hpp"
#include "apps/scene/solid.hpp"

namespace splashdown::apps {
namespace {

template <int d>
using All = std::vector<std::optional<Resting<d>>>;

template <int d>
bool reaches_into_hollow(const Scene& scene, const rigid::BodySpec<d>& spec) {
  const auto bottoms = rigid::hollow_bottoms<d>(spec.surface, spec.pose);
  return !bottoms.empty() && std::ranges::any_of(scene.fluid->regions, [&](const Region& region) {
    const Solid<d> liquid(outline<d>(region));
    return std::ranges::any_of(bottoms, [&](const auto& x) { return liquid.contains(x); });
  });
}

/// Nothing that still water could do to it is held.
bool tilts_and_heaves(const rigid::BodySpec<2>& spec) { return spec.free[1] && spec.free[2]; }
bool tilts_and_heaves(const rigid::BodySpec<3>& spec) { return spec.free[2] && spec.free[3] && spec.free[4]; }

template <int d>
rigid::Surface<d> placed(const rigid::BodySpec<d>& spec, const rigid::Isometry<d>& pose) {
  return {(pose.linear() * spec.surface.vertices).colwise() + pose.translation(), spec.surface.facets};
}

bool is_tied(const Scene& scene, std::size_t body) {
  return std::ranges::any_of(scene.joints, [&](const Joint& j) { return j.body == body || j.other == body; });
}

/// From t = 0 to its rest it stays clear of the tank and of where all others are or come to.
template <int d>
bool meets_nothing(const Scene& scene, const std::vector<rigid::BodySpec<d>>& specs, const All<d>& all) {
  std::vector<Extents<d>> swept;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    swept.push_back(extents<d>(placed<d>(specs[i], specs[i].pose)));
    if (!all[i]) continue;
    if (!all[i]->floats) return false;
    const auto there = extents<d>(placed<d>(specs[i], all[i]->floats->pose));
    swept.back().extend(there);
    if (scene.tank && !extents<d>(*scene.tank).contains(there)) return false;
  }
  for (std::size_t i = 0; i < swept.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (swept[i].intersects(swept[j])) return false;
  return true;
}

/// Those that joints tie together have one number.
std::vector<std::size_t> groups(const Scene& scene) {
  std::vector<std::size_t> of(scene.bodies.size());
  std::iota(of.begin(), of.end(), 0);
  const auto moves = [&](std::size_t body) { return scene.bodies[body].motion == Motion::free; };
  for (const auto& joint : scene.joints) {
    if (!joint.other || !moves(joint.body) || !moves(*joint.other)) continue;
    std::ranges::replace(of, of[joint.body], std::size_t(of[*joint.other]));
  }
  return of;
}

template <int d>
rigid::Mechanism<d> mechanism_of(const Scene& scene, const std::vector<rigid::BodySpec<d>>& specs, const All<d>& all,
                                 const std::function<bool(std::size_t)>& belongs) {
  rigid::Mechanism<d> mechanism{specs, {}, contact_spec<d>(scene), {}};
  for (std::size_t i = 0; i < specs.size(); ++i) {
    mechanism.hollows.push_back(all[i] ? all[i]->hollow : rigid::Hollow::dry);
    if (!belongs(i)) mechanism.bodies[i].motion = BodyMotion::fixed;
  }
  for (const auto& joint : joint_specs(scene))
    if (belongs(joint.body) || (joint.other && belongs(*joint.other))) mechanism.joints.push_back(joint);
  return mechanism;
}

}  // namespace

template <int d>
std::vector<std::optional<Resting<d>>> at_rest(const Scene& scene) {
  All<d> all(scene.bodies.size());
  const auto level = still_water_level<d>(scene);
  const double gravity = scene.gravity ? -scene.gravity->acceleration[d - 1] : 0;
  if (!level || !(gravity > 0)) return all;
  const rigid::StillWater water{scene.fluid->density, gravity, *level};
  std::vector<rigid::BodySpec<d>> specs;
  for (const auto& body : scene.bodies) specs.push_back(body_spec<d>(body));
  bool alone = true;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    const auto& spec = specs[i];
    if (spec.motion != BodyMotion::free || !(spec.mass > 0)) continue;
    auto& body = all[i].emplace();
    body.spec = spec;
    body.filled = reaches_into_hollow<d>(scene, spec);
    if (body.filled) body.hollow = rigid::Hollow::flooded;
    const bool unheld = tilts_and_heaves(spec) && !is_tied(scene, i);
    alone = alone && unheld;
    if (unheld)
      body.floats =
          rigid::floating_stable<d>(spec.surface, spec.pose, spec.mass, water.density, water.level, body.hollow);
  }
  const bool together = scene.contact && !(alone && meets_nothing<d>(scene, specs, all));
  const auto group = groups(scene);
  std::vector<bool> done(specs.size(), false);
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (!all[i] || done[i]) continue;
    if (!together && tilts_and_heaves(specs[i]) && !is_tied(scene, i)) continue;
    const auto belongs = [&](std::size_t b) { return all[b] && (together || group[b] == group[i]); };
    const auto rest = rigid::at_rest<d>(mechanism_of<d>(scene, specs, all, belongs), water);
    for (std::size_t b = 0; b < specs.size(); ++b) {
      if (!belongs(b)) continue;
      done[b] = true;
      const bool unheld = tilts_and_heaves(specs[b]) && !is_tied(scene, b);
      if (!unheld || rest.bodies[b].touches || !all[b]->floats) all[b]->held = rest.bodies[b];
    }
  }
  return all;
}

template std::vector<std::optional<Resting<2>>> at_rest<2>(const Scene&);
template std::vector<std::optional<Resting<3>>> at_rest<3>(const Scene&);

}  // namespace splashdown::apps
