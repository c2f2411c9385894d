#include <fmt/format.h>

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
    const bool moves =
        body.motion == Motion::free || (joint.other && scene.bodies[*joint.other].motion == Motion::free);
    if (!moves)
      problems.add(label + ".body",
                   fmt::format("the joint moves nothing: '{}' is not free, nor is what it is tied to", body.name),
                   "Remove the joint, or free a body.");
    if (joint.axis.isZero(0) && !problems.found_in(label + ".axis"))
      problems.add(label + ".axis", "must have a direction", "Use e.g. " + axis_example(scene.dimension, 1) + ".");
  }
}

}  // namespace splashdown::apps
