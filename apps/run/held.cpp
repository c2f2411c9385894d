#include "apps/run/held.hpp"

#include <algorithm>
#include <cmath>

#include "apps/scene/geometry.hpp"
#include "apps/scene/kinds/joint_kinds.hpp"

namespace splashdown::apps {
namespace {

constexpr double still = 1e-6;     // of its length: less is no motion
constexpr double balanced = 1e-3;  // of weight and load: what a mesh does not resolve

bool is_welded(const Scene& scene, std::size_t body) {
  return std::ranges::any_of(scene.joints, [&](const Joint& joint) {
    return !kind_of(joint).moves() && (joint.body == body || joint.other == body);
  });
}

}  // namespace

template <int d>
void mark_held(const Scene& scene, double time, Summary& summary) {
  if (scene.contact || !(time > 0)) return;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const auto& body = scene.bodies[b];
    const auto found = summary.bodies.find(body.name);
    if (found == summary.bodies.end() || body.motion != Motion::free || body.deforms || is_welded(scene, b)) continue;
    auto& of = found->second;
    const double mass = mass_properties<d>(body).mass, length = extents<d>(outline<d>(body)).sizes().maxCoeff();
    if (of.fastest * time > still * length || of.impulse.size() != d) continue;
    const auto names = freedom_names(d);
    double left = 0, most = 0;
    for (int k = 0; k < d; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const double load = of.impulse[at] / time, weight = scene.gravity ? mass * scene.gravity->acceleration[k] : 0;
      most = std::max({most, std::abs(load), std::abs(weight)});
      if (std::ranges::find(body.free, names[at]) != body.free.end()) left = std::hypot(left, load + weight);
    }
    if (left > balanced * most) of.held_against = left;
  }
}

template void mark_held<2>(const Scene&, double, Summary&);
template void mark_held<3>(const Scene&, double, Summary&);

}  // namespace splashdown::apps
