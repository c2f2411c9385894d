// Sticking walls in whole steps: the pressure does not move what the wall holds.
#include <gtest/gtest.h>

#include <algorithm>

#include "basin.hpp"
#include "fluid/viscosity.hpp"

namespace splashdown::fluid {
namespace {

using testing::Basin;

TEST(NoSlip, still_water_stays_still) {
  auto stepper =
      testing::water(Basin{.size = 0.1, .sticks = true}, testing::gravity(), std::make_unique<Viscosity<2>>(1.0));
  double fastest = 0;
  ASSERT_TRUE(testing::run(stepper, 0.5,
                           [&](const auto& fluid, double) { fastest = std::max(fastest, testing::max_speed(fluid)); }));
  EXPECT_LT(fastest, 1e-10);  // sqrt(g h) times roundoff of some fifty direct solves
}

TEST(NoSlip, nodes_keep_their_place_below_the_surface_and_slide_on_slip_walls) {
  for (const bool sticks : {true, false}) {
    auto stepper = testing::water(Basin{.size = 0.1, .amplitude = 0.05, .sticks = sticks}, testing::gravity(),
                                  std::make_unique<Viscosity<2>>(1.0));
    double farthest = 0;
    std::vector<Vec<2>> before;
    std::vector<char> held;
    // Nodes are renumbered only when the mesh adapts, in attempt().
    while (stepper.time() < 0.2) {
      const double dt = stepper.stable_dt();
      ASSERT_TRUE(stepper.attempt(dt).ok());
      const auto& nodes = stepper.fluid().nodes();
      before = nodes.x;
      held.resize(nodes.size());
      for (std::size_t i = 0; i < nodes.size(); ++i)
        held[i] = nodes.tie[i].wall >= 0 && nodes.tie[i].vertex < 0 && !nodes.surface[i];
      stepper.commit();
      for (std::size_t i = 0; i < before.size(); ++i)
        if (held[i]) farthest = std::max(farthest, (stepper.fluid().nodes().x[i] - before[i]).norm() / dt);
    }
    if (sticks)
      EXPECT_LT(farthest, 1e-12);
    else
      EXPECT_GT(farthest, 0.01);
  }
}

// What is lost is lost in the cells of the contact line, between a node that slips and one that sticks: an area
// that goes as h^2.
TEST(NoSlip, volume_error_is_of_second_order) {
  auto error = [](double size) {
    auto stepper = testing::water(Basin{.size = size, .amplitude = 0.03, .sticks = true}, testing::gravity(),
                                  std::make_unique<Viscosity<2>>(1.0));
    EXPECT_TRUE(testing::run(stepper, 0.4, [](const auto&, double) {}));
    const auto& ledger = stepper.fluid().ledger();
    return std::abs(ledger.volume / ledger.volume_initial - 1);
  };
  const double coarse = error(0.05), fine = error(0.025);
  EXPECT_LT(fine, 2e-3);
  EXPECT_LT(fine, 0.5 * coarse);
}

// The rate of change of the fluid's momentum is its weight less the load on the tank. Loads are means over a
// kick of the discrete equation, so this holds to the lumped mass of nodes that walls hold.
TEST(NoSlip, the_tank_feels_what_stops_the_water) {
  auto stepper = testing::water(Basin{.size = 0.05, .amplitude = 0.03, .sticks = true}, testing::gravity(),
                                std::make_unique<Viscosity<2>>(5.0));
  ASSERT_TRUE(testing::run(stepper, 0.4, [&](const auto& fluid, double) {
    const double weight = 9.81 * 1000 * fluid.ledger().volume;
    EXPECT_NEAR(fluid.loads()[0].total()[1], -weight, 0.1 * weight);
  }));
}

TEST(NoSlip, more_energy_is_lost_than_between_slip_walls) {
  auto energy = [](bool sticks) {
    const Basin basin{.length = 1, .depth = 0.2, .size = 0.04, .amplitude = 0.01, .sticks = sticks};
    auto stepper = testing::water(basin, testing::gravity(), std::make_unique<Viscosity<2>>(1.0));
    double late = 0;
    EXPECT_TRUE(testing::run(stepper, 1.2, [&](const auto& fluid, double) {
      if (fluid.time() > 0.8) late = std::max(late, testing::kinetic_energy(fluid));
    }));
    return late;
  };
  EXPECT_LT(energy(true), 0.9 * energy(false));
}

}  // namespace
}  // namespace splashdown::fluid
