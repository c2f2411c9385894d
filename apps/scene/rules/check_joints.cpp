#include <fmt/format.h>

#include "apps/scene/kinds/joint_kinds.hpp"
#include "apps/scene/rules/check.hpp"
#include "apps/scene/rules/rules.hpp"

namespace splashdown::apps {

void check_joints(const Scene& scene, const SceneLabels& labels, Problems& problems) {
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    const auto& joint = scene.joints[i];
    const auto& label = labels.joints[i];
    const auto& body = scene.bodies[joint.body];
    if (joint.other == joint.body)
      problems.add(label + ".other", "a body cannot be tied to itself",
                   "Name another body, or leave it out for a joint to the world.");
    const bool moves = body.becomes_free() || (joint.other && scene.bodies[*joint.other].becomes_free());
    if (!moves)
      problems.add(label + ".body",
                   fmt::format("the joint moves nothing: '{}' is not free, nor is what it is tied to", body.name),
                   "Remove the joint, or free a body.");
    if (joint.axis.isZero(0) && !problems.found_in(label + ".axis"))
      problems.add(label + ".axis", "must have a direction", "Use e.g. " + axis_example(scene.dimension, 1) + ".");
    const auto& kind = kind_of(joint);
    const std::string in_degrees(kind.in_degrees());
    const auto& limits = joint.limits;
    if (!limits.empty() && !(limits.size() == 2 && limits[0] <= 0 && limits[1] >= 0))
      problems.add(label + ".limits" + in_degrees, "must be two numbers around 0, the place at t = 0",
                   kind.turns ? "Use e.g. [-30.0, 45.0]." : "Use e.g. [-0.1, 0.3].");
    if (joint.rest != 0 && joint.stiffness == 0)
      problems.add(label + ".rest" + in_degrees, "there is no spring that could be relaxed",
                   "Add a stiffness, or remove it.");
  }
}

}  // namespace splashdown::apps
