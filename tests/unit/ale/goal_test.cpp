// Errors of loads by the adjoint: against loads of much finer meshes, and what refinement by them saves.
#include <gtest/gtest.h>

#include <limits>

#include "flows.hpp"

namespace splashdown::ale::goal_test {
namespace {

/// A body in a channel, a little off its middle.
AleFlowSpec channel(Surface<2> outline, double far) {
  AleFlowSpec spec{.density = 1, .viscosity = 0.02, .min = {0, 0}, .max = {2, 1}};
  spec.sides = {BoundaryKind::inflow, BoundaryKind::outflow, BoundaryKind::no_slip, BoundaryKind::no_slip};
  spec.inflow = [](const Vec<2>& x, double) -> Vec<2> { return {4 * x.y() * (1 - x.y()), 0}; };
  spec.far = far;
  spec.growth = 1;
  spec.scheme.is_steady = true;
  spec.walls = {{.name = "body", .surface = std::move(outline), .pose = scenes::at(0.6, 0.46), .size = far / 2}};
  return spec;
}

std::unique_ptr<AleFlow> steady(const AleFlowSpec& spec) {
  auto flow = std::make_unique<AleFlow>(spec);
  double before = 0;
  scenes::step(*flow, 1, before);
  return flow;
}

const Vec<2> directions[] = {Vec<2>::UnitX(), Vec<2>::UnitY()};

TEST(LoadGoal, error_of_a_load_is_the_true_one) {
  const auto exact = steady(channel(scenes::circle(0.15), 0.025));
  for (const double far : {0.2, 0.14, 0.1}) {
    const auto flow = steady(channel(scenes::circle(0.15), far));
    for (const auto& direction : directions) {
      const auto goal = flow->load_goal(0, direction);
      const double error = goal.value - exact->loads()[0].physical.head<2>().dot(direction);
      EXPECT_GT(goal.error / error, 0.7) << far;
      EXPECT_LT(goal.error / error, 1.5) << far;
    }
  }
}

/// A mesh's unknowns, the load and its error as the adjoint tells it.
struct Told {
  int nodes;
  double value, error;
};
Told told(const AleFlowSpec& spec, const Vec<2>& direction) {
  const auto flow = steady(spec);
  const auto goal = flow->load_goal(0, direction);
  return {flow->mesh().size(), goal.value, goal.error};
}

// The flow is singular at the box's corners, where a mesh that is alike everywhere is of first order.
TEST(LoadGoal, refinement_by_it_takes_half_the_unknowns) {
  for (const auto& direction : directions) {
    auto spec = channel(scenes::box(0.2, 0.2), 0.2);
    spec.goals = {{.name = "load", .wall = 0, .direction = direction}};
    std::vector<Told> refined;
    for (int k = 0; k < 8; ++k, spec = adapted(spec, 1, 1, 0)) refined.push_back(told(spec, direction));
    const double exact = refined.back().value - refined.back().error;
    // Errors of single meshes pass through zero: the root of the mean square of three is what such meshes have.
    double squares = 0, nodes = 0;
    for (const double far : {0.05, 0.042, 0.036}) {
      const auto alike = steady(channel(scenes::box(0.2, 0.2), far));
      squares += std::pow(alike->loads()[0].physical.head<2>().dot(direction) - exact, 2) / 3;
      nodes += alike->mesh().size() / 3.;
    }
    double least = std::numeric_limits<double>::infinity();
    for (const auto& mesh : refined)
      if (2 * mesh.nodes <= nodes) least = std::min(least, std::abs(mesh.value - exact));
    EXPECT_LT(least, std::sqrt(squares));
    for (std::size_t k = 4; k + 1 < refined.size(); ++k) {
      const double effectivity = refined[k].error / (refined[k].value - exact);
      EXPECT_GT(effectivity, 0.7) << k;
      EXPECT_LT(effectivity, 1.5) << k;
    }
  }
}

}  // namespace
}  // namespace splashdown::ale::goal_test
