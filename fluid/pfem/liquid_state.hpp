// What pressure makes of a liquid.
#pragma once

namespace splashdown::fluid {

/// Of a liquid that gives way, against what it is where the pressure is 0.
struct LiquidState {
  double density = 1;     ///< over that of the liquid at rest
  double compliance = 0;  ///< d ln(density) / dp [1/Pa]
  double energy = 0;      ///< that pressure and the air around have put into a volume at rest of 1 [Pa]
};

}  // namespace splashdown::fluid
