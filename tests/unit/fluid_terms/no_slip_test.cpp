// Sticking walls in whole steps: the pressure does not move what the wall holds.
#include <gtest/gtest.h>

#include <algorithm>

#include "basin.hpp"
#include "fluid/effects/viscosity/viscosity.hpp"

namespace splashdown::fluid::no_slip_test {
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

// Fastest node on the floor, over the fastest of all. Beside the surface the contact line, which slips, takes its neighbours along.
double slip_over_speed(bool sticks, double viscosity) {
  auto stepper = testing::water(Basin{.size = 0.05, .amplitude = 0.05, .sticks = sticks}, testing::gravity(),
                                std::make_unique<Viscosity<2>>(viscosity));
  double on_wall = 0, fastest = 0;
  EXPECT_TRUE(testing::run(stepper, 0.2, [&](const auto& fluid, double) {
    const auto& nodes = fluid.nodes();
    double floor = 0;
    for (const auto& x : nodes.x) floor = std::min(floor, x.y());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (nodes.tie[i].wall >= 0 && !nodes.tie[i].sharp() && nodes.x[i].y() < floor + 1e-9)
        on_wall = std::max(on_wall, nodes.v[i].norm());
    fastest = std::max(fastest, testing::max_speed(fluid));
  }));
  return on_wall / fastest;
}

// The layer that a wall stops is (nu t)^(1/2) thick: 0.14 m with 100 Pa s, three elements, and 0.4 mm with 1e-3. Water slips on
// a layer of h / 8, a twentieth of it, and more in the first steps, when the layer is thin.
TEST(NoSlip, water_sticks_where_elements_resolve_its_layer_and_slips_where_they_do_not) {
  EXPECT_LT(slip_over_speed(true, 100), 0.15 * slip_over_speed(false, 100));
  const double free = slip_over_speed(false, 1e-3);
  EXPECT_NEAR(slip_over_speed(true, 1e-3), free, 0.01 * free);
}

TEST(NoSlip, volume_is_kept_as_between_slip_walls) {
  auto error = [](bool sticks) {
    auto stepper = testing::water(Basin{.size = 0.05, .amplitude = 0.03, .sticks = sticks}, testing::gravity(),
                                  std::make_unique<Viscosity<2>>(1.0));
    EXPECT_TRUE(testing::run(stepper, 0.4, [](const auto&, double) {}));
    const auto& ledger = stepper.fluid().ledger();
    return std::abs(ledger.volume / ledger.volume_initial - 1);
  };
  EXPECT_LT(error(true), error(false) + 1e-4);  // nodes of the contact line slip past those that stick: O(h^2 dx)
}

// The rate of change of the fluid's momentum is its weight less the load on the tank. Loads are means over a
// kick of the discrete equation, so this holds to the lumped mass of nodes that walls hold.
TEST(NoSlip, the_tank_feels_what_stops_the_water) {
  auto stepper = testing::water(Basin{.size = 0.05, .amplitude = 0.03, .sticks = true}, testing::gravity(),
                                std::make_unique<Viscosity<2>>(5.0));
  ASSERT_TRUE(testing::run(stepper, 0.4, [&](const auto& fluid, double) {
    const double weight = 9.81 * 1000 * fluid.ledger().volume;
    EXPECT_NEAR(fluid.result().loads[0].total()[1], -weight, 0.1 * weight);
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
}  // namespace splashdown::fluid::no_slip_test
