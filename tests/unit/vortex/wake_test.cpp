// What is left of a wake that leaves the grid.
#include "fluid/vortex/wake.hpp"

#include <gtest/gtest.h>

#include "fluid/vortex/poisson/stream_function.hpp"
#include "shapes.hpp"

namespace splashdown::vortex::wake_test {
namespace {

/// Slow fluid between two layers, from x = 0 on for ever; `waves`: vortices of either sense on it.
NodeField wake(const Grid& g, double waves) {
  return scenes::sampled(g, [waves](const Vec<2>& x) {
    const double begins = x.x() < 0 ? 0 : 1 - std::exp(-4 * x.x() * x.x());
    return begins * (8 * x.y() + waves * std::cos(2.5 * x.x())) * std::exp(-4 * x.y() * x.y());
  });
}

Grid grid(double length) {
  return {.min = {-2, -2}, .h = 1. / 16, .nx = static_cast<int>(16 * (2 + length) + 0.5), .ny = 64};
}

/// The velocity ahead of it on a grid of this length, with the wake going on or cut.
Vec<2> ahead(double length, double reach, double waves) {
  const auto g = grid(length);
  Wake wake_end(g);
  StreamFunction solver(g, SideKind::free);
  NodeField psi = wake(g, waves);
  wake_end.end(psi, {reach, 0});
  solver.solve(psi, wake_end.beyond());
  FaceField u;
  velocities_of(g, psi, Vec<2>::Zero(), u);
  const std::size_t k = g.at(16, 32);  // a unit ahead
  return {0.5 * (u.u[k] + u.u[k - static_cast<std::size_t>(g.nx) - 1]), 0.5 * (u.v[k] + u.v[k - 1])};
}

// Its flux is Q = int y omega dy = sqrt(pi)/2: ahead of it that is a source, Q/(2 pi) over the distance; cut, it ends in a sink.
TEST(Wake, goes_on_beyond_the_grid) {
  const double flux = std::sqrt(std::numbers::pi) / 2 / (2 * std::numbers::pi);
  const Vec<2> near = ahead(6, 3, 0), far = ahead(14, 7, 0), cut = ahead(6, 0, 0);
  EXPECT_NEAR(near.x(), far.x(), 1e-3 * flux);
  EXPECT_NEAR(std::abs(cut.x() - far.x()), flux / 7, 0.05 * flux / 7);
  EXPECT_LT(std::abs(near.y()) + std::abs(far.y()), 1e-6 * flux);
}

// Its vortices come to an end without a pull.
TEST(Wake, lets_vortices_of_either_sense_go) {
  const Vec<2> calm = ahead(14, 7, 0), waves = ahead(14, 7, 1), longer = ahead(20, 10, 1), cut = ahead(14, 0, 1);
  EXPECT_LT(std::abs(waves.y() - longer.y()), 0.2 * std::abs(cut.y() - longer.y()));
  EXPECT_NEAR(waves.x(), calm.x(), 1e-2 * std::abs(calm.x()));
}

TEST(Wake, without_reach_is_what_it_was) {
  const auto g = grid(6);
  auto omega = wake(g, 1);
  Wake wake_end(g);
  wake_end.end(omega, Vec<2>::Zero());
  EXPECT_EQ(omega, wake(g, 1));
  EXPECT_EQ(wake_end.beyond(), nullptr);
}

}  // namespace
}  // namespace splashdown::vortex::wake_test
