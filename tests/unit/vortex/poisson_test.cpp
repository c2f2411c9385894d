// The equations on the grid: the lattice's fundamental solution, planes without end, walls, diffusion, projections.
#include <gtest/gtest.h>

#include <random>

#include "fluid/vortex/poisson/box_projection.hpp"
#include "fluid/vortex/poisson/lattice_green.hpp"
#include "fluid/vortex/poisson/stream_function.hpp"
#include "fluid/vortex/transport/diffusion.hpp"
#include "shapes.hpp"

namespace splashdown::vortex::poisson_test {
namespace {

using std::numbers::pi;

TEST(LatticeGreen, obeys_the_five_point_equation_near_and_far) {
  for (int m = 0; m <= 60; m += 3)
    for (int n = 0; n <= m; n += 4) {
      const double sum = lattice_green(m + 1, n) + lattice_green(m - 1, n) + lattice_green(m, n + 1) +
                         lattice_green(m, n - 1) - 4 * lattice_green(m, n);
      EXPECT_NEAR(sum, m == 0 && n == 0 ? -1 : 0, 1e-10) << m << ' ' << n;  // the series is good to 40^-6
    }
}

// McCrea & Whipple 1940: -1/4 and -1/pi.
TEST(LatticeGreen, has_the_values_of_random_walks) {
  EXPECT_NEAR(lattice_green(1, 0), -0.25, 1e-12);
  EXPECT_NEAR(lattice_green(1, 1), -1 / pi, 1e-12);
}

/// Largest error of velocities on faces around a vortex off the centre.
double error_of_vortex(int n) {
  const auto g = scenes::square_grid(n);
  const scenes::LambOseen vortex{1, 0.15};
  const Vec<2> at(0.23, -0.11);
  auto omega = scenes::sampled(g, [&](const Vec<2>& x) { return vortex.omega(x - at); });
  NodeField psi;
  FaceField velocity;
  StreamFunction(g, SideKind::free).solve(omega, psi);
  velocities_of(g, psi, Vec<2>::Zero(), velocity);
  double error = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      error = std::max(
          error, std::abs(velocity.u[g.at(i, j)] - vortex.velocity(g.node(i, j) + Vec<2>(0, 0.5 * g.h) - at).x()));
  return error;
}

TEST(StreamFunction, a_vortex_in_a_plane_without_end_is_of_second_order) {
  const double coarse = error_of_vortex(64), middle = error_of_vortex(128), fine = error_of_vortex(256);
  EXPECT_NEAR(std::log2(coarse / middle), 2, 0.2);
  EXPECT_NEAR(std::log2(middle / fine), 2, 0.2);
}

// The walls of the box are the cells of a Taylor-Green flow: eigenvectors of the five-point Laplacian.
TEST(StreamFunction, modes_between_walls_decay_as_the_stencil_says) {
  for (const int order : {2, 4}) {
    const Grid g{.min = {0, 0}, .h = 1. / 48, .nx = 48, .ny = 64};
    const double nu_dt = 3e-4, kx = pi, ky = 2 * pi / g.max().y();
    const auto mode = [&](const Vec<2>& x) { return std::sin(kx * x.x()) * std::sin(ky * x.y()); };
    auto omega = scenes::sampled(g, mode);
    NodeField psi;
    Diffusion(g, order).apply(omega, nu_dt, 0);
    StreamFunction(g, SideKind::slip).solve(omega, psi);
    const auto symbol = [&](double k) { return std::pow(2 / g.h * std::sin(0.5 * k * g.h), 2); };
    const double lx = symbol(kx), ly = symbol(ky), more = order == 4 ? g.h * g.h / 12 * (lx * lx + ly * ly) : 0;
    const double decay = std::exp(-nu_dt * (lx + ly + more));
    for (int j = 1; j < g.ny; j += 7)
      for (int i = 1; i < g.nx; i += 5) {
        EXPECT_NEAR(omega[g.at(i, j)], decay * mode(g.node(i, j)), 1e-11);
        EXPECT_NEAR(psi[g.at(i, j)], decay * mode(g.node(i, j)) / (lx + ly), 1e-12);
      }
  }
}

double error_of_decay(int n, int order) {
  const Grid g{.min = {0, 0}, .h = 1. / n, .nx = n, .ny = n};
  const double nu_dt = 0.01, k = 2 * pi;
  auto omega = scenes::sampled(g, [&](const Vec<2>& x) { return std::sin(k * x.x()) * std::sin(k * x.y()); });
  Diffusion(g, order).apply(omega, nu_dt, 0);
  return std::abs(omega[g.at(n / 4, n / 4)] - std::exp(-2 * nu_dt * k * k));
}

TEST(Diffusion, is_of_second_and_of_fourth_order) {
  for (const int order : {2, 4})
    EXPECT_NEAR(std::log2(error_of_decay(16, order) / error_of_decay(32, order)), order, 0.2) << order;
}

// A vortex near a side, where both sides matter: the five-point Laplacian gives it back, for lengths with all factors.
TEST(StreamFunction, obeys_the_five_point_equation) {
  for (const auto sides : {SideKind::free, SideKind::slip})
    for (const int n : {96, 100, 140}) {
      auto g = scenes::square_grid(n);
      g.ny -= 20;
      const auto omega =
          scenes::sampled(g, [](const Vec<2>& x) { return std::exp(-40 * (x - Vec<2>(0.6, 0)).squaredNorm()); });
      NodeField psi;
      StreamFunction(g, sides).solve(omega, psi);
      const auto row = static_cast<std::size_t>(g.nx + 1);
      for (int j = 1; j < g.ny; ++j)
        for (int i = 1; i < g.nx; ++i) {
          const std::size_t k = g.at(i, j);
          const double curl = (4 * psi[k] - psi[k - 1] - psi[k + 1] - psi[k - row] - psi[k + row]) / (g.h * g.h);
          EXPECT_NEAR(curl, omega[k], 1e-11) << n << ' ' << i << ' ' << j;
        }
    }
}

// To roundoff, as long as nothing reaches a side; steps of any length.
TEST(Diffusion, keeps_circulation_and_what_is_faint_becomes_nothing) {
  const auto g = scenes::square_grid(96);
  for (const double share : {0.01, 0.2, 3.}) {
    auto omega = scenes::sampled(g, [](const Vec<2>& x) { return std::exp(-80 * x.squaredNorm()); });
    const double before = scenes::circulation(g, omega);
    Diffusion(g, 2).apply(omega, share * g.h * g.h, 1e-20);
    EXPECT_NEAR(scenes::circulation(g, omega), before, 1e-14);
    for (const double w : omega) EXPECT_TRUE(w == 0 || std::abs(w) >= 1e-20);
  }
}

struct Forces {
  std::vector<double> u, v;
};
/// Random forces on the inner faces of a box.
Forces random_forces(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Forces f;
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const bool inner = i > 1 && j > 1 && i < width - 3 && j < height - 3;
      f.u.push_back(inner ? normal(random) : 0);
      f.v.push_back(inner ? normal(random) : 0);
    }
  return f;
}

double dot(const Forces& a, const Forces& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.u.size(); ++k) sum += a.u[k] * b.u[k] + a.v[k] * b.v[k];
  return sum;
}

