#include "apps/scene_parts.hpp"

namespace splashdown::apps {

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
