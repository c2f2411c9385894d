// Viscosity in whole steps: free waves.
#include <gtest/gtest.h>

#include <algorithm>
#include <complex>

#include "basin.hpp"
#include "fluid/effects/viscosity/viscosity.hpp"

namespace splashdown::fluid::viscous_flow_test {
namespace {

using testing::Basin;

constexpr double periods = 1.75;
const double k = 2 * std::numbers::pi, omega = std::sqrt(9.81 * k), period = 2 * std::numbers::pi / omega;

// Amplitude of the standing wave cos(k x) at its last turn.
double final_amplitude(double mu) {
  const Basin basin{.length = 1, .depth = 0.6, .size = 1.0 / 32, .amplitude = 0.003, .dt_max = period / 120};
  auto stepper = mu > 0 ? testing::water(basin, testing::gravity(), std::make_unique<Viscosity<2>>(mu))
                        : testing::water(basin, testing::gravity());
  double largest = 0;
  EXPECT_TRUE(testing::run(stepper, periods * period, [&](const Fluid<2>& fluid, double) {
    if (fluid.time() < (periods - 0.5) * period) return;
    double mode = 0;
    for (const auto& f : fluid.mesh().boundary) {
      if (f.wall >= 0) continue;
      const Vec<2> a = fluid.nodes().x[f.nodes[0]], b = fluid.nodes().x[f.nodes[1]];
      const Vec<2> middle = 0.5 * (a + b);
      mode += 2 * std::abs(a.x() - b.x()) * middle.y() * std::cos(k * middle.x());
    }
    largest = std::max(largest, std::abs(mode));
  }));
  return largest;
}

// Lamb, Hydrodynamics, 349: (n + 2 nu k^2)^2 + omega^2 = 4 nu^2 k^4 sqrt(1 + n / (nu k^2)), n = -decay + i ...;
// decay -> 2 nu k^2 for small nu.
double exact_decay(double nu) {
  const double rate = nu * k * k;
  std::complex<double> n(-2 * rate, omega);
  for (int pass = 0; pass < 100; ++pass)  // contracts by about (rate / omega)^(3/2)
    n = -2 * rate + std::complex<double>(0, 1) * std::sqrt(omega * omega - 4 * rate * rate * std::sqrt(1.0 + n / rate));
  return -n.real();
}

// Between free-slip ends on deep water. What the mesh gains or loses without viscosity is divided out. The
// layer of vorticity below the surface, sqrt(2 nu / omega), is as thin as one element and makes the error.
TEST(Viscosity, standing_waves_decay_as_lamb_says) {
  const double nu = 0.02 * omega / (k * k);
  ASSERT_NEAR(exact_decay(1e-5 * nu) / (2e-5 * nu * k * k), 1, 1e-3);
  const double turn = periods - 0.25;  // close to where the last maximum is: 1.5 periods
  const double decay = std::log(final_amplitude(0) / final_amplitude(1000 * nu)) / (turn * period);
  EXPECT_NEAR(decay / exact_decay(nu), 1, 0.1);
}

}  // namespace
}  // namespace splashdown::fluid::viscous_flow_test
