// Bodies that move wildly or hardly at all: elements stay upright, books close, bodies gain no energy.
#include <gtest/gtest.h>

#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

namespace scenes = coupling::scenes;
using Vec = Eigen::Vector2d;
using scenes::g;
using scenes::water;

// Steps as a run takes them: a refused one is halved.
bool step(coupling::scenes::Watched<2>& stepper, double& dt, double most) {
  dt = std::min({stepper.stable_dt(), 1.5 * dt, most});
  return scenes::attempt_halving(stepper, dt, 12).ok();
}

// Of a body at t_n of an attempted step; its velocity is the mean of the two half steps.
double energy(const coupling::scenes::Watched<2>& stepper, std::size_t body) {
  const auto& spec = stepper.bodies().spec(body);
  const auto& s = stepper.bodies().state(body);
  const rigid::Twist<2> mean = 0.5 * (s.velocity + stepper.trial()[body].velocity);
  return 0.5 * spec.mass * mean.head<2>().squaredNorm() + 0.5 * spec.inertia(0, 0) * mean[2] * mean[2] +
         spec.mass * g * s.pose.translation().y();
}

// Water at rest has no energy to give: a body that falls in has its own at most, at any time. Leapfrog flight keeps it
// to roundoff; a thousandth allows for what kinetic energy a coarse mesh may seem to lack.
void survives(const scenes::Scene& scene, double until) {
  const auto stepper = scenes::coupled(scene);
  double dt = 1e-4, brought = 0;
  while (stepper->time() < until) {
    ASSERT_TRUE(step(*stepper, dt, 2e-3)) << stepper->time();
    const auto& f = stepper->fluid();
    for (const auto& cell : f.mesh().cells) ASSERT_GT(fluid::volume<2>(fluid::corners(f.nodes().x, cell)), 0);
    if (stepper->time() == 0) brought = energy(*stepper, 0);
    ASSERT_LE(energy(*stepper, 0), 1.001 * brought) << stepper->time();
    stepper->commit();
  }
  EXPECT_GT(stepper->fluid().result().loads[0].wetted, 0);
  const auto& l = stepper->fluid().ledger();
  EXPECT_NEAR(l.volume, l.volume_initial + l.time_integration + l.remesh_created + l.remesh_deleted + l.returned,
              1e-12 * l.volume_initial);
}

scenes::Scene box_over_water(const Vec& centre, double pitch, const rigid::Twist<2>& velocity) {
  scenes::Scene s;
  s.fluid = fluid::scenes::still_water(3, 1, 0.15);
  s.fluid.size = {.surface = 0.05, .far = 0.15, .growth = 0.2};
  s.add_body(rigid::box(0.4, 0.15), 20, centre, 0.025, pitch);
  s.set_velocity(0, velocity);
  return s;
}

TEST(LightBox, that_skips_obliquely_keeps_the_books) { survives(box_over_water({-0.9, 0.12}, 0.15, {5, -1, 0}), 0.15); }

TEST(LightBox, that_cartwheels_into_the_water_keeps_the_books) {
  survives(box_over_water({-0.5, 0.25}, 0.5, {2, -2, -10}), 0.2);
}

TEST(LightBox, that_rolls_over_in_the_water_keeps_the_books) {
  survives(box_over_water({0, 0.22}, 0, {0, -2, 20}), 0.4);
}

// Two equal boxes afloat in equilibrium, half an element of water between them: nothing moves. Hydrostatic pressure
// is a solution of the discrete equations; what remains is roundoff, times the condition, about 1e3.
TEST(Boxes, afloat_side_by_side_stay_at_rest) {
  scenes::Scene s;
  s.fluid = fluid::scenes::still_water(2, 1, 0.1);
  s.fluid.size = {.surface = 0.05, .far = 0.1, .growth = 0.2};
  const double breadth = 0.4, draft = 0.1, gap = 0.0125;
  for (double side : {-1.0, 1.0})
    s.add_body(rigid::box(breadth, 0.3), water * breadth * draft, {side * 0.5 * (breadth + gap), 0.15 - draft}, 0.025);
  const auto stepper = scenes::coupled(s);
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(stepper->attempt(2e-3).ok()) << i;
    stepper->commit();
  }
  for (std::size_t b = 0; b < 2; ++b) EXPECT_LE(stepper->bodies().state(b).velocity.norm(), 1e-9 * std::sqrt(g));
}

}  // namespace
}  // namespace splashdown
