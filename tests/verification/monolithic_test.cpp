// Both formulations on jets and on bodies set free: what is exact for one is exact for the other.
#include <gtest/gtest.h>

#include "tests/unit/coupling/scenes.hpp"
#include "tests/unit/coupling/watched.hpp"

namespace splashdown::monolithic_test {
namespace {

namespace scenes = coupling::scenes;
using Vec = Eigen::Vector2d;
using scenes::water;

constexpr double width = 0.1;

struct Way {
  const char* name;
  fluid::Formulation<2> (*make)();
};
fluid::Formulation<2> fractional_way() { return fluid::fractional<2>(); }
fluid::Formulation<2> monolithic_way() { return fluid::monolithic<2>(); }

// A jet with a flat end, so many widths long, that touches a plate.
scenes::Watched<2> jet(const Way& way, double elements, double speed, double widths = 5) {
  fluid::FluidSpec<2> spec;
  spec.size = {.surface = width / elements, .far = width / elements};
  spec.step.dt_max = 0.3 * width / elements / speed;
  spec.walls.push_back({.name = "plate",
                        .surface = fluid::scenes::rectangle({-20 * width, -width}, {20 * width, 0}),
                        .size = width / elements});
  spec.liquids.push_back({fluid::scenes::rectangle({-0.5 * width, 0}, {0.5 * width, widths * width}),
                          [speed](const auto&) { return Vec(0, -speed); }});
  return scenes::Watched<2>(
      std::make_unique<fluid::Fluid<2>>(std::move(spec), fluid::scenes::no_effects(), way.make()));
}

class Formulations : public testing::TestWithParam<Way> {};

// Pressure impulse of potential flow that stops at once at its end: 4 G / pi^2 rho u b in the centre, with Catalan's constant G,
// 7 zeta(3) / pi^3 rho u b^2 on the plate; five widths are endless to 1e-6. Linear elements, second order but for the corners of
// the jet: 0.5 % at a twentieth of the width, whatever the step, as an impulse takes no time.
TEST_P(Formulations, the_first_instant_of_a_flat_end_is_the_exact_impulse_whatever_the_step) {
  const double speed = 10;
  for (const double dt : {1e-4, 1e-6}) {
    auto stepper = jet(GetParam(), 20, speed);
    ASSERT_TRUE(stepper.attempt(dt).ok());
    const auto& fluid = stepper.fluid();
    const double kick = 0.5 * dt;
    double centre = 0, nearest = width;
    for (std::size_t i = 0; i < fluid.nodes().size(); ++i)
      if (const double distance = fluid.nodes().x[i].norm(); distance < nearest)
        nearest = distance, centre = kick * fluid.repair_pressure()[i];
    EXPECT_NEAR(centre / (water * speed * width), 0.371227, 0.005 * 0.371227);
    const double total = -kick * fluid.result().loads[0].repair[1];
    EXPECT_NEAR(total / (water * speed * width * width), 0.271377, 0.005 * 0.271377);
  }
}

// Without gravity and viscosity the speed is a unit of time: powers of two change no digit, others round.
TEST_P(Formulations, a_jet_of_forty_times_the_speed_is_the_same_flow) {
  const auto force = [&](double speed) {
    auto stepper = jet(GetParam(), 8, speed);
    double dt = 0.01 * width / 8 / speed;
    for (int k = 0; k < 20; ++k) {
      dt = std::min(stepper.stable_dt(), 1.5 * dt);
      EXPECT_TRUE(stepper.attempt(dt).ok());
      stepper.commit();
    }
    return stepper.fluid().result().loads[0].total()[1] / (water * speed * speed * width);
  };
  const double slow = force(10);
  EXPECT_EQ(force(320), slow);
  EXPECT_NEAR(force(400), slow, 1e-6 * std::abs(slow));
}

INSTANTIATE_TEST_SUITE_P(Both, Formulations,
                         testing::Values(Way{"fractional", fractional_way}, Way{"monolithic", monolithic_way}),
                         [](const auto& info) { return info.param.name; });

// Every node of the surface has a pressure: steps make 1e-6 of the volume of a jet of ten widths a width of travel at most, where
// the default, which holds the tips of the sheets to p = 0, makes a hundred times that.
TEST(Monolithic, a_jet_keeps_its_volume) {
  const double speed = 10, length = 10;
  auto stepper = jet({"monolithic", monolithic_way}, 10, speed, length);
  double dt = 0.01 * width / 10 / speed, from = -1, made = 0;
  while (stepper.time() < 2 * width / speed) {
    dt = std::min(stepper.stable_dt(), 1.5 * dt);
    while (!stepper.attempt(dt).ok()) ASSERT_GT(dt *= 0.5, 1e-9);
    stepper.commit();
    if (from < 0 && stepper.time() > width / speed)
      from = stepper.time(), made = stepper.fluid().ledger().time_integration;
  }
  const double widths = (stepper.time() - from) * speed / width;
  EXPECT_LE(std::abs(stepper.fluid().ledger().time_integration - made), 1e-6 * widths * length * width * width);
}

}  // namespace
}  // namespace splashdown::monolithic_test
