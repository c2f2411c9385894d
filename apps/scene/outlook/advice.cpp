#include "apps/scene/outlook/advice.hpp"

#include <algorithm>
#include <cmath>

namespace splashdown::apps {

const char* word(Advised advised) {
  return advised == Advised::on ? "on" : advised == Advised::off ? "off" : "doubtful";
}

Advised judged(double change) {
  if (std::abs(change) >= trust * least_change) return Advised::on;
  return std::abs(change) <= least_change / trust ? Advised::off : Advised::doubtful;
}

Advised judged(const ExpectedChange& change) {
  return std::max(judged(change.peak.value_or(0)), judged(change.motion.value_or(0)));
}

}  // namespace splashdown::apps
