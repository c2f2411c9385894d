#include "apps/run/expectations.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "apps/scene/geometry.hpp"

namespace splashdown::apps {
namespace {

/// By body, the number of the group that joints tie it into.
std::vector<std::size_t> groups_of(const Scene& scene) {
  std::vector<std::size_t> group(scene.bodies.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (const auto& joint : scene.joints)
    if (joint.other) std::ranges::replace(group, std::size_t{group[*joint.other]}, std::size_t{group[joint.body]});
  return group;
}

bool moves(const Body& body) {
  if (body.becomes_free()) return !body.free.empty();
  return body.motion == Motion::prescribed &&
         (!body.path.empty() || body.velocity.squaredNorm() > 0 || body.spin_deg.squaredNorm() > 0);
}

double length_of(const Scene& scene, const Body& body) {
  return scene.dimension == 2 ? extents<2>(outline<2>(body)).sizes().maxCoeff()
                              : extents<3>(outline<3>(body)).sizes().maxCoeff();
}

}  // namespace

Expectations expectations_of(const Scene& scene) {
  Expectations expected;
  expected.contact = scene.contact.has_value();
  expected.end = scene.time.end;
  if (scene.gravity) expected.gravity = std::max(0., -scene.gravity->acceleration[scene.dimension - 1]);
  const auto group = groups_of(scene);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const auto& body = scene.bodies[i];
    if (body.makes_waves) continue;
    auto& entry = expected.bodies[body.name];
    entry.free = body.becomes_free();
    entry.moves = moves(body);
    entry.length = length_of(scene, body);
    for (std::size_t k = 0; k < scene.bodies.size(); ++k)
      if (k != i && group[k] == group[i]) entry.tied.push_back(scene.bodies[k].name);
    if (!body.path.empty() && !body.release)
      expected.path_ends_at = std::max(expected.path_ends_at, body.path.back().time);
  }
  return expected;
}

}  // namespace splashdown::apps
