// Free drops: incompressible motion without walls, and with a body inside.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "tests/unit/coupling/scenes.hpp"
#include "tests/verification/order.hpp"

namespace splashdown::drop_test {
namespace {

using coupling::scenes::water;
using Vec = Eigen::Vector2d;

constexpr double A0 = 10;  // [1/s]: rate of strain

std::unique_ptr<coupling::scenes::Watched<2>> strained_drop(double h) {
  fluid::FluidSpec<2> spec;
  spec.size = {.surface = h, .far = h};
  spec.liquids.push_back(
      {fluid::scenes::ellipse(1, 1, 512), [](const Vec& x) { return Vec(-A0 * x.x(), A0 * x.y()); }});
  return std::make_unique<coupling::scenes::Watched<2>>(
      std::make_unique<fluid::Fluid<2>>(spec, fluid::scenes::no_effects()));
}

// Semi-axes of the elliptic drop: v = (-A x, A y), A' = A^2 (a^2 - b^2) / (a^2 + b^2), a' = -A a, b' = A b.
Vec exact_axes(double time) {
  double a = 1, b = 1, A = A0;
  const int steps = 20000;
  const double dt = time / steps;
  for (int i = 0; i < steps; ++i) {  // midpoint rule
    const auto rate = [](double p, double q, double r) { return r * r * (p * p - q * q) / (p * p + q * q); };
    const double am = a - 0.5 * dt * A * a, bm = b + 0.5 * dt * A * b, Am = A + 0.5 * dt * rate(a, b, A);
    a -= dt * Am * am, b += dt * Am * bm, A += dt * rate(am, bm, Am);
  }
  return {a, b};
}

// The volume that a step's motion creates at each unknown, over the flux that passes there.
double divergence_of_a_step(double dt) {
  const auto stepper = strained_drop(0.1);
  // A few equal steps first: initial pressures and spacing have settled, kick = dt.
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(stepper->attempt(dt).ok());
    stepper->commit();
  }
  EXPECT_TRUE(stepper->attempt(dt).ok());
  const auto x = stepper->fluid().nodes().x;  // t_n, remeshed
  const auto mesh = stepper->fluid().mesh();
  const auto nodes = stepper->fluid().nodes();
  stepper->commit();
  fluid::PressureEquation<2> equation;
  EXPECT_TRUE(equation.build(nodes, mesh, water, {}, {}, {}));
  std::vector<Vec> middle = x, u = x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    u[i] = (stepper->fluid().nodes().x[i] - x[i]) / dt;
    middle[i] = 0.5 * (x[i] + stepper->fluid().nodes().x[i]);
  }
  std::vector<double> r;
  equation.motion_residual(middle, u, r);
  double sum = 0;
  for (double v : r) sum += v * v;
  return std::sqrt(sum / static_cast<double>(r.size())) / (A0 * 0.1 * 0.1);
}

TEST(Drop, a_step_creates_next_to_no_volume_in_the_interior) {
  // The strain turns while it lasts: a step without pressure would create 2 A dt of the flux. The pressure
  // matrix is the compact Laplacian, the motion's own is the wide one of lumped velocities, so that the two
  // corrections leave a part of that, first order in dt.
  const std::array dt{4e-3, 2e-3, 1e-3, 1e-6};
  std::array<double, 4> residual;
  for (std::size_t i = 0; i < dt.size(); ++i) {
    residual[i] = divergence_of_a_step(dt[i]);
    EXPECT_LE(residual[i], 0.05 * 2 * A0 * dt[i]) << dt[i];
  }
  EXPECT_GE(order_of(dt, residual), 1 - 0.2);
}

