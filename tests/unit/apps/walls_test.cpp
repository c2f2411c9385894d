// Hulls that go through walls: a run ends there, and check asks before it. What is meant to touch a wall is left alone.
#include "apps/check/walls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "apps/build/build.hpp"
#include "apps/simulation/wall_watch.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::walls_test {
namespace {

/// Water 1 m deep in a tank of 4 m, with bodies. Elements of 0.05 m.
Scene plane_scene(const std::string& bodies) {
  return read_scene_text(R"([time]
end = 1.5
[gravity]
[tank]
min = [-2, -1]
max = [2, 1]
[fluid]
density = 1000
size = {surface = 0.05, far = 0.2}
[[fluid.region]]
shape = "box"
min = [-2, -1]
max = [2, 0]
)" + bodies,
                         "scene.toml")
      .scene;
}

const std::string stone = R"([[body]]
name = "stone"
shape = {type = "circle", radius = 0.2}
density = 2600
position = [0, -0.4]
)";

/// What is said when the bodies' poses are these.
template <int d>
std::optional<Obstacle> crossed(const Scene& scene, const std::vector<rigid::Isometry<d>>& poses) {
  const auto bodies = bodies_of<d>(scene);
  const WallWatch<d> watch(scene, *bodies);
  std::vector<rigid::BodyState<d>> states(bodies->states().begin(), bodies->states().end());
  for (std::size_t i = 0; i < poses.size(); ++i) states[i].pose = poses[i];
  return watch.crossed(states, 0.5);
}

rigid::Isometry<2> at(double x, double y, double turn = 0) {
  rigid::Isometry<2> pose = rigid::Isometry<2>::Identity();
  pose.linear() = Eigen::Rotation2Dd(turn).toRotationMatrix();
  pose.translation() << x, y;
  return pose;
}

TEST(WallWatch, names_body_wall_place_time_and_cure) {
  const auto scene = plane_scene(stone);
  EXPECT_FALSE(crossed<2>(scene, {at(0, -0.4)}));
  const auto floor = crossed<2>(scene, {at(0.3, -0.9)});
  ASSERT_TRUE(floor);
  EXPECT_EQ(floor->cause,
            "body.stone goes through the tank's floor: at (0.3, -1.1) m, t = 0.5 s. Nothing holds it there without "
            "[contact]");
  EXPECT_NE(floor->cure.find("Add [contact]"), std::string::npos);
  EXPECT_NE(crossed<2>(scene, {at(1.9, -0.4)})->cause.find("the tank's side at x = 2 m"), std::string::npos);
  EXPECT_FALSE(crossed<2>(scene, {at(0, 0.9)})) << "the tank is open above";
}

TEST(WallWatch, looks_at_nothing_with_contact) {
  EXPECT_FALSE(crossed<2>(plane_scene(stone + "[contact]\n"), {at(0, -5)}));
}

TEST(WallWatch, leaves_alone_who_goes_where_the_scene_says) {
  std::string text = testing::replaced(stone, "density = 2600", "motion = \"prescribed\"\nvelocity = [0, -1]");
  EXPECT_FALSE(crossed<2>(plane_scene(text), {at(0, -5)}));
}

TEST(WallWatch, knows_a_top_where_the_water_reaches_it) {
  auto scene = plane_scene(stone);
  scene.tank->max.y() = 0;
  EXPECT_NE(crossed<2>(scene, {at(0, -0.1)})->cause.find("the tank's top"), std::string::npos);
}

