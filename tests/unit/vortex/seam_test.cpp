// The fluid on a grid behind the seam: schemes agree, steps repeat, states are saved.
#include <gtest/gtest.h>

#include <sstream>

#include "bodies_in_grid.hpp"
#include "core/parallel.hpp"

namespace splashdown::vortex::seam_test {
namespace {

using scenes::coupled;
using scenes::FreeBody;

std::string saved(const coupling::Coupled& stepper) {
  std::ostringstream out;
  stepper.save(out);
  return out.str();
}

TEST(VortexSeam, partitioned_passes_come_to_the_exact_term) {
  const FreeBody scene{.density = 2, .h = 1. / 16, .half = 1.5};
  auto exact = coupled(scene), passes = coupled(scene, std::make_unique<coupling::IqnIls>(0.5, 0));
  for (int k = 0; k < 10; ++k) {
    exact.step(0.01);
    EXPECT_GT(passes.step(0.01).passes, 1);
  }
  const auto &a = exact.bodies->state(0).velocity, &b = passes.bodies->state(0).velocity;
  EXPECT_NEAR((a - b).norm(), 0, 1e-6 * a.norm());  // tolerance 1e-8 a step
}

// Explicit, as in the paper: the last step's load moves the body. Heavy bodies bear it.
TEST(VortexSeam, a_heavy_body_bears_the_papers_explicit_scheme) {
  const FreeBody scene{.density = 20, .h = 1. / 16, .half = 1.5, .passes = 1};
  auto exact = coupled(scene),
       staggered = coupled(scene, std::make_unique<coupling::ConstantRelaxation>(1.0), {.fixed_passes = 1});
  for (int k = 0; k < 20; ++k) {
    exact.step(0.01);
    EXPECT_EQ(staggered.step(0.01).passes, 1);
  }
  const double a = exact.bodies->state(0).velocity[1], b = staggered.bodies->state(0).velocity[1];
  EXPECT_NEAR(a, b, 0.05 * std::abs(a));
}

TEST(VortexSeam, a_step_that_is_repeated_or_refused_leaves_no_trace) {
  const FreeBody scene{.density = 0.3, .h = 1. / 16, .half = 1.5};
  auto once = coupled(scene), twice = coupled(scene);
  for (int k = 0; k < 6; ++k) {
    once.step(0.01);
    ASSERT_TRUE(twice.stepper->attempt(0.02).ok());
    ASSERT_TRUE(twice.stepper->attempt(0.01).ok());
    twice.step(0.01);
  }
  EXPECT_EQ(saved(*once.stepper), saved(*twice.stepper));
}

TEST(VortexSeam, goes_on_from_what_was_saved_with_the_same_bits) {
  const FreeBody scene{.outline = scenes::box(1, 0.3), .density = 0.3, .angle = 0.4, .h = 1. / 20, .half = 1.5};
  auto straight = coupled(scene), resumed = coupled(scene);
  for (int k = 0; k < 6; ++k) straight.step(0.01);
  std::istringstream in(saved(*straight.stepper));
  resumed.stepper->load(in);
  for (int k = 0; k < 4; ++k) {
    straight.step(0.01);
    resumed.step(0.01);
  }
  EXPECT_EQ(saved(*straight.stepper), saved(*resumed.stepper));
}

TEST(VortexSeam, results_do_not_depend_on_threads) {
  const FreeBody scene{.density = 0.3, .h = 1. / 24, .half = 1.5};
  std::string states[2];
  for (const int count : {1, 2}) {
    use_threads(count);
    auto made = coupled(scene);
    for (int k = 0; k < 4; ++k) made.step(0.01);
    states[count - 1] = saved(*made.stepper);
  }
  EXPECT_EQ(states[0], states[1]);
}

// Until it is released a body has coordinates, and no modes.
TEST(VortexSeam, a_body_that_is_held_has_no_modes) {
  Participant fluid(std::make_unique<GridFlow>(FreeBody{.h = 1. / 16, .half = 1.5}.fluid()));
  coupling::InterfaceModel model;
  model.modal.modes.resize(3, 0);
  model.modal.inertia.resize(0, 0);
  ASSERT_TRUE(fluid.begin({0.01, 0.02}, model).ok());
  coupling::Velocities moves(3);
  moves << 1, 0, 0;
  ASSERT_TRUE(fluid.solve({.velocities = moves}).ok());
  EXPECT_EQ(fluid.solution().velocities, moves);
  EXPECT_LT(fluid.solution().impulse[0], 0);
}

TEST(VortexSeam, refuses_walls_and_operators_that_it_does_not_know) {
  Participant fluid(std::make_unique<GridFlow>(FreeBody{}.fluid()));
  coupling::InterfaceModel model;
  model.interface_operators = {{.laplacian = 1, .robin = 0}};
  EXPECT_THROW(fluid.begin({0.01, 0.02}, model), std::invalid_argument);
  EXPECT_THROW(fluid.solve({.velocities = coupling::Velocities::Zero(4)}), std::invalid_argument);
}

}  // namespace
}  // namespace splashdown::vortex::seam_test
