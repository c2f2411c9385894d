// Fast water on rigid faces and edges, without gravity: the speed is only a unit of time.
#include <gtest/gtest.h>

#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

namespace scenes = coupling::scenes;
using Vec = Eigen::Vector2d;
using scenes::water;

constexpr double width = 0.1;

struct Steady {
  double pressure;  // largest on the wall, over rho u^2 / 2
  Vec force;        // over rho u^2 width
};

// A jet falls on a wall until it has travelled five widths; means over the last two.
Steady jet_on(const fluid::WallSpec<2>& wall, double speed, double tip) {
  fluid::FluidSpec<2> spec;
  spec.size = {.surface = 0.01, .far = 0.01};
  spec.step.dt_max = 1;
  spec.walls.push_back(wall);
  spec.liquids.push_back({fluid::scenes::rectangle({-0.5 * width, tip}, {0.5 * width, tip + 9 * width}),
                          [speed](const auto&) { return Vec(0, -speed); }});
  coupling::scenes::Watched<2> stepper(std::make_unique<fluid::Fluid<2>>(spec, fluid::scenes::no_effects()));
  const double until = 5 * width / speed, from = 3 * width / speed;
  Steady mean{0, Vec::Zero()};
  double dt = 0.002 * width / speed, time = 0;
  while (stepper.time() < until) {
    dt = std::min(stepper.stable_dt(), 1.5 * dt);
    while (!stepper.attempt(dt).ok()) {
      dt *= 0.5;
      if (dt < 1e-6 * width / speed) {
        ADD_FAILURE() << "no step at t = " << stepper.time();
        return mean;
      }
    }
    stepper.commit();
    if (stepper.time() < from) continue;
    const auto& f = stepper.fluid();
    double most = 0;
    for (std::size_t i = 0; i < f.nodes().size(); ++i)
      if (f.nodes().tie[i].wall >= 0) most = std::max(most, f.pressure()[i]);
    time += dt;
    mean.pressure += dt * most / (0.5 * water * speed * speed);
    mean.force += dt * f.result().loads[0].total().head<2>() / (water * speed * speed * width);
  }
  const auto& l = stepper.fluid().ledger();
  EXPECT_NEAR(l.volume, l.volume_initial + l.time_integration + l.remesh_created + l.remesh_deleted + l.returned,
              1e-12 * l.volume_initial);
  return {mean.pressure / time, mean.force / time};
}

class Speed : public testing::TestWithParam<double> {};

// Ten elements across the jet: the node at the stagnation point sees its parabola over (2 h / width)^2 = 4 %. The force
// is a momentum balance; what the start leaves of it after three widths is of the same size.
TEST_P(Speed, of_a_jet_on_a_plate_gives_its_stagnation_pressure_and_momentum) {
  const auto plate = fluid::scenes::wall("plate", fluid::scenes::rectangle({-2, -0.1}, {2, 0}), 0.008);
  const auto steady = jet_on(plate, GetParam(), 0);
  EXPECT_NEAR(steady.pressure, 1, 0.05);
  EXPECT_NEAR(steady.force.y(), -1, 0.05);
  EXPECT_NEAR(steady.force.x(), 0, 0.05);
}

// Each half is turned by 45 degrees: F = -rho u^2 width (1 - cos 45).
TEST_P(Speed, of_a_jet_that_an_edge_splits_gives_the_momentum_of_the_turn) {
  const auto edge = fluid::scenes::wall("edge", fluid::scenes::outline({{0, 0}, {-1, -1}, {1, -1}}), 0.008);
  const auto steady = jet_on(edge, GetParam(), 0.02);
  EXPECT_NEAR(steady.force.y(), -(1 - std::sqrt(0.5)), 0.05);
  EXPECT_NEAR(steady.force.x(), 0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Jets, Speed, testing::Values(10.0, 100.0, 400.0));

}  // namespace
}  // namespace splashdown
