// What is known of bodies before they run: loads of impacts by theory, their rest on still water.
#include "apps/run/foreseen.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "apps/check/cost.hpp"
#include "apps/scene/outlook/impact_theory.hpp"
#include "scenes.hpp"

namespace splashdown::apps::foreseen_test {
namespace {

using std::numbers::pi;

struct Case {
  const char* name;
  const char* shape;
  int dimension;
  double power;  ///< of the depth in the load
  double rise;   ///< Wagner's share of von Karman's load
};

constexpr double speed = 2, density = 1000;

Scene entering(const Case& of, const std::string& rest) {
  const bool plane = of.dimension == 2;
  const std::string low = plane ? "[-4, -4]" : "[-4, -4, -4]", high = plane ? "[4, 4]" : "[4, 4, 4]",
                    level = plane ? "[4, 0]" : "[4, 4, 0]", zero = plane ? "0, " : "0, 0, ";
  const double bottom = std::string(of.name) == "circle" || std::string(of.name) == "sphere" ? 0.5 : 0;
  return read_scene_text(
             "dimension = " + std::to_string(of.dimension) + "\n[time]\nend = 10\n[gravity]\nacceleration = [" + zero +
                 "-9.81]\n[tank]\nmin = " + low + "\nmax = " + high +
                 "\n[fluid]\ndensity = 1000\n[[fluid.region]]\nshape = \"box\"\nmin = " + low + "\nmax = " + level +
                 "\n[[body]]\nname = \"hull\"\nshape = " + of.shape + "\nposition = [" + zero + std::to_string(bottom) +
                 "]\nvelocity = [" + zero + "-2]\n" + rest,
             "scene.toml", {})
      .scene;
}

std::optional<ImpactTheory> theory_of_scene(const Scene& scene) {
  return impact_theory(scene.dimension == 2 ? outlook<2>(scene) : outlook<3>(scene));
}

constexpr Case cases[] = {{"wedge", "{type = \"wedge\", deadrise_deg = 30, breadth = 1}", 2, 1, pi* pi / 4},
                          {"circle", "{type = \"circle\", radius = 0.5}", 2, 0, 2},
                          {"cone", "{type = \"cone\", deadrise_deg = 30, radius = 0.5}", 3, 2, 64 / (pi * pi * pi)},
                          {"sphere", "{type = \"sphere\", radius = 0.5}", 3, 0.5, std::sqrt(1.5 * 1.5 * 1.5)}};

// At a prescribed speed F = V^2 dM_a/d(depth); early the width goes as a power of the depth, so the load does, and Wagner's is
// larger by the rise of the water to that power plus one. Round hulls leave the power at second order in depth/radius.
TEST(ImpactTheory, at_constant_speed_is_a_power_of_the_depth) {
  for (const auto& of : cases) {
    const auto theory = theory_of_scene(entering(of, "motion = \"prescribed\"\n"));
    ASSERT_TRUE(theory) << of.name;
    const auto& t = theory->time;
    const std::size_t early = 4, later = 9;
    EXPECT_NEAR(std::log(theory->karman[later] / theory->karman[early]) / std::log(t[later] / t[early]), of.power, 0.06)
        << of.name;
    EXPECT_NEAR(theory->wagner[early] / theory->karman[early], of.rise, 0.06 * of.rise) << of.name;
  }
  const auto wedge = theory_of_scene(entering(cases[0], "motion = \"prescribed\"\n"));
  const double tangent = std::tan(pi / 6);
  for (std::size_t i = 10; i < wedge->time.size(); ++i)
    EXPECT_NEAR(wedge->karman[i], pi * density * speed * speed * speed * wedge->time[i] / (tangent * tangent),
                0.01 * wedge->karman[i]);
}

// What the water gains the body loses: the impulse of the load is M_a V, V = V_0 / (1 + M_a/m).
TEST(ImpactTheory, of_a_free_body_keeps_momentum) {
  const auto theory = theory_of_scene(entering(cases[0], "mass = 100\nfree = [\"y\"]\n"));
  ASSERT_TRUE(theory);
  double impulse = 0.5 * theory->wagner[0] * theory->time[0];
  for (std::size_t i = 1; i < theory->time.size(); ++i)
    impulse += 0.5 * (theory->wagner[i] + theory->wagner[i - 1]) * (theory->time[i] - theory->time[i - 1]);
  const double added = pi / 2 * density * 0.25;  // at its full width
  EXPECT_NEAR(impulse, added * speed / (1 + added / 100), 0.01 * impulse);
}

TEST(ImpactTheory, has_nothing_to_say_of_other_shapes_and_of_hulls_that_are_turned) {
  const Case box{"box", "{type = \"box\", width = 1, height = 1}", 2, 0, 0};
  EXPECT_FALSE(theory_of_scene(entering(box, "motion = \"prescribed\"\n")));
  EXPECT_FALSE(theory_of_scene(entering(cases[0], "motion = \"prescribed\"\npitch_deg = 10\n")));
}

// A contact line meets each element of the hull once, and passes cfl of one a step: 1 m of bottom with elements of 1 cm takes 200 steps.
// A bottom that lies flat is wet at once; what is left are the steps of its speed.
TEST(Cost, has_the_steps_that_the_contact_line_takes_along_a_pitched_hull) {
  const Case box{"box", "{type = \"box\", width = 1, height = 0.5}", 2, 0, 0};
  const auto steps = [&](const std::string& pitch) {
    auto scene = entering(box, "motion = \"prescribed\"\nsize = 0.01\npitch_deg = " + pitch + "\n");
    scene.bodies[0].position.y() = 0.32;
    scene.time.end = 0.2;
    scene.fluid->size.wetted_fraction = 0;
    return predicted_cost<2>(scene).steps;
  };
  const double at_speed = 0.2 * speed / (0.5 * 0.01), along = 1 / (0.5 * 0.01);
  EXPECT_GT(steps("5"), along);
  EXPECT_LT(steps("5"), along + at_speed);
  EXPECT_LT(steps("0"), 1.1 * at_speed);
}

// A box of L x B x H, of a third of water's density: draft T = H/3, GM = B^2/(12 T) + T/2 - H/2 about each axis.
TEST(Statics, of_a_box_are_those_of_its_sides) {
  const Case box{"box", "{type = \"box\", size = [2, 1, 0.3]}", 3, 0, 0};
  const auto all = foreseen<3>(entering(box, "density = 333.3333333333\n")).bodies;
  ASSERT_TRUE(all.contains("hull") && all.at("hull").rest);
  const auto& rest = *all.at("hull").rest;
  EXPECT_FALSE(rest.sinks);
  EXPECT_NEAR(rest.draft, 0.1, 1e-6);
  EXPECT_NEAR(rest.gm_roll, 1 / 1.2 + 0.05 - 0.15, 1e-6);
  EXPECT_NEAR(rest.gm_pitch, 4 / 1.2 + 0.05 - 0.15, 1e-6);
  ASSERT_GT(rest.levers.size(), 2u);
  EXPECT_NEAR(rest.heels[1], 15, 1e-9);
  EXPECT_GT(rest.levers[1], 0);
  EXPECT_TRUE(foreseen<3>(entering(box, "density = 1200\n")).bodies.at("hull").rest->sinks);
}

}  // namespace
}  // namespace splashdown::apps::foreseen_test
