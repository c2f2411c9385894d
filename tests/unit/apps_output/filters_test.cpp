#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "apps/statistics/pulse.hpp"

namespace splashdown::apps::filters_test {
namespace {

std::vector<double> sine(double frequency, double dt, std::size_t count) {
  std::vector<double> samples;
  for (std::size_t i = 0; i < count; ++i)
    samples.push_back(std::sin(2 * std::numbers::pi * frequency * static_cast<double>(i) * dt));
  return samples;
}

/// Amplitude in the middle half of a record, from the mean square of a sine.
double amplitude(const std::vector<double>& samples) {
  double sum = 0;
  const std::size_t begin = samples.size() / 4, end = 3 * samples.size() / 4;
  for (std::size_t i = begin; i < end; ++i) sum += samples[i] * samples[i];
  return std::sqrt(2 * sum / static_cast<double>(end - begin));
}

/// Gain of forward and backward pass together at a frequency; the record has whole periods in its middle
/// half.
double gain(double frequency, int cfc) {
  const double dt = 1.0 / (200.0 * cfc);
  const auto count = static_cast<std::size_t>(std::lround(80 / (frequency * dt)));
  return amplitude(cfc_filter(sine(frequency, dt, count), dt, cfc));
}

class EachClass : public testing::TestWithParam<int> {};

// |H|^2 = 1 / (1 + (f / 2.0775 CFC)^4) for both passes together.
TEST_P(EachClass, gain_is_that_of_two_butterworth_passes) {
  const int cfc = GetParam();
  for (const double ratio : {0.1, 0.5, 1.0, 1.0 / 0.6, 2.0775, 4.0}) {
    const double law = 1 / (1 + std::pow(ratio / 2.0775, 4));
    // The bilinear transform moves frequencies by (pi f dt)^2 / 3 of themselves: 1e-3 at 4 CFC, four times in
    // the gain; the period count of the mean square adds 1e-3.
    EXPECT_NEAR(gain(ratio * cfc, cfc), law, 5e-3 * law) << "f / CFC = " << ratio;
  }
}

// SAE J211-1, table of limits: -3 dB at CFC / 0.6; pass band within +0.5, -1 dB up to CFC.
TEST_P(EachClass, pass_band_and_cut_off_are_those_of_j211) {
  const int cfc = GetParam();
  const auto decibel = [&](double ratio) { return 20 * std::log10(gain(ratio * cfc, cfc)); };
  EXPECT_NEAR(decibel(0.1), 0, 0.02);
  EXPECT_LT(decibel(1.0), 0.5);
  EXPECT_GT(decibel(1.0), -1.0);
  EXPECT_NEAR(decibel(1 / 0.6), -3.01, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Cfc, EachClass, testing::ValuesIn(channel_frequency_classes));

TEST(Cfc, a_pulse_is_not_shifted_in_time) {
  const double dt = 1e-5;
  std::vector<double> pulse;
  for (int i = 0; i <= 4000; ++i) pulse.push_back(std::exp(-std::pow((i - 2000) * dt / 2e-3, 2)));
  const auto filtered = cfc_filter(pulse, dt, 180);
  EXPECT_EQ(std::max_element(filtered.begin(), filtered.end()) - filtered.begin(), 2000);
}

TEST(Cfc, a_constant_stays_as_it_is) {
  // Coefficients of size wa^2 = (pi 2.0775 60 1e-5)^2 = 1.5e-5 leave eps / wa^2 = 1.5e-11 of rounding.
  for (const double value : cfc_filter(std::vector<double>(500, 3.5), 1e-5, 60)) EXPECT_NEAR(value, 3.5, 1e-9);
}

TEST(Resampling, keeps_the_velocity_change_of_uneven_steps) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> step(1e-4, 2e-3), value(-50, 50);
  IntervalHistory history{1, 0.5, {}, {}};
  double end = 0.5, change = 0;
  for (int i = 0; i < 400; ++i) {
    const double length = step(random), a = value(random);
    end += length;
    change += a * length;
    history.append(end, std::array{a});
  }
  const std::size_t bins = 10000;
  const double dt = (end - 0.5) / bins;
  const auto samples = resample(history, 0, dt);
  ASSERT_EQ(samples.size(), bins);
  double sum = 0;
  for (const double sample : samples) sum += sample * dt;
  EXPECT_NEAR(sum, change, 1e-12 * 50 * end * bins);  // k eps scale, k = number of sums
}

IntervalHistory half_sine_pulse(double duration, double dt) {
  IntervalHistory history{2, 0, {}, {}};
  for (int i = 0; i * dt < 10 * duration; ++i) {
    const double t = (i + 0.5) * dt - 4 * duration;
    const double a = t > 0 && t < duration ? 100 * std::sin(std::numbers::pi * t / duration) : 0;
    history.append((i + 1) * dt, std::array{0.6 * a, 0.8 * a});
  }
  return history;
}

TEST(Peaks, a_slow_pulse_keeps_its_height_and_instant_in_all_classes) {
  const auto peaks = filtered_pulses(half_sine_pulse(0.05, 5e-5));  // 10 Hz
  ASSERT_EQ(peaks.size(), 4u);
  for (const auto& [cfc, peak] : peaks) {
    // f / 2.0775 CFC <= 0.08: the gain is one to 4e-5, the pulse's corners add harmonics.
    EXPECT_NEAR(peak.value, 100, 0.5) << cfc;
    EXPECT_NEAR(peak.time, 0.225, 1e-3) << cfc;
  }
}

TEST(Peaks, a_lower_class_gives_a_lower_peak) {
  const auto peaks = filtered_pulses(half_sine_pulse(0.002, 2e-5));
  ASSERT_EQ(peaks.size(), 4u);
  EXPECT_LT(peaks.at(60).value, peaks.at(180).value);
  EXPECT_LT(peaks.at(180).value, peaks.at(600).value);
  EXPECT_LE(peaks.at(600).value, peaks.at(1000).value * 1.05);
}

// J211 asks for a sampling rate of ten times the class: 3 kHz allow CFC 60 and 180 only.
TEST(Peaks, classes_beyond_the_sampling_rate_are_absent) {
  const auto peaks = filtered_pulses(half_sine_pulse(0.05, 1.0 / 3000));
  EXPECT_TRUE(peaks.contains(60));
  EXPECT_TRUE(peaks.contains(180));
  EXPECT_FALSE(peaks.contains(600));
  EXPECT_FALSE(peaks.contains(1000));
}

// In CFC 60 long steps cost accuracy, and the peak says how much.
TEST(Peaks, of_structures_are_there_however_long_the_steps_are) {
  const double step = 0.01;
  const auto record = half_sine_pulse(0.05, step);
  const auto peaks = filtered_pulses(record);
  ASSERT_TRUE(peaks.contains(60));
  EXPECT_EQ(peaks.size(), 1u);
  const double lost = lost_to_steps(record, 60, peaks.at(60).time);
  EXPECT_NEAR(lost, 1, 1e-12);  // a step as long as the period of the cut-off frequency
}

// A sine at the cut-off frequency, averaged over the steps of the record and brought back as steps: its part of that frequency.
TEST(Filters, what_steps_take_is_what_their_means_lack_of_the_cut_off_frequency) {
  const int cfc = 60;
  const double f = cfc / 0.6, pi = std::numbers::pi;
  for (const double samples : {4., 6., 10., 40.}) {
    const double step = 1 / (samples * f);
    IntervalHistory record{1, 0, {}, {}};
    double in_phase = 0, whole = 0;  // with the sine, of the steps and of itself
    for (int i = 0; i < 10 * static_cast<int>(samples); ++i) {
      const double begin = i * step, end = begin + step;
      const double mean = (std::cos(2 * pi * f * begin) - std::cos(2 * pi * f * end)) / (2 * pi * f * step);
      record.append(end, std::array{mean});
      in_phase += mean * mean * step;
      whole += 0.5 * step;
    }
    const double kept = 1 - lost_to_steps(record, cfc, 0.05);
    EXPECT_NEAR(in_phase, kept * kept * whole, 1e-12) << samples;
  }
}

TEST(Filters, a_record_too_long_to_be_resampled_has_no_class) {
  const IntervalHistory day{1, 0, {86400}, {1}};
  EXPECT_FALSE(filtered(day, 60).has_value());
  const IntervalHistory minute{1, 0, {60}, {1}};
  EXPECT_TRUE(filtered(minute, 60).has_value());
}

TEST(Peaks, an_empty_record_has_none) { EXPECT_TRUE(filtered_pulses({}).empty()); }

/// Means of a half sine of a duration over equal steps, from -1/60 s on.
IntervalHistory half_sine(double duration, double step, double phase) {
  IntervalHistory history{1, -0.05 - phase * step, {}, {}};
  const auto integral = [=](double t) {
    t = std::clamp(t, 0., duration);
    return duration / std::numbers::pi * (1 - std::cos(std::numbers::pi * t / duration));
  };
  for (double begin = history.begin; begin < duration + 0.05;) {
    const double end = begin + step, mean = (integral(end) - integral(begin)) / step;
    history.append(end, {&mean, 1});
    begin = end;
  }
  return history;
}

double filtered_peak(const IntervalHistory& history) {
  return std::ranges::max(filtered(history, structures_class)->values);
}

// 2e-3: of the filter's own sampling.
TEST(Sampling, bounds_what_means_over_steps_take_from_a_filtered_peak) {
  const double skirt = std::pow(2.0775 * 0.6, 2);  // of the frequency that is halved over the one at -3 dB
  double widest = 0;
  for (const double duration : {0.005, 0.01, 0.02, 0.05, 0.1, 0.3})
    for (const double step : {0.0005, 0.0017, 0.004, 0.01, 0.02, 0.04})
      for (const double phase : {0.1, 0.4, 0.7}) {
        const auto history = half_sine(duration, step, phase);
        const double top = filtered_peak(history), truth = filtered_peak(half_sine(duration, 1e-4, 0));
        const double share = std::min(roughness(history, structures_class, duration / 2) / top,
                                      lost_to_steps(history, structures_class, duration / 2));
        EXPECT_LE(truth - top, (skirt * share + 2e-3) * truth) << duration << " s in steps of " << step;
        widest = std::max(widest, share);
      }
  EXPECT_GT(widest, 0.5) << "pulses shorter than a step are not known";
}

TEST(Sampling, costs_nothing_where_nothing_is_quick) {
  for (const double step : {0.01, 0.05, 0.2}) {
    IntervalHistory rest{2, 0, {}, {}}, bob{1, 0, {}, {}};
    for (int n = 1; n <= 200; ++n) {
      const std::array load = {1e-12 * (n % 7), 1962.};
      rest.append(n * step, load);
      const double heave = 1962 + 300 * std::sin(2 * std::numbers::pi * n / 60);  // sixty steps a period
      bob.append(n * step, {&heave, 1});
    }
    EXPECT_LT(roughness(rest, structures_class, 100 * step) / 1962, 1e-13);
    EXPECT_LT(roughness(bob, structures_class, 100 * step) / 300, 1.01 * std::pow(2 * std::numbers::pi / 60, 2));
  }
}

}  // namespace
}  // namespace splashdown::apps::filters_test
