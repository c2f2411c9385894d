// The hull that `splashdown new` is given: a file, as it is or repaired and turned, or a shape by its numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/new/options.hpp"
#include "apps/scene/scene.hpp"
#include "core/types.hpp"

namespace splashdown::apps {

struct NewHull {
  std::string name;                 ///< of body and folder
  Shape shape;                      ///< with its surface
  std::string toml;                 ///< its keys in the scene; of a file all but its name
  std::optional<Surface<3>> write;  ///< a file that is written beside the scene, in units of the given one
  std::vector<Assumption> told;
};

/// Throws NewError.
NewHull new_hull(const NewOptions& options);

}  // namespace splashdown::apps
