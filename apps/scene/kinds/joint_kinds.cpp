#include "apps/scene/kinds/joint_kinds.hpp"

#include "apps/scene/kinds/named.hpp"

namespace splashdown::apps {

std::span<const JointKind> joint_kinds() {
  static constexpr JointKind kinds[] = {{.name = "hinge", .type = rigid::JointType::hinge, .turns = true},
                                        {.name = "slider", .type = rigid::JointType::slider, .slides = true},
                                        {.name = "weld", .type = rigid::JointType::weld}};
  return kinds;
}

const JointKind& kind_of(const Joint& joint) { return named(joint_kinds(), joint.type); }

}  // namespace splashdown::apps
