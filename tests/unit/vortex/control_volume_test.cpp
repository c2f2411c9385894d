// Loads of bodies by what happens on a rectangle around them, beside those of the penalty.
#include "fluid/vortex/control_volume.hpp"

#include <gtest/gtest.h>

#include "bodies_in_grid.hpp"

namespace splashdown::vortex::control_volume_test {
namespace {

double of(const GridFlow& fluid, const std::string& name) {
  for (const auto& [key, value] : fluid.diagnostics())
    if (key == name) return value;
  throw std::runtime_error(name);
}

/// A cylinder that is held in a stream, or moved through still fluid, for so many steps; drag, lift and moment of both.
struct Loads {
  Wrench<2> penalty, control;
};
Loads loads_after(int steps, double h, const Vec<2>& stream, const Twist<2>& twist) {
  scenes::FreeBody scene{.h = h, .half = 3, .reynolds = 100};
  auto spec = scene.fluid();
  spec.gravity.setZero();
  spec.walls[0].velocity = twist;
  spec.walls[0].pose.translation() = Vec<2>(-0.5, 0);
  if (!stream.isZero()) spec.stream = [stream](double) { return stream; };
  GridFlow fluid(spec);
  const double dt = 0.4 * h;
  Isometry<2> pose = spec.walls[0].pose;
  Loads loads;
  for (int k = 0; k < steps; ++k) {
    EXPECT_EQ(fluid.begin(k == 0 ? 0.5 * dt : dt, dt, {}).cause, "");
    fluid.solve({&twist, 1});
    loads.penalty = fluid.loads()[0].physical;
    loads.control = Wrench<2>(of(fluid, "control_fx_body"), of(fluid, "control_fy_body"), of(fluid, "control_m_body"));
    pose = moved<2>(pose, twist, dt);
    fluid.commit({&pose, 1});
  }
  return loads;
}

void expect_near(const Loads& loads, double share) {
  const double size = loads.penalty.head<2>().norm();
  EXPECT_NEAR((loads.control - loads.penalty).head<2>().norm() / size, 0, share);
  EXPECT_NEAR((loads.control - loads.penalty)[2] / size, 0, share);  // of a body as long as one
}

TEST(ControlVolume, sees_the_loads_of_the_penalty) {
  constexpr double h = 1. / 24;
  expect_near(loads_after(38, h, {1, 0.2}, Twist<2>::Zero()), 0.01);
  expect_near(loads_after(38, h, {0, 0}, {1, 0.2, 0.7}), 0.02);
}

// The first step is an impact; where it does not fit there is none.
TEST(ControlVolume, is_exact_for_a_start_and_says_when_it_does_not_fit) {
  const auto start = loads_after(1, 1. / 24, {1, 0}, Twist<2>::Zero());
  EXPECT_NEAR(start.control[0], start.penalty[0], 0.01 * start.penalty[0]);
  scenes::FreeBody large{.h = 1. / 24, .half = 0.7};
  GridFlow fluid(large.fluid());
  EXPECT_TRUE(std::isnan(of(fluid, "control_fx_body")));
}

}  // namespace
}  // namespace splashdown::vortex::control_volume_test
