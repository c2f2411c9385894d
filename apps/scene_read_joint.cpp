#include <algorithm>

#include "apps/scene_parts.hpp"

namespace splashdown::apps {

std::optional<std::size_t> read_body_name(Reader& reader, std::string_view key, const Scene& scene, Need need,
                                          const std::string& what) {
  std::vector<std::string> names;
  for (const auto& body : scene.bodies) names.push_back(body.name);
  if (need == Need::optional && !reader.holds(key)) {
    reader.skip(key);
    return {};
  }
  std::string name;
  if (reader.context().problems.found_in("body")) {  // first things first: the names may be wrong
    reader.text(key, name, "Use the name of a body.", need);
    return {};
  }
  if (names.empty()) {
    reader.text(key, name, "Use the name of a body.", need);
    reader.context().problems.add(reader.key(key), "the scene has no bodies",
                                  "Add [[body]] or remove the " + what + ".");
    return {};
  }
  reader.choice(key, name, names, need);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return {};
  return static_cast<std::size_t>(found - names.begin());
}

std::optional<Joint> read_joint(Reader& reader, const Scene& scene) {
  Joint joint;
  if (!reader.choice("type", joint.type, {"hinge", "slider", "weld"}, Need::required)) {
    reader.skip_all();
    return {};
  }
  const auto body = read_body_name(reader, "body", scene, Need::required, "joint");
  joint.body = body.value_or(0);
  joint.other = read_body_name(reader, "other", scene, Need::optional, "joint");
  if (joint.type == "hinge")
    reader.point("point", joint.point, any("m", "Use the place of the hinge at t = 0, e.g. [0.0, 0.5]."), Need::required);
  if (joint.type == "slider") {
    joint.axis = Point::Zero();
    reader.point("axis", joint.axis, any("", "Use the direction of the motion, e.g. [0.0, 1.0]."), Need::required);
  }
  return body ? std::optional(joint) : std::nullopt;
}

}  // namespace splashdown::apps
