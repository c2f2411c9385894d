// The tank of a new scene: large enough, and no larger.
#pragma once

#include "apps/new/measures.hpp"
#include "apps/new/plan.hpp"
#include "apps/scene/outlook/outlook.hpp"

namespace splashdown::apps {

/// By the rule of plan.hpp, with what was assumed. The scene has its end and its hull's place.
template <int d>
void choose_tank(const NewOptions& options, const Measures<d>& m, const Entry& entry, LandingPlan& plan);

}  // namespace splashdown::apps