TEST(BoxProjection, is_symmetric_and_leaves_no_divergence) {
  constexpr int width = 24, height = 16;
  BoxProjection project(width, height);
  const auto apply = [&](const Forces& f) {
    Forces u{std::vector<double>(f.u.size(), 0.0), std::vector<double>(f.u.size(), 0.0)};
    project.add(f.u, f.v, u.u, u.v);
    return u;
  };
  const auto a = random_forces(width, height, 1), b = random_forces(width, height, 2);
  const auto pa = apply(a), pb = apply(b);
  EXPECT_NEAR(dot(pa, b), dot(a, pb), 1e-10 * std::sqrt(dot(a, a) * dot(b, b)));
  EXPECT_LE(dot(pa, a), dot(a, a));
  for (int j = 0; j + 1 < height; ++j)
    for (int i = 0; i + 1 < width; ++i) {
      const auto k = static_cast<std::size_t>(j * width + i);
      EXPECT_NEAR(pa.u[k + 1] - pa.u[k] + pa.v[k + width] - pa.v[k], 0, 1e-12);
    }
}

// Of P^2 = P: what is left of the curl of a field is all of it.
TEST(BoxProjection, keeps_the_curl) {
  constexpr int width = 16, height = 16;
  BoxProjection project(width, height);
  const auto f = random_forces(width, height, 3);
  Forces u{std::vector<double>(f.u.size(), 0.0), std::vector<double>(f.u.size(), 0.0)};
  project.add(f.u, f.v, u.u, u.v);
  for (int j = 1; j + 1 < height; ++j)
    for (int i = 1; i + 1 < width; ++i) {
      const auto k = static_cast<std::size_t>(j * width + i);
      const auto curl = [&](const Forces& x) { return x.v[k] - x.v[k - 1] - x.u[k] + x.u[k - width]; };
      EXPECT_NEAR(curl(u), curl(f), 1e-9);  // the lattice's solution is good to 1e-10
    }
}

}  // namespace
}  // namespace splashdown::vortex::poisson_test
