// Hulls whose tips are as tight as the elements at them are long.
#include <gtest/gtest.h>

#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

namespace scenes = coupling::scenes;
using Vec = Eigen::Vector2d;
using scenes::g;
using scenes::water;

double perimeter(const fluid::Surface<2>& s) {
  double sum = 0;
  for (Eigen::Index f = 0; f < s.facets.cols(); ++f)
    sum += (s.vertices.col(s.facets(1, f)) - s.vertices.col(s.facets(0, f))).norm();
  return sum;
}

// A facet is a chord of at most 1.5 h, before it is split, and h of at most half the radius r: shorter than its arc by
// L^2 / 24 r^2.
const double chords = std::pow(1.5 * 0.5, 2) / 24;

// The ellipse is in the middle of a basin, its centre `depth` below the surface.
scenes::Scene submerged(double a, double b, double size, double density, double depth, double pitch) {
  scenes::Scene s;
  s.fluid = fluid::scenes::still_water(16 * a, 2 * depth, 0.8 * a);
  s.fluid.size = {.surface = 0.8 * a, .far = 0.8 * a, .growth = 0.2};
  const auto shape = rigid::ellipse(a, b);
  s.add_body(shape, density * shape.at_unit_density.mass, Vec(0, -depth), size, pitch);
  return s;
}

class TurningEllipse : public testing::TestWithParam<bool> {};

// The tip's radius is 0.08 m, two elements. Without the weight of the water the flow sucks at the tips, but no air gets
// there.
TEST_P(TurningEllipse, stays_wet_all_around) {
  auto scene = submerged(0.5, 0.2, 0.04, 1e6 * water, 4, 0);
  scene.bodies[0].free = {false, false, false};
  scene.set_velocity(0, {0, 0, std::numbers::pi / 2});
  if (!GetParam()) scene.gravity.setZero();
  const auto stepper = scenes::coupled(scene);
  const double whole = perimeter(scene.fluid.walls[0].surface);
  double dt = 1e-3;
  while (stepper->time() < 2) {
    dt = std::min(stepper->stable_dt(), 1.5 * dt);
    ASSERT_TRUE(stepper->attempt(dt).ok());
    const double wetted = stepper->fluid().result().loads[0].wetted;
    ASSERT_LE(wetted, whole * (1 + 1e-9)) << stepper->time();
    ASSERT_GE(wetted, whole * (1 - chords)) << stepper->time();
    stepper->commit();
  }
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutGravity, TurningEllipse, testing::Bool());

// Elements as long as the tips are tight: nodes that slide around them change what the facets enclose. The water has not
// become more or less by it, so that nothing is owed to its surface but what nodes lose on curved paths: of the chords'
// changes a share of the angle that the hull turns by in a step.
TEST(TurningEllipse, of_coarse_facets_leaves_the_surface_where_it_is) {
  auto scene = submerged(0.5, 0.2, 0.08, 1e6 * water, 4, 0);
  scene.bodies[0].free = {false, false, false};
  const double rate = std::numbers::pi / 2, dt = 0.01, turned = rate * dt;
  scene.set_velocity(0, {0, 0, rate});
  const auto stepper = scenes::coupled(scene);
  const auto enclosed = [&] {
    const auto& view = stepper->fluid();
    return fluid::enclosed_volume(view.mesh().boundary, view.nodes().x);
  };
  double last = enclosed(), changes = 0;
  while (stepper->time() < 2) {
    ASSERT_TRUE(stepper->attempt(std::min(dt, stepper->stable_dt())).ok());
    stepper->commit();
    changes += std::abs(enclosed() - last), last = enclosed();
  }
  const auto& ledger = stepper->fluid().ledger();
  EXPECT_GT(changes, 1e-2 * std::numbers::pi * 0.5 * 0.2) << "of the hull: chords as long as the tip is tight";
  EXPECT_LT(std::abs(ledger.returned), turned * changes);
  EXPECT_NEAR(last + ledger.hull_chords, ledger.volume_initial, turned * changes);
}

// A buoyant plate with a tip radius of one element's length, hinged at its end. Water and plate have no other energy than
// what buoyancy gives them; what the mesh makes of the hull is smaller than the hull by its chords.
TEST(HingedPlate, gets_no_more_energy_than_its_buoyancy_gives) {
  const double a = 0.25, b = 0.05, pitch = std::numbers::pi / 6, depth = 2;
  auto scene = submerged(a, b, 0.01, water / 3, depth, pitch);
  const Vec end = Vec(0, -depth) - a * Vec(std::cos(pitch), std::sin(pitch));
  scene.joints.push_back({.type = rigid::JointType::hinge, .body = 0, .point = {end.x(), end.y(), 0}});
  const auto stepper = scenes::coupled(scene);
  const auto& body = scene.bodies[0];
  const double lift = (std::numbers::pi * a * b * water - body.mass) * g;
  const double whole = perimeter(scene.fluid.walls[0].surface);
  double dt = 1e-3;
  while (stepper->time() < 0.4) {
    dt = std::min(stepper->stable_dt(), 1.5 * dt);
    ASSERT_TRUE(stepper->attempt(dt).ok());
    const auto& state = stepper->bodies().state(0);
    const rigid::Twist<2> s = 0.5 * (state.velocity + stepper->fluid().result().wall_velocities[0].rigid);
    const double kinetic = 0.5 * body.mass * s.head<2>().squaredNorm() + 0.5 * body.inertia(0, 0) * s[2] * s[2] +
                           stepper->fluid().ledger().kinetic_energy;
    const double work = lift * (state.pose.translation().y() + depth);
    ASSERT_LE(kinetic, work * (1 + chords) + 1e-3 * lift * a) << stepper->time();
    ASSERT_GE(stepper->fluid().result().loads[0].wetted, whole * (1 - chords)) << stepper->time();
    stepper->commit();
  }
  EXPECT_GE(stepper->bodies().state(0).velocity[2], 1) << "it swings: 1.4 rad/s in a fluid without vortices";
}

}  // namespace
}  // namespace splashdown
