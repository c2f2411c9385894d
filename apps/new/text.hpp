// A plan as scene.toml, with what was assumed as comments where it stands.
#pragma once

#include <string>

#include "apps/new/plan.hpp"

namespace splashdown::apps {

/// `file`: of a hull from a file, as the scene names it; empty for shapes.
template <int d>
std::string scene_text(const NewOptions& options, const NewHull& hull, const LandingPlan& plan,
                       const std::string& file);

}  // namespace splashdown::apps
