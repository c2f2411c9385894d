// [wavemaker]: what is read and refused, and the paddle that it becomes.
#include "apps/effects/wavemaker/wavemaker.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/build/build.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/read/read.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::wavemaker_test {
namespace {

using testing::Mistake;

const std::string flume = R"([time]
end = 6
[gravity]
[tank]
min = [-0.5, -0.4]
max = [9, 0.3]
[fluid]
density = 1000
[[fluid.region]]
shape = "box"
min = [0, -0.4]
max = [9, 0]
[fluid.absorber]
ends = "upper"
width = 3
rate = 5
[wavemaker]
type = "piston"
period = 1.2
height = 0.05
)";

Scene scene_of(const std::string& text) { return read_scene_text(text, "scene.toml").scene; }

class BadWavemaker : public ::testing::TestWithParam<Mistake> {};

TEST_P(BadWavemaker, is_refused_with_place_key_rule_and_cure) {
  const auto& bad = GetParam();
  testing::expect_refused(testing::replaced(flume, bad.from, bad.to), bad);
}

const Mistake mistakes[] = {
    {"two_sizes", "height = 0.05", "height = 0.05\nstroke = 0.1", 21, "wavemaker.stroke = 0.1", "Remove one of them."},
    {"no_size", "height = 0.05\n", "", 17, "wavemaker.height", "Give one of them."},
    {"breaks", "height = 0.05", "height = 0.3", 20, "wavemaker.height = 0.3",
     "Use at most 0.19 m, or a longer period."},
    {"no_room", "min = [-0.5, -0.4]", "min = [-0.05, -0.4]", 5, "tank.min", "Let the tank begin at x = -0.1"},
    {"runs_over", "max = [9, 0.3]", "max = [9, 0.04]", 6, "tank.max", "Let it reach 0.1 m above."},
    {"damped", "ends = \"upper\"", "ends = \"both\"", 14, "fluid.absorber.ends = \"both\"", "Use ends = \"upper\"."},
    {"irregular_and_regular", "period = 1.2\nheight = 0.05",
     "significant_height = 0.05\npeak_period = 1.2\nheight = 0.05", 21, "wavemaker.height", "Remove it, or the two."},
    {"irregular_without_period", "period = 1.2\nheight = 0.05", "significant_height = 0.05", 17,
     "wavemaker.peak_period", "Use the period of the largest waves."},
    {"irregular_breaks", "period = 1.2\nheight = 0.05", "significant_height = 0.3\npeak_period = 1.2", 19,
     "wavemaker.significant_height = 0.3", "Use at most 0.19 m, or a longer period."},
    {"hinge_of_a_piston", "height = 0.05", "height = 0.05\nhinge = 0.1", 21, "wavemaker.hinge",
     "Remove it, or use type = \"flap\"."},
    {"hinge_too_high", "\"piston\"", "\"flap\"\nhinge = 0.38", 19, "wavemaker.hinge = 0.38", "Use at most 0.32 m."},
    {"above_floor", "min = [0, -0.4]", "min = [0, -0.3]", 17, "wavemaker: needs", "from the tank's floor up"},
    {"no_gravity", "[gravity]\n", "", 16, "wavemaker: needs", "[gravity] straight down"}};

INSTANTIATE_TEST_SUITE_P(All, BadWavemaker, ::testing::ValuesIn(mistakes),
                         [](const auto& of) { return of.param.name; });

TEST(Wavemaker, is_a_paddle_on_the_path_of_its_stroke) {
  const Scene scene = scene_of(flume);
  ASSERT_EQ(scene.bodies.size(), 1U);
  const auto& paddle = scene.bodies.front();
  EXPECT_EQ(paddle.name, "wavemaker");
  double least = 0, most = 0;
  for (const auto& point : paddle.path) {
    least = std::min(least, point.position.x());
    most = std::max(most, point.position.x());
  }
  // H/S = 1.2397 at kd = 1.298, 100 rows a period: none needs to lie on the turning point.
  const double stroke = 0.05 / 1.2397, missed = 1 - std::cos(std::numbers::pi / 100);
  EXPECT_NEAR(most - least, stroke, stroke * (missed + 1e-4));
  EXPECT_GE(paddle.path.back().time, scene.time.end);
  EXPECT_EQ(paddle.path.front().position.x(), 0);
}

