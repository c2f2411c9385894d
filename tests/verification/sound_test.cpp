// A jet whose flat end hits a plate, with sound: what the first instant presses with.
#include <gtest/gtest.h>

#include "fluid/effects/compressibility/compressibility.hpp"
#include "tests/unit/coupling/scenes.hpp"

namespace splashdown::sound_test {
namespace {

namespace scenes = coupling::scenes;
using Vec = Eigen::Vector2d;
using scenes::water;

constexpr double width = 0.1, size = width / 20, speed = 10, sound = 300;

std::unique_ptr<fluid::Effect<2>> with_sound(double c) {
  return std::make_unique<fluid::Compressibility<2>>(fluid::CompressibilitySpec{.bulk_modulus = water * c * c});
}

/// With these effects.
scenes::Watched<2> jet(const fluid::Formulation<2>& formulation, double u,
                       std::vector<std::unique_ptr<fluid::Effect<2>>> effects) {
  fluid::FluidSpec<2> spec;
  spec.size = {.surface = size, .far = size};
  spec.step.dt_max = 0.3 * size / u;
  spec.walls.push_back(
      {.name = "plate", .surface = fluid::scenes::rectangle({-20 * width, -width}, {20 * width, 0}), .size = size});
  spec.liquids.push_back(
      {fluid::scenes::rectangle({-0.5 * width, 0}, {0.5 * width, 3 * width}), [u](const auto&) { return Vec(0, -u); }});
  return scenes::Watched<2>(std::make_unique<fluid::Fluid<2>>(std::move(spec), std::move(effects), formulation));
}

// Mean pressure in the centre before sound comes in from the sides, over rho c u.
double plateau() {
  auto effects = fluid::scenes::no_effects();
  effects.push_back(with_sound(sound));
  auto stepper = jet(fluid::monolithic<2>(), speed, std::move(effects));
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

/// On the plate until the jet has travelled so many widths, over rho u b^2, in steps that grow from those of sound.
double impulse(const fluid::Formulation<2>& formulation, double u, double widths, double c) {
  auto effects = fluid::scenes::no_effects();
  if (c > 0) effects.push_back(with_sound(c));
  auto stepper = jet(formulation, u, std::move(effects));
  double sum = 0, before = 0, dt = 0.02 * size / u;
  while (stepper.time() * u < widths * width) {
    EXPECT_TRUE(stepper.attempt(dt).ok());
    sum -= stepper.fluid().result().loads[0].total()[1] * 0.5 * (before + dt);
    stepper.commit();
    before = dt, dt = std::min(1.2 * dt, 0.3 * size / u);
  }
  return sum / (water * u * width * width);
}

// Sound takes nothing of the jet's momentum. What swings with it is of the order of Mach's number.
TEST(Sound, leaves_the_impulse_of_a_flat_end_as_it_is) {
  for (const auto& formulation : {fluid::fractional<2>(), fluid::monolithic<2>()}) {
    EXPECT_NEAR(impulse(formulation, 5, 1, 1480) / impulse(formulation, 5, 1, 0), 1, 0.01);
    EXPECT_NEAR(impulse(formulation, 10, 1.95, 300) / impulse(formulation, 10, 1.95, 0), 1, 10.0 / 300);
  }
}

}  // namespace
}  // namespace splashdown::sound_test
