// What probes of pressure read in every step: peaks and histories. Survives a resume.
#pragma once

#include <vector>

#include "apps/record/settings.hpp"
#include "apps/statistics/statistics.hpp"
#include "apps/statistics/statistics_archive.hpp"
#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

class PointReadings {
 public:
  explicit PointReadings(std::size_t points) : peaks_(points), histories_(points) {}

  /// The pressures of all points in a step [Pa].
  void read(const Kick& kick, std::vector<double> pressures);
  /// Of the step read last [Pa].
  const std::vector<double>& pressures() const { return pressures_; }
  const Peak& peak(std::size_t point) const { return peaks_[point]; }
  const IntervalHistory& history(std::size_t point) const { return histories_[point]; }

  /// Whether what was loaded is of so many points.
  bool fits(std::size_t points) const { return peaks_.size() == points && histories_.size() == points; }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(peaks_, histories_);
  }

 private:
  std::vector<Peak> peaks_;
  std::vector<IntervalHistory> histories_;
  std::vector<double> pressures_;
};

}  // namespace splashdown::apps