TEST(Wavemaker, turns_about_its_foot_as_a_flap_at_either_end) {
  for (const bool upper : {false, true}) {
    std::string text = testing::replaced(flume, "\"piston\"", upper ? "\"flap\"\nend = \"upper\"" : "\"flap\"");
    if (upper) {
      text = testing::replaced(text, "min = [-0.5, -0.4]\nmax = [9, 0.3]", "min = [-9, -0.4]\nmax = [0.5, 0.3]");
      text = testing::replaced(text, "min = [0, -0.4]\nmax = [9, 0]", "min = [-9, -0.4]\nmax = [0, 0]");
      text = testing::replaced(text, "ends = \"upper\"", "ends = \"lower\"");
    }
    const Scene scene = scene_of(text);
    ASSERT_EQ(scene.bodies.size(), 1U);
    const auto& body = scene.bodies.front();
    const auto hull = shape_of<2>(body.shape).surface;
    bool towards_water = false;
    for (const auto& point : body.path) {
      const auto pose = shape_pose<2>(point.position, point.attitude);
      const double lowest = (pose * hull.vertices).row(1).minCoeff();
      EXPECT_NEAR(lowest, -0.4, 1e-12);
      EXPECT_LE((pose * hull.vertices).row(1).maxCoeff(), 0.3);
      // The face at the still level: the first swing is towards the water.
      const double x = 0.4 * std::tan(-point.attitude.pitch_deg * radians);
      if (std::abs(x) > 1e-3 && !towards_water) {
        EXPECT_EQ(x > 0, !upper);
        towards_water = true;
      }
    }
    EXPECT_TRUE(towards_water);
  }
}

TEST(Wavemaker, above_a_sill_turns_about_a_place_on_its_top) {
  for (const bool upper : {false, true}) {
    std::string text = testing::replaced(flume, "\"piston\"",
                                         upper ? "\"flap\"\nend = \"upper\"\nhinge = 0.15" : "\"flap\"\nhinge = 0.15");
    if (upper) {
      text = testing::replaced(text, "min = [-0.5, -0.4]\nmax = [9, 0.3]", "min = [-9, -0.4]\nmax = [0.5, 0.3]");
      text = testing::replaced(text, "min = [0, -0.4]\nmax = [9, 0]", "min = [-9, -0.4]\nmax = [0, 0]");
      text = testing::replaced(text, "ends = \"upper\"", "ends = \"lower\"");
    }
    const Scene scene = scene_of(text);
    ASSERT_EQ(scene.bodies.size(), 2U);
    const auto &flap = scene.bodies[0], &sill = scene.bodies[1];
    const auto wall = extents<2>(outline<2>(sill));
    EXPECT_EQ(sill.name, "sill");
    EXPECT_NEAR(wall.min().y(), -0.4, 1e-12);
    EXPECT_NEAR(wall.max().y(), -0.25, 1e-12);
    const auto hull = shape_of<2>(flap.shape).surface;
    for (const auto& point : flap.path) {
      const auto at = shape_pose<2>(point.position, point.attitude) * hull.vertices;
      EXPECT_NEAR(at.row(1).minCoeff(), -0.25, 1e-12) << "neither in the sill nor above it";
      EXPECT_NEAR(at(0, 0), 0, 1e-12);
      EXPECT_LT(wall.min().x(), 0);
      EXPECT_GT(wall.max().x(), 0);
    }
  }
}

TEST(Wavemaker, sends_the_sea_of_its_seed) {
  const std::string irregular =
      testing::replaced(flume, "period = 1.2\nheight = 0.05", "significant_height = 0.04\npeak_period = 1.2");
  const Scene scene = scene_of(irregular), same = scene_of(irregular), other = scene_of(irregular + "seed = 2\n");
  const auto& path = scene.bodies.front().path;
  ASSERT_EQ(path.size(), same.bodies.front().path.size());
  double differs = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_EQ(path[i].position.x(), same.bodies.front().path[i].position.x());
    differs = std::max(differs, std::abs(path[i].position.x() - other.bodies.front().path[i].position.x()));
  }
  EXPECT_GT(differs, 0.01);
  EXPECT_NEAR(scene.fluid->size.surface, 1.936 / 60, 0.001);
}

TEST(Wavemaker, gives_its_waves_forty_elements_where_sizes_are_left_open) {
  const Scene scene = scene_of(flume);
  EXPECT_NEAR(scene.fluid->size.surface, 1.936 / 40, 0.001);  // told in two digits
}

}  // namespace
}  // namespace splashdown::apps::wavemaker_test
