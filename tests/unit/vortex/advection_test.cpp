// Particles and kernels.
#include "fluid/vortex/transport/advection.hpp"

#include <gtest/gtest.h>

#include "fluid/vortex/transport/kernels.hpp"
#include "shapes.hpp"

namespace splashdown::vortex::advection_test {
namespace {

TEST(Kernels, keep_the_moments_of_their_order) {
  for (double shift = 0; shift < 1; shift += 0.037) {
    double four[4] = {}, six[4] = {};
    for (int k = -4; k <= 4; ++k)
      for (int power = 0; power < 4; ++power) {
        four[power] += m4(k - shift) * std::pow(k - shift, power);
        six[power] += m6(k - shift) * std::pow(k - shift, power);
      }
    EXPECT_NEAR(four[0], 1, 1e-14);
    EXPECT_NEAR(six[0], 1, 1e-13);
    for (const int power : {1, 2}) EXPECT_NEAR(four[power], 0, 1e-13);
    for (const int power : {1, 2, 3}) EXPECT_NEAR(six[power], 0, 1e-12);
  }
}

TEST(Kernels, are_those_of_the_sweeps) {
  // A particle at a node of a uniform stream along x, moved by half of a third of a square twice.
  for (const auto kernel : {Remeshing::m4, Remeshing::m6}) {
    const auto g = scenes::square_grid(32);
    NodeField omega(g.nodes(), 0.0);
    omega[g.at(16, 16)] = 1;
    FaceField velocity;
    NodeField psi(g.nodes(), 0.0);
    velocities_of(g, psi, {0, 0.3 * g.h}, velocity);
    NodeField moved;
    Advection(g, kernel, PathRule::rk4).move(omega, {velocity, velocity, 0}, 1, moved);
    for (int k = -3; k <= 3; ++k)
      EXPECT_NEAR(moved[g.at(16, 16 + k)], kernel == Remeshing::m4 ? m4(k - 0.3) : m6(k - 0.3), 1e-14) << k;
  }
}

/// A grid of squares of 1 m, `across` by 16.
Grid long_grid(int across) { return {.min = Vec<2>::Zero(), .h = 1, .nx = across, .ny = 16}; }

/// What a patch of vorticity that begins at column `left` becomes on a grid of so many columns, from there on.
std::vector<double> moved_patch(int across, int left, Remeshing kernel) {
  const auto g = long_grid(across);
  NodeField omega(g.nodes(), 0.0);
  for (int j = 4; j < 12; ++j)
    for (int i = 0; i < 40; ++i) omega[g.at(left + i, j)] = std::sin(1 + i * 0.3 + j * 1.7);
  NodeField psi(g.nodes(), 0.0);
  FaceField velocity;
  velocities_of(g, psi, {0.37, -0.21}, velocity);
  NodeField moved;
  Advection(g, kernel, PathRule::rk2).move(omega, {velocity, velocity, 0}, 1, moved);
  std::vector<double> found;
  for (int j = 0; j <= 16; ++j)
    for (int i = -6; i < 46; ++i) found.push_back(moved[g.at(left + i, j)]);
  return found;
}

// Sweeps go block by block of columns. On long rows blocks are whole, and have neighbours on both sides.
TEST(Advection, is_the_same_wherever_blocks_of_a_row_end) {
  for (const auto kernel : {Remeshing::m4, Remeshing::m6}) {
    const auto alone = moved_patch(80, 20, kernel);
    for (const int left : {230, 250, 258, 490, 512, 740}) EXPECT_EQ(moved_patch(1040, left, kernel), alone) << left;
  }
}

/// Error of a blob after a quarter of a turn with a solid rotation.
double error_of_turn(int n, Remeshing kernel, int steps) {
  const auto g = scenes::square_grid(n, 0.8);
  const double rate = 2 * std::numbers::pi;
  const auto blob = [](const Vec<2>& x) { return std::exp(-100 * (x - Vec<2>(0.25, 0)).squaredNorm()); };
  const auto turned = [&](const Vec<2>& x) { return blob(Vec<2>(x.y(), -x.x())); };
  auto omega = scenes::sampled(g, blob);
  NodeField psi(g.nodes());
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) psi[g.at(i, j)] = -0.5 * rate * g.node(i, j).squaredNorm();
  FaceField velocity;
  velocities_of(g, psi, Vec<2>::Zero(), velocity);
  Advection advection(g, kernel, PathRule::rk2);
  const double before = scenes::circulation(g, omega);
  double worst = 0;
  NodeField moved;
  for (int k = 0; k < steps; ++k) {
    const double last = scenes::circulation(g, omega);
    advection.move(omega, {velocity, velocity, 0}, 0.25 / steps, moved);
    omega.swap(moved);
    worst = std::max(worst, std::abs(scenes::circulation(g, omega) - last));
  }
  EXPECT_LE(worst, 1e-12 * before);
  double error = 0;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) error = std::max(error, std::abs(omega[g.at(i, j)] - turned(g.node(i, j))));
  return error;
}

// With |u| dt/h kept, M'4 loses h^3 in each of 1/h steps, M'6 h^4; the splitting is of second order, and small in a turn.
TEST(Advection, a_quarter_turn_is_of_the_order_of_its_kernel_and_keeps_circulation) {
  const auto order = [](Remeshing kernel, double& fine) {
    const double middle = error_of_turn(128, kernel, 160);
    fine = error_of_turn(256, kernel, 320);
    return std::log2(middle / fine);
  };
  double four = 0, six = 0;
  EXPECT_NEAR(order(Remeshing::m4, four), 2, 0.2);
  EXPECT_GE(order(Remeshing::m6, six), 2.8);
  EXPECT_LE(six, 0.5 * four);
}

}  // namespace
}  // namespace splashdown::vortex::advection_test
