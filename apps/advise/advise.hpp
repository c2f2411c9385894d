// What theory says of all effects in a scene, those that it has, those that it could have and those that do not exist yet.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/scene/outlook/advice.hpp"
#include "apps/scene/outlook/outlook.hpp"

namespace splashdown::apps {

class EffectKind;

struct AdvisedEffect {
  std::string name;
  bool available = true;             ///< a scene can have it
  bool present = false;              ///< this one has
  const EffectKind* kind = nullptr;  ///< null: not available
  Advice advice;
};

struct SceneAdvice {
  std::vector<AdviceNumber> numbers;  ///< of the scene as a whole
  std::string entry;                  ///< how its fastest body meets the water, in words; empty: none does
  std::vector<AdvisedEffect> effects;
};

template <int d>
SceneAdvice advice_of(const Scene& scene);
/// The same, whatever its dimension.
SceneAdvice advice_of(const Scene& scene);

}  // namespace splashdown::apps