TEST(Drop, axes_follow_the_exact_solution_early) {
  const double end = 0.03;  // A0 t = 0.3: axes 0.75 and 1.33
  const Vec exact = exact_axes(end);
  ASSERT_NEAR(exact.x() * exact.y(), 1, 1e-6) << "volume";
  for (double h : {0.1, 0.05}) {
    const auto stepper = strained_drop(h);
    while (stepper->time() < end * (1 - 1e-9)) {
      const double dt = std::min({stepper->stable_dt(), 1e-3, end - stepper->time()});
      ASSERT_TRUE(stepper->attempt(dt).ok());
      stepper->commit();
    }
    Vec extent = Vec::Zero();
    for (const auto& x : stepper->fluid().nodes().x) extent = extent.cwiseMax(x.cwiseAbs());
    // Second order in space and time: chords of the outline cut h^2 / 8, the rest is of the same size.
    EXPECT_NEAR(extent.x(), exact.x(), 0.005 * (h / 0.1) + 0.5 * h * h);
    EXPECT_NEAR(extent.y(), exact.y(), 0.005 * (h / 0.1) + 0.5 * h * h);
    const auto& ledger = stepper->fluid().ledger();
    EXPECT_LE(std::abs(ledger.volume / ledger.volume_initial - 1), 0.002 * (h / 0.1));
  }
}

// x_{n+1} = x_n + dt v_{n+1/2} is exact for a constant acceleration, and so are velocities between half steps.
TEST(Drop, that_falls_keeps_its_energy_whatever_its_steps_are) {
  const Vec g(0, -9.81), start(0.5, -2);
  fluid::FluidSpec<2> spec;
  spec.density = water;
  spec.size = {.surface = 0.02, .far = 0.02};
  spec.liquids.push_back({fluid::scenes::ellipse(0.1, 0.1, 64), [&](const Vec&) { return start; }});
  coupling::scenes::Watched<2> drop(std::make_unique<fluid::Fluid<2>>(spec, fluid::scenes::gravity(g)));
  std::optional<double> first;
  for (const double dt : {1e-4, 1e-3, 2e-3, 5e-4, 3e-3, 3e-3}) {
    ASSERT_TRUE(drop.attempt(dt).ok());
    const auto& l = drop.fluid().ledger();
    const double energy = l.kinetic_energy + l.potential_energy;
    if (!first) first = energy;
    EXPECT_NEAR(energy, *first, 1e-10 * l.kinetic_energy) << "at " << drop.time();
    drop.commit();
  }
}

TEST(Drop, volume_ledger_closes) {
  const auto stepper = strained_drop(0.1);
  for (int i = 0; i < 30; ++i) {
    ASSERT_TRUE(stepper->attempt(1e-3).ok());
    stepper->commit();
  }
  const auto& l = stepper->fluid().ledger();
  EXPECT_NEAR(l.volume, l.volume_initial + l.time_integration + l.remesh_created + l.remesh_deleted + l.returned,
              1e-12 * l.volume_initial);
}

// A light circle driven through a drop. Pressure exchanges momentum exactly (unit/fluid); what is left is
// the projection of wall nodes onto the curved hull and the remesh: the error of the mesh.
double momentum_drift(double h) {
  coupling::scenes::Scene scene;
  scene.gravity.setZero();
  scene.fluid.size = {.surface = h, .far = h};
  scene.fluid.liquids.push_back({fluid::scenes::ellipse(1, 1, 256), {}});
  const double mass = 200;
  scene.add_body(rigid::circle(0.4, 256), mass, {0, 0}, h);
  // The push: an initial velocity, which the first repair shares with the water.
  scene.set_velocity(0, {1, 0.5, 0});
  const auto driven = coupling::scenes::coupled(scene);
  const Vec given = mass * Vec(1, 0.5);
  double worst = 0;
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(driven->attempt(std::min(2e-3, driven->stable_dt())).ok());
    driven->commit();
    const auto& f = driven->fluid();
    Vec sum = mass * driven->bodies().state(0).velocity.head<2>();
    std::vector<double> share(f.nodes().size(), 0.0);
    for (const auto& cell : f.mesh().cells)
      for (int n : cell) share[n] += water * fluid::volume<2>(fluid::corners(f.nodes().x, cell)) / 3;
    for (std::size_t n = 0; n < share.size(); ++n) sum += share[n] * f.nodes().v[n];
    worst = std::max(worst, (sum - given).norm() / given.norm());
  }
  return worst;
}

TEST(Drop, fluid_and_body_together_keep_their_momentum) {
  const double coarse = momentum_drift(0.1), fine = momentum_drift(0.05);
  EXPECT_GE(std::log2(coarse / fine), 1 - 0.2) << coarse << ' ' << fine;
  EXPECT_LE(fine, 0.02);
}

}  // namespace
}  // namespace splashdown::drop_test
