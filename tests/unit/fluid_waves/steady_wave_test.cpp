#include "fluid/effects/waves/steady_wave.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "fluid/effects/waves/dispersion.hpp"

namespace splashdown::fluid::steady_wave_test {
namespace {

constexpr double pi = std::numbers::pi, g = 9.81, infinity = std::numeric_limits<double>::infinity();

TEST(Dispersion, wave_number_inverts_the_frequency) {
  for (double depth : {1e-3, 0.1, 0.5, 3.0, 100.0, infinity})
    for (double k : {0.01, 0.3, 2.0, 30.0}) {
      const double w = angular_frequency(k, depth, g);
      EXPECT_NEAR(wave_number(w, depth, g), k, 1e-11 * k) << depth;
      const double around = group_velocity(k, depth, g), step = 1e-5 * k;
      EXPECT_NEAR(around, (angular_frequency(k + step, depth, g) - angular_frequency(k - step, depth, g)) / (2 * step),
                  1e-8 * around);
    }
}

TEST(Dispersion, current_shifts_the_frequency_until_it_stops_the_waves) {
  for (double current : {-0.3, 0.0, 0.4}) {
    const double k = wave_number(5, 0.8, g, current);
    EXPECT_NEAR(5 - k * current, angular_frequency(k, 0.8, g), 1e-12 * 5);
  }
  // Deep water: waves of the frequency w stop at U = -g / (4 w).
  const double stops = g / (4 * 5.0);
  EXPECT_NO_THROW(wave_number(5, infinity, g, -0.999 * stops));
  EXPECT_THROW(wave_number(5, infinity, g, -1.001 * stops), std::invalid_argument);
}

// Mean over a period of the flux through a vertical section, over the depth.
double transport(const SteadyWave& wave, double depth) {
  constexpr int phases = 400, pieces = 200;
  double sum = 0;
  for (int i = 0; i < phases; ++i) {
    const double theta = 2 * pi * i / phases, top = wave.elevation(theta), dz = (top + depth) / pieces;
    for (int k = 0; k < pieces; ++k) {
      const auto u = [&](double share) { return wave.speed(theta, -depth + (k + share) * dz).along; };
      sum += dz / 6 * (u(0) + 4 * u(0.5) + u(1)) / phases;
    }
  }
  return sum / depth;
}

// How far psi and Bernoulli's constant vary along the surface, over c d (or c / k) and c^2.
std::pair<double, double> residuals(const SteadyWave& wave) {
  constexpr int points = 97;  // prime: none of the collocation points but the ends
  double kinematic = 0, least = infinity, most = -infinity;
  const double c = wave.celerity();
  for (int i = 0; i <= points; ++i) {
    const double theta = pi * i / points, z = wave.elevation(theta), step = 1e-4;
    const double slope =
        wave.wave_number() * (wave.elevation(theta + step) - wave.elevation(theta - step)) / (2 * step);
    const auto [u, w] = wave.speed(theta, z);
    kinematic = std::max(kinematic, std::abs(w - (u - c) * slope) / c);
    const double head = 0.5 * ((u - c) * (u - c) + w * w) + g * z;
    least = std::min(least, head), most = std::max(most, head);
  }
  return {kinematic, (most - least) / (c * c)};
}

TEST(SteadyWave, surface_is_a_streamline_of_constant_pressure_and_tanks_lose_no_water) {
  std::mt19937 draw(7);
  std::uniform_real_distribution<double> share(0.02, 0.85), shallow(std::log(0.4), std::log(8.0)), current(-0.2, 0.4);
  for (int k = 0; k < 30; ++k) {
    SteadyWaveSpec spec{.length = 2};
    spec.depth = std::exp(shallow(draw)) * spec.length / (2 * pi);
    spec.height = share(draw) * breaking_height(spec.length, spec.depth);
    if (k % 2) spec.transport = current(draw);
    const SteadyWave wave = stream_function_wave(spec);
    const double tolerance = 1e-7 + 3 * pi * 64 * wave.tail() * wave.height() / spec.length;  // slope of the last term
    const auto [kinematic, head] = residuals(wave);
    EXPECT_LT(kinematic, tolerance) << spec.depth << ' ' << spec.height;
    EXPECT_LT(head, tolerance) << spec.depth << ' ' << spec.height;
    EXPECT_NEAR(wave.height(), spec.height, 1e-12);
    EXPECT_NEAR(transport(wave, spec.depth), spec.transport, tolerance * wave.celerity());
  }
}

TEST(SteadyWave, field_has_no_divergence_and_no_vorticity) {
  const SteadyWave wave = stream_function_wave({.height = 0.1, .period = 1.2, .depth = 0.4});
  constexpr double e = 1e-5;
  const double k = wave.wave_number();
  for (double theta : {0.3, 1.7, 4.0})
    for (double z : {-0.35, -0.1, -0.05}) {
      const auto right = wave.speed(theta + k * e, z), left = wave.speed(theta - k * e, z);
      const auto above = wave.speed(theta, z + e), below = wave.speed(theta, z - e);
      EXPECT_NEAR((right.along - left.along + above.up - below.up) / (2 * e), 0, 1e-8);
      EXPECT_NEAR((above.along - below.along - right.up + left.up) / (2 * e), 0, 1e-8);
    }
}

// Solutions of order 24 of the same equations by another program.
TEST(SteadyWave, agrees_with_known_solutions) {
  struct Known {
    double height, depth, period, length, celerity, current;
  };
  for (const Known& known :
       {Known{0.04, 0.4, 1.2, 1.939747, 1.616456, -0.003024}, Known{0.10, 0.4, 1.2, 1.959255, 1.632712, -0.018357},
        Known{0.10, 1.0, 1.124224, 2.0, 1.779005, -0.006858}}) {
    const SteadyWave wave = known.length == 2
                                ? stream_function_wave({.height = known.height, .length = 2, .depth = known.depth})
                                : stream_function_wave({.height = known.height, .period = 1.2, .depth = known.depth});
    EXPECT_NEAR(wave.length(), known.length, 1e-6);
    EXPECT_NEAR(wave.period(), known.period, 1e-6);
    EXPECT_NEAR(wave.celerity(), known.celerity, 1e-6);
    EXPECT_NEAR(wave.current(), known.current, 1e-6);
  }
}

// The same with no current at all, hence a transport.
TEST(SteadyWave, agrees_with_known_solutions_without_a_current) {
  struct Known {
    double height, depth, period, length, crest, at_crest, at_bed, at_trough;
  };
  for (const Known& known : {Known{0.04, 0.4, 1.2, 1.944949, 0.021154, 0.132900, 0.062296, -0.110862},
                             Known{0.10, 0.4, 1.2, 1.990148, 0.057438, 0.379749, 0.156318, -0.238143},
                             Known{0.10, 1.0, 1.119906, 2.0, 0.054124, 0.327207, 0.023667, -0.236432}}) {
    SteadyWaveSpec spec{.height = known.height, .period = known.period, .depth = known.depth};
    SteadyWave wave = stream_function_wave(spec);
    for (int pass = 0; pass < 30; ++pass) {
      spec.transport -= wave.current();
      wave = stream_function_wave(spec);
    }
    EXPECT_NEAR(wave.length(), known.length, 3e-6);
    EXPECT_NEAR(wave.crest(), known.crest, 1e-6);
    EXPECT_NEAR(wave.speed(0, wave.crest()).along, known.at_crest, 2e-6);
    EXPECT_NEAR(wave.speed(0, -known.depth).along, known.at_bed, 1e-6);
    EXPECT_NEAR(wave.speed(pi, wave.trough()).along, known.at_trough, 1e-6);
  }
}

TEST(SteadyWave, low_waves_are_linear_and_deep_ones_those_of_stokes) {
  for (double depth : {0.15, 0.4, 2.0, infinity}) {
    const SteadyWaveSpec low{.height = 1e-4, .period = 1.1, .depth = depth};
    const SteadyWave wave = stream_function_wave(low), airy = airy_wave(low);
    const double k = wave.wave_number(), bed = std::tanh(k * depth);  // Ursell's factor of the second harmonic
    const double second_order = 2 * std::pow(0.5 * low.height * k, 2) * wave.celerity() / (bed * bed * bed);
    EXPECT_NEAR(wave.length(), airy.length(), 1e-6 * airy.length());
    EXPECT_NEAR(wave.current(), airy.current(), 1e-3 * std::abs(airy.current()));
    EXPECT_NEAR(wave.speed(0.5, -0.05).along, airy.speed(0.5, -0.05).along, second_order);
    EXPECT_NEAR(wave.speed(0.5, -0.05).up, airy.speed(0.5, -0.05).up, second_order);
  }
  const double length = 2, k = pi;
  for (double steepness : {0.1, 0.2}) {  // c^2 = g / k (1 + e^2 + e^4 / 2 + e^6 / 4 + O(e^8)), e = k H / 2
    const SteadyWave wave = stream_function_wave({.height = 2 * steepness / k, .length = length, .depth = infinity});
    const double e = steepness * steepness;
    EXPECT_NEAR(wave.celerity() * wave.celerity() * k / g, 1 + e + e * e / 2 + e * e * e / 4, 2 * e * e * e);
  }
}

TEST(SteadyWave, current_carries_the_wave_along) {
  const SteadyWave still = stream_function_wave({.height = 0.08, .length = 2, .depth = 0.4});
  const SteadyWave carried = stream_function_wave({.height = 0.08, .length = 2, .depth = 0.4, .transport = 0.3});
  EXPECT_NEAR(carried.celerity(), still.celerity() + 0.3, 1e-10);
  EXPECT_NEAR(carried.crest(), still.crest(), 1e-11);
}

TEST(SteadyWave, breaking_ones_are_refused) {
  for (double depth : {0.1, 0.4, 5.0, infinity}) {
    const double highest = breaking_height(2, depth);
    EXPECT_THROW(stream_function_wave({.height = 1.01 * highest, .length = 2, .depth = depth}), std::invalid_argument);
    EXPECT_THROW(stream_function_wave({.height = 3 * highest, .length = 2, .depth = depth}), std::invalid_argument);
    EXPECT_NO_THROW(stream_function_wave({.height = 0.8 * highest, .length = 2, .depth = depth})) << depth;
  }
}

}  // namespace
}  // namespace splashdown::fluid::steady_wave_test
