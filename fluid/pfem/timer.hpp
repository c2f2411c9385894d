// Seconds per phase of a step; always on.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/stopwatch.hpp"

namespace splashdown::fluid {

/// A sum of wall-clock seconds for each phase, by its number.
class PhaseTimer {
 public:
  /// Phases are known by their number from here on.
  explicit PhaseTimer(std::vector<std::string> phases) {
    for (auto& p : phases) seconds_.emplace_back(std::move(p), 0.0);
  }
  /// Its number is that of the phases before it.
  void add(std::string phase) { seconds_.emplace_back(std::move(phase), 0.0); }
  /// Charges the time until the scope's end to a phase.
  Stopwatch scope(std::size_t phase) { return Stopwatch(seconds_[phase].second); }
  /// Names and seconds of all phases.
  const std::vector<std::pair<std::string, double>>& seconds() const { return seconds_; }

 private:
  std::vector<std::pair<std::string, double>> seconds_;
};

}  // namespace splashdown::fluid
