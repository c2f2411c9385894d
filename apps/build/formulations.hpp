// What the formulations that a scene may name are made of.
#pragma once

#include "apps/scene/scene.hpp"
#include "fluid/pfem/formulations.hpp"

namespace splashdown::apps {

/// Of the scene's fluid.
template <int d>
fluid::Formulation<d> formulation(const Fluid& fluid);

}  // namespace splashdown::apps
