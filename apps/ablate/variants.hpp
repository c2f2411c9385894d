// What an ablation makes of a scene.
#pragma once

#include <string>
#include <vector>

#include "apps/ablate/plan.hpp"

namespace splashdown::apps {

struct SceneToAblate {
  const Scene& scene;
  const std::string& resolved;  ///< TOML
  std::string name;             ///< in messages
  bool all = false;             ///< effects are added whatever is advised
};

/// The scene as it is first, then without each effect, then with each one that is advised, those advised `on` before doubtful ones,
/// then its choices: slip of walls, freedoms of bodies, size of the tank, half of a symmetric scene.
std::vector<Variant> variants_of(const SceneToAblate& of);

}  // namespace splashdown::apps
