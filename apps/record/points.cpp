#include "apps/record/points.hpp"

namespace splashdown::apps {

void PointReadings::read(const Kick& kick, std::vector<double> pressures) {
  pressures_ = std::move(pressures);
  for (std::size_t i = 0; i < pressures_.size(); ++i) {
    peaks_[i].offer(pressures_[i], kick.time);
    if (histories_[i].ends.empty()) histories_[i] = {1, kick.begin, {}, {}};
    histories_[i].append(kick.end, {&pressures_[i], 1});
  }
}

}  // namespace splashdown::apps
