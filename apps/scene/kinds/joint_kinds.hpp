// The joints that a scene may name: a row each.
#pragma once

#include <span>
#include <string_view>

#include "apps/scene/scene.hpp"
#include "rigid/joint.hpp"

namespace splashdown::apps {

/// What a type of joint is, for those who read, check, tell and build it.
struct JointKind {
  std::string_view name;                          ///< its type in a scene
  rigid::JointType type;                          ///< of the bodies' room
  bool turns = false;                             ///< moves by an angle: limits and rest are degrees
  bool slides = false;                            ///< moves along its axis
  bool moves() const { return turns || slides; }  ///< has limits, a spring, a damper
  std::string_view in_degrees() const { return turns ? "_deg" : ""; }  ///< end of its keys
};

/// All of them, in the order in which messages name them.
std::span<const JointKind> joint_kinds();
/// Of a joint that was read.
const JointKind& kind_of(const Joint& joint);

}  // namespace splashdown::apps
