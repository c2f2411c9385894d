#include "apps/scene/kinds/joint_kinds.hpp"

#include <algorithm>
#include <stdexcept>

namespace splashdown::apps {

std::span<const JointKind> joint_kinds() {
  static constexpr JointKind kinds[] = {{.name = "hinge", .type = rigid::JointType::hinge, .turns = true},
                                        {.name = "slider", .type = rigid::JointType::slider, .slides = true},
                                        {.name = "weld", .type = rigid::JointType::weld}};
  return kinds;
}

const JointKind& kind_of(const Joint& joint) {
  const auto kinds = joint_kinds();
  const auto found = std::ranges::find(kinds, joint.type, &JointKind::name);
  if (found == kinds.end()) throw std::logic_error("no joint is called '" + joint.type + "'");
  return *found;
}

std::vector<std::string> joint_names() {
  std::vector<std::string> names;
  for (const auto& kind : joint_kinds()) names.emplace_back(kind.name);
  return names;
}

}  // namespace splashdown::apps
