// What of a hull is under a level, and how a body is guessed to fall and to float.
#include "apps/scene/outlook/immersion.hpp"

#include <gtest/gtest.h>

#include "apps/scene/outlook/motion_guess.hpp"

namespace splashdown::apps::immersion_test {
namespace {

constexpr double eps = 1e-12;

Body brick() {
  Body body;
  body.shape = BoxShape{.size = {0.4, 0.2, 0.1}};
  return body;
}

TEST(Immersion, of_a_box_is_that_of_the_part_below) {
  const auto hull = outline<3>(brick());
  const auto half = Immersion<3>::of(hull, 0);
  EXPECT_NEAR(half.wetted, 0.4 * 0.2 + 0.05 * 2 * (0.4 + 0.2), eps);
  EXPECT_NEAR(half.plan, 0.4 * 0.2, eps);
  EXPECT_NEAR(half.volume, 0.5 * 0.4 * 0.2 * 0.1, eps);
  EXPECT_NEAR((half.high - half.low - Vec<3>(0.4, 0.2, 0.05)).norm(), 0, eps);
  const auto all = Immersion<3>::of(hull, 1);
  EXPECT_NEAR(all.wetted, 2 * (0.4 * 0.2 + 0.4 * 0.1 + 0.2 * 0.1), eps);
  EXPECT_NEAR(all.plan, 0.4 * 0.2, eps);
  EXPECT_NEAR(all.volume, 0.4 * 0.2 * 0.1, eps);
  EXPECT_TRUE(Immersion<3>::of(hull, -1).dry());
}

TEST(Immersion, of_a_rectangle_is_that_of_the_part_below) {
  Body body;
  body.shape = RectangleShape{.width = 0.4, .height = 0.2};
  const auto half = Immersion<2>::of(outline<2>(body), 0);
  EXPECT_NEAR(half.wetted, 0.4 + 2 * 0.1, eps);
  EXPECT_NEAR(half.plan, 0.4, eps);
  EXPECT_NEAR(half.volume, 0.4 * 0.1, eps);
}

TEST(Immersion, a_table_is_near_what_it_was_made_of) {
  auto body = brick();
  body.attitude = {.pitch_deg = 11};
  const auto hull = outline<3>(body);
  const ImmersionTable<3> table(hull);
  const double bottom = extents<3>(hull).min().z();
  const auto all = Immersion<3>::of(hull, bottom + table.height());
  for (const double share : {0.003, 0.07, 0.3, 0.64, 0.9, 1.}) {
    const auto looked_up = table.at(share * table.height()),
               exact = Immersion<3>::of(hull, bottom + share * table.height());
    EXPECT_NEAR(looked_up.wetted, exact.wetted, 0.01 * all.wetted) << share;
    EXPECT_NEAR(looked_up.plan, exact.plan, 0.01 * all.plan) << share;
    EXPECT_NEAR(looked_up.volume, exact.volume, 0.01 * all.volume) << share;
  }
  EXPECT_TRUE(table.at(0).dry());
  EXPECT_EQ(table.at(2 * table.height()).volume, all.volume);
}

class Falling : public ::testing::Test {
 protected:
  Falling() {
    scene.dimension = 3;
    scene.time.end = 2;
    scene.fluid.emplace();
    scene.fluid->density = 1000;
    scene.tank.emplace();
    scene.tank->min = {-50, -50, -50};
    scene.tank->max = {50, 50, 50};
    Region water;
    water.shape = BoxRegion{.min = {-50, -50, -50}, .max = {50, 50, 0}};
    scene.fluid->regions.push_back(water);
    body = brick();
    body.mass = 4;  // half of the water's density
    body.position = {0, 0, 0.05 + 0.1};
    body.velocity = {3, 0, -2};
    body.free = {"x", "y", "z", "roll", "pitch", "yaw"};
  }
  Vec<3> speed(double time) const {
    const auto guessed = guessed_body<3>(scene, body);
    const double dt = 1e-4;
    return (guessed_motion<3>(scene, guessed, time + dt) - guessed_motion<3>(scene, guessed, time - dt)) / (2 * dt);
  }
  Scene scene;
  Body body;
};

TEST_F(Falling, keeps_its_speed_in_the_air_and_along_the_water) {
  EXPECT_NEAR((speed(0.04) - Vec<3>(3, 0, -2)).norm(), 0, 1e-9);
  EXPECT_NEAR(speed(0.5).x(), 3, 1e-9);
}

TEST_F(Falling, shares_its_momentum_with_the_water_of_its_plan) {
  const double added = plate_mass<3>(1000, 0.4 * 0.2);  // a flat bottom has it from the first moment on
  EXPECT_NEAR(speed(0.06).z(), -2 * 4 / (4 + added), 0.02);
}

TEST_F(Falling, rises_to_where_it_floats) {
  scene.gravity = Gravity{.acceleration = {0, 0, -9.81}};
  body.velocity = Point::Zero();
  body.position = {0, 0, 0};  // of its centre: half of it is wet, as its mass asks
  EXPECT_NEAR(guessed_motion<3>(scene, body, 1.).z(), 0, 1e-3);
  body.position = {0, 0, -0.04};
  EXPECT_GT(speed(0.05).z(), 0);
}

}  // namespace
}  // namespace splashdown::apps::immersion_test
