#include "fluid/effects/waves/wavemaker.hpp"

#include <cmath>

namespace splashdown::fluid {

// Numerators and denominators times 2 exp(-2kd), so that nothing overflows.
double height_over_stroke(Paddle paddle, double kd) {
  const double q = std::exp(-kd), e = q * q, below = 1 - e * e + 4 * kd * e;
  if (paddle == Paddle::piston) return 2 * (1 - e) * (1 - e) / below;
  return 2 * (1 - e) / kd * (kd * (1 - e) - (1 + e) + 2 * q) / below;
}

}  // namespace splashdown::fluid