/// Boxes of any size, turn and place beside a side: the tolerance is a tenth of an element, no less and no more.
TEST(WallWatch, tells_walls_from_roundoff_at_a_tenth_of_an_element) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  for (int k = 0; k < 200; ++k) {
    const double width = 0.1 + 0.4 * any(random), height = 0.1 + 0.4 * any(random), turn = 6.3 * any(random);
    const auto scene =
        plane_scene("[[body]]\nname = \"box\"\nshape = {type = \"box\", width = " + std::to_string(width) +
                    ", height = " + std::to_string(height) + "}\ndensity = 900\nposition = [0, -0.4]\nsize = 0.04\n");
    const double reach = 0.5 * (width * std::abs(std::sin(turn)) + height * std::abs(std::cos(turn)));
    const double depth = 0.008 * any(random);
    const auto found = crossed<2>(scene, {at(any(random) - 0.5, -1 + reach - depth, turn)});
    EXPECT_EQ(found.has_value(), depth > 0.004 + 1e-6) << k << ": " << depth;
  }
}

const std::string flap = R"([[body]]
name = "flap"
shape = {type = "box", width = 0.2, height = 0.8}
mass = 50
position = [0, -0.6]
[[joint]]
type = "hinge"
body = "flap"
point = [0.05, -1]
)";

TEST(WallWatch, lets_the_foot_of_a_flap_turn_in_the_floor) {
  const auto scene = plane_scene(flap);
  for (const double turn : {-1.2, -0.6, -0.1, 0., 0.2, 0.7, 1.2}) {
    const Eigen::Vector2d hinge(0.05, -1), arm = Eigen::Rotation2Dd(turn) * Eigen::Vector2d(-0.05, 0.4);
    EXPECT_FALSE(crossed<2>(scene, {at(hinge.x() + arm.x(), hinge.y() + arm.y(), turn)})) << turn;
  }
  EXPECT_TRUE(crossed<2>(scene, {at(0, -1.2)})) << "all of it does not";
}

std::string pair_of(const std::string& more) {
  return R"([[body]]
name = "a"
shape = {type = "box", width = 0.4, height = 0.4}
density = 500
position = [-0.3, -0.4]
[[body]]
name = "b"
shape = {type = "circle", radius = 0.2}
density = 500
position = [0.3, -0.4]
)" + more;
}

TEST(WallWatch, keeps_bodies_apart) {
  const auto scene = plane_scene(pair_of(""));
  EXPECT_FALSE(crossed<2>(scene, {at(-0.2, -0.4), at(0.2, -0.4)})) << "they touch";
  EXPECT_FALSE(crossed<2>(scene, {at(-0.2, -0.4), at(0.196, -0.4)})) << "a tenth of an element";
  const auto found = crossed<2>(scene, {at(-0.2, -0.4), at(0.18, -0.4)});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->cause.starts_with("body.a runs into body.b: at ")) << found->cause;
  EXPECT_FALSE(
      crossed<2>(plane_scene(pair_of("[[joint]]\ntype = \"hinge\"\nbody = \"a\"\nother = \"b\"\npoint = [0, -0.4]\n")),
                 {at(-0.2, -0.4), at(0.1, -0.4)}))
      << "a joint knows better";
}

TEST(WallWatch, sees_walls_in_space) {
  const auto scene = read_scene_text(R"(dimension = 3
[time]
end = 1
[gravity]
[tank]
min = [-2, -2, -2]
max = [2, 2, 1]
[fluid]
density = 1000
size = {surface = 0.2, far = 0.4}
[[fluid.region]]
shape = "box"
min = [-2, -2, -2]
max = [2, 2, 0]
[[body]]
name = "a"
shape = {type = "sphere", radius = 0.4}
density = 2000
position = [-0.6, 0, -0.6]
[[body]]
name = "b"
shape = {type = "box", size = [0.6, 0.6, 0.6]}
density = 2000
position = [0.6, 0, -0.6]
)",
                                     "scene.toml")
                         .scene;
  const auto place = [](double x, double y, double z) {
    rigid::Isometry<3> pose = rigid::Isometry<3>::Identity();
    pose.translation() << x, y, z;
    return pose;
  };
  EXPECT_FALSE(crossed<3>(scene, {place(-0.6, 0, -0.6), place(0.6, 0, -0.6)}));
  EXPECT_NE(crossed<3>(scene, {place(-0.6, 0, -1.7), place(0.6, 0, -0.6)})->cause.find("floor"), std::string::npos);
  EXPECT_NE(crossed<3>(scene, {place(-0.6, 1.7, -1), place(0.6, 0, -0.6)})->cause.find("side at y = 2 m"),
            std::string::npos);
  EXPECT_NE(crossed<3>(scene, {place(-0.05, 0, -0.6), place(0.6, 0, -0.6)})->cause.find("runs into body.b"),
            std::string::npos);
}

