// Three dimensions: a light ball that lands on water. Bits, light bodies, rest.
#include <gtest/gtest.h>

#include <cmath>

#include "fluid/parallel.hpp"
#include "rigid/solids.hpp"
#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

using coupling::scenes::g;
using coupling::scenes::saved;
using coupling::scenes::water;
using fluid::Vec;

constexpr double radius = 0.5;

/// A ball in a tank of 4 m x 4 m x 2 m of water.
std::unique_ptr<coupling::Simultaneous<3>> ball(double density_ratio, double height, double speed, double h) {
  fluid::FluidSpec<3> spec;
  spec.size = {.surface = 4 * h, .far = 4 * h, .growth = 0.4};
  const auto shape = rigid::sphere(radius, 32);
  const auto properties = rigid::with_density<3>(shape.at_unit_density, density_ratio * water);
  rigid::BodySpec<3> body;
  body.name = "ball";
  body.surface = shape.surface;
  body.mass = properties.mass;
  body.inertia = properties.inertia;
  body.free.fill(true);
  body.pose.translation().z() = height;
  body.velocity[2] = -speed;
  fluid::WallSpec<3> hull = fluid::scenes::wall<3>("ball", {body.surface.vertices, body.surface.facets}, h);
  hull.pose = body.pose;
  hull.velocity = body.velocity;
  spec.walls = {hull, fluid::scenes::wall<3>("tank", fluid::scenes::turned_inside_out(fluid::scenes::block({-2, -2, -2}, {2, 2, 2})), 4 * h)};
  spec.liquids.push_back({fluid::scenes::block({-2, -2, -2}, {2, 2, 0}), {}});
  std::vector<std::unique_ptr<fluid::Term<3>>> terms;
  terms.push_back(std::make_unique<fluid::Gravity<3>>(Vec<3>(0, 0, -g)));
  std::vector<std::unique_ptr<rigid::Force<3>>> forces;
  forces.push_back(std::make_unique<rigid::Gravity<3>>(rigid::Vec<3>(0, 0, -g)));
  return std::make_unique<coupling::Simultaneous<3>>(
      std::make_unique<fluid::Fluid<3>>(std::move(spec), std::move(terms)),
      std::make_unique<rigid::Bodies<3>>(std::vector{body}, std::move(forces)));
}

TEST(BallInSpace, lands_with_the_same_bits_on_any_number_of_threads) {
  std::string first;
  for (int threads : {1, 2, 8}) {
    fluid::use_threads(threads);
    const auto stepper = ball(1.0 / 3, radius, 3, 0.12);
    EXPECT_EQ(coupling::scenes::run(*stepper, 12, 2e-3), 1);
    EXPECT_GT(stepper->fluid().loads()[0].wetted, 0);
    if (first.empty()) first = saved(*stepper);
    EXPECT_TRUE(saved(*stepper) == first) << threads;
  }
  fluid::use_threads(0);
}

TEST(BallInSpace, resumed_while_it_lands_goes_on_bit_for_bit) {
  const auto whole = ball(1.0 / 3, radius, 3, 0.12), resumed = ball(1.0 / 3, radius, 3, 0.12);
  ASSERT_EQ(coupling::scenes::run(*whole, 8, 2e-3), 1);
  std::istringstream file(saved(*whole));
  resumed->load(file);
  for (auto* s : {whole.get(), resumed.get()})
    for (int i = 0; i < 4; ++i) {
      ASSERT_TRUE(s->attempt(1e-3).ok());
      s->commit();
    }
  EXPECT_TRUE(saved(*whole) == saved(*resumed));
}

TEST(BallInSpace, of_any_density_lands_in_one_pass_and_settles_its_momentum) {
  // Lighter than the added mass by far: 1e-3 of water at 3 m/s must be stopped, not thrown.
  for (double ratio : {1.0 / 3, 0.01, 1e-3}) {
    const auto stepper = ball(ratio, radius, 3, 0.12);
    double dt = 2e-3;
    for (int i = 0; i < 25; ++i) {
      dt = std::min(stepper->stable_dt(), 1.5 * dt);
      const auto report = coupling::scenes::attempt_halving(*stepper, dt, 9);
      ASSERT_TRUE(report.ok()) << ratio << " at " << stepper->time() << ": " << report.cause;
      EXPECT_EQ(report.passes, 1);
      stepper->commit();
      // Nothing gives it more energy than it brought and gains by falling; drops may carry some of it upwards.
      EXPECT_LE(stepper->bodies().state(0).velocity.norm(), 3 * 1.05 + g * stepper->time()) << ratio;
    }
    const auto& ledger = stepper->fluid().ledger();
    EXPECT_LE(std::abs(ledger.volume + ledger.spray - ledger.volume_initial), 0.005 * ledger.volume_initial) << ratio;
  }
}

}  // namespace
}  // namespace splashdown
