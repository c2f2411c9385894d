// Sizes that a scene does not name, written into its TOML before it is read: what is chosen and what is written out are the
// same scene, bit for bit.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "apps/scene/scene.hpp"

namespace splashdown::apps {

/// Whether the scene leaves its sizes to the program: it has liquid and no fluid.size.surface.
bool sizes_are_open(const toml::table& root);
/// Adds what is absent of sizes; `read`: the scene as far as it is known. What was chosen and why, a line each.
std::vector<std::string> fill_sizes(toml::table& root, const Scene& read);

}  // namespace splashdown::apps