TEST(WallQuestion, is_asked_of_a_stone_that_sinks_to_the_floor) {
  const auto scene = plane_scene(stone);
  const auto meeting = guessed_meeting<2>(scene);
  ASSERT_TRUE(meeting);
  EXPECT_EQ(meeting->wall, "the tank's floor");
  // It falls 0.4 m with (2.6 - 1) / (2.6 + 1) g: von Karman's added mass of a whole circle is its own.
  EXPECT_NEAR(meeting->time, std::sqrt(2 * 0.4 / (9.81 * 1.6 / 3.6)), 0.1 * meeting->time);
  const auto asked = questions_about_walls<2>(scene);
  ASSERT_EQ(asked.size(), 1u);
  EXPECT_NE(asked[0].find("body.stone may reach the tank's floor at about t = 0.4"), std::string::npos) << asked[0];
  EXPECT_TRUE(questions_about_walls<2>(plane_scene(stone + "[contact]\n")).empty());
}

TEST(WallQuestion, is_not_asked_of_what_floats_stays_or_ends_before) {
  EXPECT_FALSE(guessed_meeting<2>(plane_scene(testing::replaced(stone, "2600", "500"))));
  EXPECT_FALSE(guessed_meeting<2>(plane_scene(testing::replaced(stone, "density = 2600", "motion = \"fixed\""))));
  EXPECT_FALSE(guessed_meeting<2>(plane_scene(stone + "free = [\"x\"]\n")));
  EXPECT_FALSE(guessed_meeting<2>(plane_scene(flap)));
  auto scene = plane_scene(stone);
  scene.time.end = 0.3;
  EXPECT_FALSE(guessed_meeting<2>(scene));
}

TEST(WallQuestion, is_asked_of_bodies_on_their_way_to_each_other) {
  auto text = pair_of("velocity = [-2, 0]\n");
  const auto meeting = guessed_meeting<2>(plane_scene(text));
  ASSERT_TRUE(meeting);
  EXPECT_EQ(meeting->wall, "body.b");
  EXPECT_FALSE(guessed_meeting<2>(plane_scene(testing::replaced(text, "[-2, 0]", "[2, 0]\nfree = [\"y\"]"))));
}

/// Heavy bodies that fall to the floor or are shot at a side.
TEST(WallQuestion, is_asked_of_heavy_bodies_of_any_kind_on_their_way_to_a_wall) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(0, 1);
  for (int k = 0; k < 40; ++k) {
    const bool falls = any(random) < 0.5, round = any(random) < 0.5;
    const double density = 2000 + 5800 * any(random), side = any(random) < 0.5 ? -1 : 1;
    std::string text = "[[body]]\nname = \"b\"\nsize = 0.02\ndensity = " + std::to_string(density) + "\nshape = ";
    text += round ? "{type = \"circle\", radius = 0.15}\n" : "{type = \"box\", width = 0.3, height = 0.18}\n";
    text += falls ? "position = [0, -0.5]\n"
                  : "position = [" + std::to_string(1.2 * side) + ", -0.5]\nvelocity = [" + std::to_string(5 * side) +
                        ", 0]\n";
    EXPECT_TRUE(guessed_meeting<2>(plane_scene(text))) << text;
  }
}

}  // namespace
}  // namespace splashdown::apps::walls_test
