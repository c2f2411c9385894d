// Drag coefficients of shapes, on their projected area, in steady flow at the Reynolds numbers of landings (1e4 to 3e5).
#pragma once

#include "apps/scene/scene.hpp"

namespace splashdown::apps {

struct ShapeDrag {
  double coefficient;
  bool round;  ///< no edges at which the flow would leave at once
};

/// Hoerner, Fluid-Dynamic Drag (1965), chapter 3.
ShapeDrag shape_drag(const Shape& shape);

}  // namespace splashdown::apps
