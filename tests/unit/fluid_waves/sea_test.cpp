#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "fluid/effects/waves/dispersion.hpp"
#include "fluid/effects/waves/spectrum.hpp"
#include "fluid/effects/waves/wave_field.hpp"

namespace splashdown::fluid::sea_test {
namespace {

constexpr double pi = std::numbers::pi;

// Moment of the density, by the midpoint rule.
double moment(int order, double peak_period, double gamma) {
  double sum = 0;
  constexpr double dw = 0.03;
  for (double w = 0.5 * dw; w < 60; w += dw) sum += std::pow(w, order) * spectral_density(w, peak_period, gamma) * dw;
  return sum;
}

TEST(Spectrum, moments_are_those_of_pierson_and_moskowitz) {
  const double peak = 2 * pi / 3.0;
  EXPECT_NEAR(moment(0, 3, 1), 1, 1e-4);
  EXPECT_NEAR(moment(1, 3, 1), std::pow(1.25, 0.25) * std::tgamma(0.75) * peak, 1e-3 * peak);
  EXPECT_NEAR(moment(2, 3, 1), std::sqrt(1.25 * pi) * peak * peak, 5e-3 * peak * peak);
}

// T_z = sqrt(m_0 / m_2) over T_p after DNV-RP-C205 (2010), 3.5.5.4; a fit.
TEST(Spectrum, zero_crossing_period_of_jonswap) {
  for (double gamma : {1.0, 2.0, 3.3, 5.0}) {
    const double fit = 0.6673 + 0.05037 * gamma - 0.006230 * gamma * gamma + 0.0003341 * gamma * gamma * gamma;
    EXPECT_NEAR(2 * pi * std::sqrt(moment(0, 3, gamma) / moment(2, 3, gamma)) / 3, fit, 0.01 * fit);
  }
}

double energy_of(const std::vector<SeaWave>& waves) {
  double sum = 0;
  for (const SeaWave& wave : waves) sum += 0.5 * wave.amplitude * wave.amplitude;
  return sum;
}

TEST(Sea, has_its_height_its_period_and_its_seed) {
  const SpectrumSpec spec{.significant_height = 0.2, .peak_period = 2};
  const auto waves = sea_waves(spec);
  EXPECT_NEAR(energy_of(waves), 0.2 * 0.2 / 16, 1e-15);
  const auto highest = std::ranges::max_element(waves, {}, &SeaWave::amplitude);
  EXPECT_NEAR(highest->angular_frequency, pi, 0.02 * pi);
  auto other = spec;
  other.seed = 2;
  EXPECT_NE(sea_waves(other)[3].phase, waves[3].phase);
  other = spec;
  other.spreading = 10;
  EXPECT_EQ(sea_waves(other)[3].phase, waves[3].phase);
  EXPECT_EQ(waves[3].direction, 0);
  // The generator of the standard: 10000 numbers after its own seed it gives 9981545732273789042.
  auto long_sea = spec;
  long_sea.seed = 5489, long_sea.repeat = 2500;
  EXPECT_EQ(sea_waves(long_sea).at(4999).direction, 0);
  long_sea.spreading = 1e-9;  // all directions alike
  EXPECT_NEAR(sea_waves(long_sea).at(4999).direction,
              pi * (2 * (0x1p-64 * static_cast<double>(9981545732273789042u)) - 1), 0.02);
}

// The mean of exp(i angle) over cos^2s(angle / 2) is s / (s + 1).
TEST(Sea, directions_spread_as_asked) {
  for (double s : {2.0, 10.0, 50.0}) {
    const auto waves =
        sea_waves({.significant_height = 1, .peak_period = 5, .spreading = s, .seed = 4, .repeat = 3000});
    std::complex<double> mean = 0;
    for (const SeaWave& wave : waves) mean += std::polar(1.0, wave.direction) / static_cast<double>(waves.size());
    const double scatter = 1 / std::sqrt(static_cast<double>(waves.size()));
    EXPECT_NEAR(mean.real(), s / (s + 1), 3 * scatter);
    EXPECT_NEAR(mean.imag(), 0, 3 * scatter);
  }
}

TEST(Sea, surface_has_the_heights_of_its_spectrum_over_the_time_that_it_repeats_in) {
  const SpectrumSpec spec{.significant_height = 0.2, .peak_period = 2, .repeat = 40};
  SeaFrame<2> frame{.origin = {0.3, 0.7}, .depth = 3};
  const LinearSea<2> sea(sea_waves(spec), frame, 2, 0, 0.2);
  double sum = 0, square = 0;
  constexpr int samples = 2000;
  for (int i = 0; i < samples; ++i) {
    const double e = sea.elevation(Vec<2>(1.7, 0), 80.0 * i / samples);
    sum += e / samples, square += e * e / samples;
  }
  EXPECT_NEAR(sum, 0, 1e-12);
  EXPECT_NEAR(4 * std::sqrt(square), 0.2, 1e-10);
  EXPECT_NEAR(sea.elevation(Vec<2>(1.7, 0), 80.5), sea.elevation(Vec<2>(1.7, 5), 0.5), 1e-12);
}

// At the still level the surface rises with the water, and the field below is a potential's.
TEST(Sea, speeds_are_those_of_linear_waves_in_the_plane_and_in_space) {
  SeaFrame<3> frame{.origin = {0.1, -0.4, 0.2}, .direction = Vec<3>(0.6, 0.8, 0), .time = 0.4, .depth = 1.2};
  const LinearSea<3> sea(sea_waves({.significant_height = 0.1, .peak_period = 1.5, .spreading = 5}), frame, 1.5, 0,
                         0.1);
  constexpr double e = 1e-5;
  const Vec<3> at(0.7, 0.2, 0.2);
  EXPECT_NEAR(sea.velocity(at, 2).z(), (sea.elevation(at, 2 + e) - sea.elevation(at, 2 - e)) / (2 * e), 1e-8);
  const Vec<3> below(0.7, 0.2, -0.1);
  Mat<3> slope;
  for (int k = 0; k < 3; ++k)
    slope.col(k) =
        (sea.velocity(below + e * Vec<3>::Unit(k), 2) - sea.velocity(below - e * Vec<3>::Unit(k), 2)) / (2 * e);
  EXPECT_NEAR(slope.trace(), 0, 1e-8);
  EXPECT_NEAR((slope - slope.transpose()).norm(), 0, 1e-8);
  EXPECT_EQ(sea.velocity(Vec<3>(0, 0, -1.0), 1).z(), 0);
}

TEST(Sea, focused_group_has_its_crest_where_and_when_it_is_wanted) {
  SeaFrame<2> frame{.origin = {2, 1}, .time = 5, .depth = 4};
  const LinearSea<2> group(focused_waves({.peak_period = 1.6}, 0.15), frame, 1.6, 0, 0.15);
  EXPECT_NEAR(group.elevation(Vec<2>(2, 0), 5), 0.15, 1e-12);
  for (double t : {-10.0, 0.0, 4.7, 5.3, 12.0}) EXPECT_LT(std::abs(group.elevation(Vec<2>(2, 0), t)), 0.149);
  EXPECT_NEAR(group.phase(Vec<2>(2, 0), 5), 0, 1e-12);
}

TEST(RegularWave, phase_counts_from_the_crest_that_has_passed) {
  const SteadyWave wave = stream_function_wave({.height = 0.1, .length = 2, .depth = 1});
  const SeaFrame<2> frame{.origin = {3, 0.5}, .direction = Vec<2>(-1, 0), .time = 0.2, .depth = 1};
  const RegularWave<2> field(wave, frame);
  const double period = field.period();
  EXPECT_NEAR(field.elevation(Vec<2>(3, 0), 0.2), wave.crest(), 1e-12);
  EXPECT_NEAR(field.elevation(Vec<2>(4, 0), 0.2), wave.trough(), 1e-12);
  EXPECT_NEAR(field.phase(Vec<2>(3, 0), 0.2 + 0.25 * period), 0.5 * pi, 1e-9);
  EXPECT_NEAR(field.elevation(Vec<2>(2.5, 0), 0.2 + 0.25 * period), wave.crest(), 1e-9);  // it runs to the left
  EXPECT_LT(field.velocity(Vec<2>(3, 0.5), 0.2).x(), 0);
}

}  // namespace
}  // namespace splashdown::fluid::sea_test
