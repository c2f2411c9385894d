#include "apps/scene/read/parts.hpp"

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
    reader.point("point", joint.point,
                 any("m", "Use the place of the hinge at t = 0, e.g. " + axis_example(scene.dimension, 0.5) + "."),
                 Need::required);
  const bool slides = joint.type == "slider", turns_in_space = joint.type == "hinge" && scene.dimension == 3;
  if (slides || turns_in_space) {
    joint.axis = Point::Zero();
    const std::string what = slides ? "direction of the motion" : "axis that it turns about";
    reader.point("axis", joint.axis, any("", "Use the " + what + ", e.g. " + axis_example(scene.dimension, 1) + "."),
                 Need::required);
  }
  return body ? std::optional(joint) : std::nullopt;
}

}  // namespace splashdown::apps
