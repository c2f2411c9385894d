// What a program adds to a scene's world besides what the scene says.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "rigid/forces/force.hpp"

namespace splashdown::apps {

template <int d>
struct Hooks {
  std::vector<std::unique_ptr<rigid::Force<d>>> forces;
  /// Of prescribed bodies by name: the pose of the centre of mass at a time, instead of the scene's path.
  std::map<std::string, std::function<rigid::Isometry<d>(double)>> paths;
};

}  // namespace splashdown::apps
