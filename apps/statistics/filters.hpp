// Channel frequency class filters of SAE J211-1 (2014), appendix C, for accelerations with uneven time steps.
//
//   two-pole Butterworth, design frequency 2.0775 CFC, run forward and backward (no phase shift):
//   |H|^2 = 1 / (1 + (f / 2.0775 CFC)^4) in total, -3 dB at CFC / 0.6
//
// The histories are averages over consecutive intervals. They are brought to equal intervals by averaging
// again, which keeps the velocity change exactly. Outside the record the first and last value are held.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "apps/scene/channel_classes.hpp"

namespace splashdown::apps {

/// Interval averages of a few channels (the components of a vector): interval i ends at ends[i] and begins
/// where the one before ended; values holds `channels` numbers an interval.
struct IntervalHistory {
  int channels = 0;
  double begin = 0;
  std::vector<double> ends;
  std::vector<double> values;

  void append(double end, std::span<const double> sample);
  double begin_of(std::size_t i) const { return i == 0 ? begin : ends[i - 1]; }
  double middle_of(std::size_t i) const { return 0.5 * (begin_of(i) + ends[i]); }
  double magnitude(std::size_t i) const;  ///< of the vector of an interval
  template <class Archive>
  void serialize(Archive& archive) {
    archive(channels, begin, ends, values);
  }
};

/// Filters equally spaced samples, `dt` apart [s].
std::vector<double> cfc_filter(std::span<const double> samples, double dt, int cfc);

/// One channel averaged over equal intervals of length `dt` from history.begin on.
std::vector<double> resample(const IntervalHistory& history, int channel, double dt);

/// All channels filtered, at equal intervals, with a margin of 1/CFC before and after the record in which the filters still
/// answer to it. Nothing if the record is shorter than 1/CFC, or so long that it would be
/// more than 2e7 samples of all channels.
std::optional<IntervalHistory> filtered(const IntervalHistory& history, int cfc);

/// Whether the record is sampled as J211 asks for, 10 CFC times a second, within 1/CFC of a time.
bool fine_enough(const IntervalHistory& history, int cfc, double time);

/// What means over the longest step T within 1/CFC of a time take from the highest frequency that the filter lets through,
/// f = CFC/0.6: 1 - sin(pi f T)/(pi f T), 4.5 % with the longest steps that J211 allows; 1 from f T = 1 on.
double lost_to_steps(const IntervalHistory& history, int cfc, double time);

/// Largest second difference of the means over three intervals in a row within 1/CFC of a time [unit of the channels]; of uneven ones twice
/// the deviation of the middle one from the straight line through the others. What means take from a peak is no more: of a
/// sine it is a 24th of that, of a pulse within one interval or two all of the peak. Infinite with fewer than three.
double roughness(const IntervalHistory& history, int cfc, double time);

}  // namespace splashdown::apps
