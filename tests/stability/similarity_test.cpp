// Laws of similarity: turned scenes, scaled lengths and densities give the same answer.
#include <gtest/gtest.h>

#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

namespace scenes = coupling::scenes;
using Vec = Eigen::Vector2d;

struct Motion {
  Vec velocity;
  double spin;
  double time;
};

Motion after(const scenes::Scene& scene, double until, double dt) {
  const auto stepper = scenes::coupled(scene);
  while (stepper->time() < until * (1 - 1e-9)) {
    const auto report = stepper->attempt(dt);
    EXPECT_TRUE(report.ok()) << report.cause;
    stepper->commit();
  }
  const auto& s = stepper->bodies().state(0);
  return {s.velocity.head<2>(), s.velocity[2], stepper->time()};
}

scenes::Scene pitched_capsule(double height) {
  scenes::Scene s;
  s.fluid = fluid::scenes::still_water(4, 2, 0.3);
  s.fluid.size = {.surface = 0.06, .far = 0.3, .growth = 0.2};
  s.add_body(rigid::capsule(0.15, 0.4, 64), 60, {0.1, height}, 0.03, 0.3);
  s.set_velocity(0, {0.3, -1, 0.5});
  return s;
}

TEST(Turned, a_scene_gives_the_same_motion_in_its_own_frame) {
  const auto scene = pitched_capsule(0.1);  // part of it is in the water from the start
  const double until = 0.06, dt = 1e-3;
  const Motion upright = after(scene, until, dt);
  // The water's impulse over the mass: what made the motion differ from free flight.
  const double push = (upright.velocity - Vec(0.3, -1 - scenes::g * until)).norm(), gyration = 0.2;
  EXPECT_GT(push, 0.5) << "the water acts";
  for (double degrees : {37.0, 90.0, 180.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Motion turned = after(scene.turned(angle), until, dt);
    const Vec back = Eigen::Rotation2Dd(-angle) * turned.velocity;
    // Meshes differ by the ties of the triangulation: the scatter of the loads, some per cent of the impulse.
    EXPECT_LE((back - upright.velocity).norm(), 0.02 * push) << degrees;
    EXPECT_NEAR(turned.spin, upright.spin, 0.02 * push / gyration) << degrees;
  }
}

TEST(Turned, a_submerged_circle_rises_along_gravity) {
  const auto scene = scenes::submerged_circle(0.3);
  const Motion upright = after(scene, 0.02, 2e-3);
  const double angle = 37 * std::numbers::pi / 180;
  const Motion turned = after(scene.turned(angle), 0.02, 2e-3);
  const double push = upright.velocity.y() + scenes::g * 0.02;
  EXPECT_LE((Eigen::Rotation2Dd(-angle) * turned.velocity - upright.velocity).norm(), 0.01 * push);
}

// Lengths times 4^k and times 2^k in time keep g; powers of two change no mantissa.
scenes::Scene scaled(scenes::Scene s, double length, double density) {
  const double speed = std::sqrt(length);
  const auto stretch = [&](auto& pose) { pose.translation() *= length; };
  for (auto& l : s.fluid.liquids) l.boundary.vertices *= length;
  s.fluid.density *= density;
  auto& size = s.fluid.size;
  size.surface *= length, size.far *= length, size.hollow_min *= length;
  s.fluid.step.dt_max *= speed;
  for (auto& w : s.fluid.walls) {
    w.surface.vertices *= length, w.size *= length;
    stretch(w.pose);
    w.velocity.head<2>() *= speed;
    w.velocity.tail<1>() /= speed;
  }
  for (auto& b : s.bodies) {
    b.surface.vertices *= length;
    b.mass *= density * length * length;
    b.inertia *= density * std::pow(length, 4);
    stretch(b.pose);
    b.velocity.head<2>() *= speed;
    b.velocity.tail<1>() /= speed;
  }
  return s;
}

class Scale : public testing::TestWithParam<std::pair<int, int>> {
 protected:
  const double length = std::pow(4.0, GetParam().first), density = std::pow(2.0, GetParam().second),
               time = std::sqrt(length);
};

TEST_P(Scale, of_length_and_density_changes_nothing_but_units) {
  const auto scene = pitched_capsule(0.1);
  const double until = 0.03;
  const Motion here = after(scene, until, 1e-3),
               there = after(scaled(scene, length, density), until * time, 1e-3 * time);
  EXPECT_NEAR(there.time, here.time * time, 1e-12 * time);
  // Elimination of freedoms with different units picks other pivots: roundoff, then ties of the
  // triangulation, hence the scatter of the loads; some per cent of the water's impulse.
  const double push = (here.velocity - Vec(0.3, -1 - scenes::g * until)).norm(), gyration = 0.2;
  EXPECT_LE((there.velocity / time - here.velocity).norm(), 0.02 * push);
  EXPECT_NEAR(there.spin * time, here.spin, 0.02 * push / gyration);
}

TEST_P(Scale, leaves_each_bit_of_a_collapsing_column) {
  const auto column = [](double L, double rho, double T) {
    scenes::Scene s;
    s.fluid = fluid::scenes::still_water(2, 0.5, 0.1);
    s.fluid.liquids[0].boundary = fluid::scenes::rectangle({-1, -0.5}, {-0.5, 0.25});
    s = scaled(s, L, rho);
    coupling::scenes::Watched<2> stepper(
        std::make_unique<fluid::Fluid<2>>(s.fluid, fluid::scenes::gravity({0, -scenes::g})));
    for (int i = 0; i < 40; ++i) {
      EXPECT_TRUE(stepper.attempt(std::min(stepper.stable_dt(), 0.005 * T)).ok());
      stepper.commit();
    }
    return stepper.fluid().nodes();
  };
  const auto here = column(1, 1, 1), there = column(length, density, time);
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t i = 0; i < here.size(); ++i) {
    EXPECT_EQ(here.x[i] * length, there.x[i]);
    EXPECT_EQ(here.v[i] * time, there.v[i]);
    EXPECT_EQ(here.p[i] * length * density, there.p[i]);
  }
}
// From millimetres to a hundred metres, from a thousandth to ten thousand kg/m^3.
INSTANTIATE_TEST_SUITE_P(Powers, Scale,
                         testing::Values(std::pair(-4, 0), std::pair(3, 0), std::pair(0, -20), std::pair(0, 4),
                                         std::pair(-3, -10)));

}  // namespace
}  // namespace splashdown
