// A jet whose flat end hits a plate, with sound: what the first instant presses with.
#include <gtest/gtest.h>

#include "fluid/effects/compressibility/compressibility.hpp"
#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

namespace scenes = coupling::scenes;
using Vec = Eigen::Vector2d;
using scenes::water;

constexpr double width = 0.1, size = width / 20, speed = 10, sound = 300;

scenes::Watched<2> jet() {
  fluid::FluidSpec<2> spec;
  spec.size = {.surface = size, .far = size};
  spec.step.dt_max = 0.3 * size / speed;
  spec.walls.push_back(
      {.name = "plate", .surface = fluid::scenes::rectangle({-20 * width, -width}, {20 * width, 0}), .size = size});
  spec.liquids.push_back({fluid::scenes::rectangle({-0.5 * width, 0}, {0.5 * width, 3 * width}),
                          [](const auto&) { return Vec(0, -speed); }});
  auto effects = fluid::scenes::no_effects();
  effects.push_back(
      std::make_unique<fluid::Compressibility<2>>(fluid::CompressibilitySpec{.bulk_modulus = water * sound * sound}));
  return scenes::Watched<2>(
      std::make_unique<fluid::Fluid<2>>(std::move(spec), std::move(effects), fluid::monolithic<2>()));
}

// Mean pressure in the centre before sound comes in from the sides, over rho c u.
double plateau() {
  auto stepper = jet();
  const double dt = 0.5 * size / sound;
  double sum = 0, over = 0;
  for (double widths = 0; widths < 0.45; widths = stepper.time() * sound / width) {
    EXPECT_TRUE(stepper.attempt(dt).ok());
    const auto& fluid = stepper.fluid();
    std::size_t centre = 0;
    for (std::size_t i = 0; i < fluid.nodes().size(); ++i)
      if (fluid.nodes().x[i].norm() < fluid.nodes().x[centre].norm()) centre = i;
    if (widths > 0.1) sum += fluid.pressure()[centre] + fluid.repair_pressure()[centre], ++over;
    stepper.commit();
  }
  return sum / (over * water * sound * speed);
}

// rho c u until sound has come from the sides, half a width away. Single steps scatter about it by what a front between elements
// leaves of waves of few elements.
TEST(Sound, a_flat_end_presses_with_rho_c_u) { EXPECT_NEAR(plateau(), 1, 0.02); }

}  // namespace
}  // namespace splashdown
