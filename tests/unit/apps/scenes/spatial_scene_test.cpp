// Scenes in three dimensions: what they are read to, what is refused and how, what a World is built from.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "apps/build/build.hpp"
#include "apps/check/cost.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/scene/scales.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::spatial_scene_test {
namespace {

using std::numbers::pi;
using testing::messages_of;
using testing::Mistake;

constexpr double eps = 1e-14;  // a few round-offs of numbers of order one

// Line numbers below refer to this text.
const std::string landing = R"(title = "landing"
dimension = 3
[time]
end = 0.1
[gravity]
[tank]
min = [-2, -2, -1]
max = [2, 2, 1]
[fluid]
density = 1000
[fluid.size]
surface = 0.05
far = 0.3
[[fluid.region]]
shape = "box"
min = [-2, -2, -1]
max = [2, 2, 0]
[[body]]
name = "ball"
mass = 40
position = [0, 0, 0.31]
velocity = [1, 0, -3]
spin_deg = [0, 10, 0]
free = ["x", "z", "pitch"]
shape = { type = "sphere", radius = 0.3 }
[[body]]
name = "cone"
density = 300
position = [1, 0, 0.05]
heading_deg = 37
shape = { type = "cone", deadrise_deg = 30, radius = 0.3 }
)";

Scene scene_of(const std::string& text) { return read_scene_text(text, "scene.toml").scene; }

TEST(SpatialScene, without_its_dimension_is_told_that_alone) {
  EXPECT_EQ(messages_of(testing::replaced(landing, "dimension = 3\n", "")),
            std::vector<std::string>{"scene.toml:1: dimension is missing: the tank and the bodies are in space, and "
                                     "without it a scene is plane. Write dimension = 3 above the first table."});
}

std::string landing_with(const std::string& from, const std::string& to) {
  return testing::replaced(landing, from, to);
}

TEST(SpatialScene, records_have_their_third_axis) {
  const auto scene = scene_of(landing + R"([[record]]
kind = "surface_elevation"
name = "gauge"
x = 1
y = -0.5
[[record]]
kind = "pressure_patch"
name = "top"
body = "cone"
centre = [0, 0, 0.17320508]
radius = 0.1
[[record]]
kind = "acceleration"
name = "seat"
body = "ball"
point = [0, 0, 0.3]
[[record]]
kind = "maximum_pressure"
body = "ball"
)");
  const auto settings = recorder_settings<3>(scene, "folder");
  EXPECT_EQ(settings.gauges.at(0).at, Eigen::Vector2d(1, -0.5));
  EXPECT_NEAR(settings.patches.at(0).area, pi * 0.01, 1e-12);  // a disc of 32 sides of the same area
  EXPECT_NEAR(settings.patches[0].region.facing->z(), 1, eps);
  EXPECT_EQ(settings.equipment.at(0).point, fluid::Vec<3>(0, 0, 0.3));
  EXPECT_EQ(settings.hull_maps.at(0).size, 0.05) << "that of the elements at the hull";
}

TEST(SpatialScene, says_what_its_file_says) {
  const auto scene = scene_of(landing);
  EXPECT_EQ(scene.dimension, 3);
  EXPECT_EQ(scene.gravity->acceleration, Point(0, 0, -9.81)) << "downward is the last axis";
  EXPECT_EQ(scene.tank->max, Point(2, 2, 1));
  const auto& ball = scene.bodies[0];
  EXPECT_EQ(ball.velocity, Point(1, 0, -3));
  EXPECT_EQ(ball.spin_deg, Point(0, 10, 0));
  EXPECT_EQ(ball.free, (std::vector<std::string>{"x", "z", "pitch"}));
  EXPECT_EQ(std::get<SphereShape>(ball.shape).radius, 0.3);
  EXPECT_EQ(scene.bodies[1].free, freedom_names(3));
  EXPECT_EQ(scene.bodies[1].attitude.heading_deg, 37);
}

TEST(SpatialScene, reads_to_itself) {
  auto text = landing_with("mass = 40", "mass = 40\ninertia = [[1, 0.1, 0], [0.1, 1, 0], [0, 0, 1.5]]");
  text += R"([[body]]
name = "box"
shape = {type = "box", size = [0.3, 0.2, 0.1]}
density = 300
inertia = [1, 2, 2]
centre_of_mass = [0, 0, 0.01]
position = [-1, 0, 0.5]
roll_deg = 5
[[body]]
name = "pod"
shape = {type = "capsule", radius = 0.1, length = 0.3}
motion = "prescribed"
path = [[0, -1, 1, 0.5, 0, 0, 0], [0.1, -1, 1, 0.4, 10, 20, 30]]
[[body]]
name = "buoy"
shape = {type = "revolved", profile = [[0, 0], [0.2, 0.1], [0.2, 0.3]]}
motion = "fixed"
position = [1, 1, 0.5]
[[joint]]
type = "hinge"
body = "box"
point = [-1, 0, 0.6]
axis = [0, 1, 0]
[[fluid.region]]
shape = "sphere"
centre = [-1, -1, 0.5]
radius = 0.3
velocity_gradient = [[1, 0, 0], [0, 1, 0], [0, 0, -2]]
)";
  const auto once = read_scene_text(text, "scene.toml").resolved;
  EXPECT_EQ(once, read_scene_text(once, "scene.resolved.toml").resolved);
}

TEST(SpatialScene, cuts_fixed_bodies_at_the_tank) {
  const auto scene = scene_of(std::string(landing) + R"([[body]]
name = "floor"
shape = {type = "box", size = [9, 9, 1]}
motion = "fixed"
position = [0.3, 0, -1.4]
heading_deg = 20
)");
  const auto& floor = scene.bodies.back();
  const auto box = extents<3>(outline<3>(floor));
  EXPECT_TRUE(box.isApprox(Extents<3>(rigid::Vec<3>(-2, -2, -1), rigid::Vec<3>(2, 2, -0.9)), 1e-12));
  EXPECT_NEAR(shape_of<3>(floor.shape).at_unit_density.mass, 1.6, 1e-9);
}

class SpatialSceneIsRefused : public ::testing::TestWithParam<Mistake> {};

TEST_P(SpatialSceneIsRefused, with_place_key_and_rule) {
  const auto& bad = GetParam();
  const auto messages = messages_of(landing_with(bad.from, bad.to));
  EXPECT_EQ(messages.size(), 1u) << ::testing::PrintToString(messages);
  testing::expect_told(messages, "scene.toml", bad);
}

const std::vector<Mistake> mistakes = {
    // What people bring from two dimensions.
    {"vector_of_the_plane", "velocity = [1, 0, -3]", "velocity = [1, -3]", 22, "body.ball.velocity = [1, -3]",
     "must be a list of 3 numbers (m/s), not 2"},
    {"spin_of_the_plane", "spin_deg = [0, 10, 0]", "spin_deg = 10", 23, "body.ball.spin_deg = 10",
     "must be a list of 3 numbers (deg/s)"},
    {"freedom_of_the_plane", "free = [\"x\", \"z\", \"pitch\"]", "free = [\"y\", \"rotation\"]", 24,
     "body.ball.free = [\"y\", \"rotation\"]", "'x', 'y', 'z', 'roll', 'pitch' or 'yaw'"},
    {"shape_of_the_plane", "type = \"sphere\"", "type = \"circle\"", 25, "body.ball.shape.type = \"circle\"",
     "must be 'sphere', 'box', 'cone', 'capsule', 'revolved', 'spline' or 'surface'"},
    {"region_of_the_plane", "shape = \"box\"", "shape = \"circle\"", 15, "fluid.region[0].shape = \"circle\"",
     "must be 'box', 'sphere', 'revolved', 'spline' or 'union'"},
    {"box_of_the_plane", "{ type = \"sphere\", radius = 0.3 }", "{ type = \"box\", size = [1, 1] }", 25,
     "body.ball.shape.size = [1, 1]", "must be a list of 3 numbers (m), not 2"},
    {"wave_of_the_plane", "max = [2, 2, 0]", "max = [2, 2, 0]\nsurface_amplitude = 0.1", 18,
     "fluid.region[0].surface_amplitude = 0.1: exists in the plane only (dimension = 2)", "Valid here"},
    {"number_for_a_tensor", "mass = 40", "mass = 40\ninertia = 3", 21, "body.ball.inertia = 3",
     "must be a list of 3 numbers (kg m^2)"},
    // What no body has.
    {"inertia_of_no_body", "mass = 40", "mass = 40\ninertia = [1, 1, 3]", 21, "body.ball.inertia = [1, 1, 3]",
     "must not exceed the sum of the others"},
    {"inertia_not_symmetric", "mass = 40", "mass = 40\ninertia = [[1, 1, 0], [0, 1, 0], [0, 0, 1]]", 21,
     "body.ball.inertia", "must be symmetric"},
    {"inertia_not_positive", "mass = 40", "mass = 40\ninertia = [[1, 2, 0], [2, 1, 0], [0, 0, 1]]", 21,
     "body.ball.inertia", "must be positive about every axis, not -1"},
    {"mass_missing", "mass = 40\n", "", 18, "body.ball.mass is missing", "mass (kg) or mean density"},
    {"radius_negative", "{ type = \"sphere\", radius = 0.3 }", "{ type = \"sphere\", radius = -1 }", 25,
     "body.ball.shape.radius = -1", "must be positive (m)"},
    {"deadrise_upright", "deadrise_deg = 30", "deadrise_deg = 90", 31, "body.cone.shape.deadrise_deg = 90",
     "must lie in (0, 89] (deg)"},
    {"profile_across_the_axis", "{ type = \"sphere\", radius = 0.3 }",
     "{ type = \"revolved\", profile = [[0, 0], [-1, 1], [0, 2]] }", 25, "body.ball.shape.profile", "point 2 (-1, 1)"},
    // Places.
    {"tank_upside_down", "max = [2, 2, 1]", "max = [2, 2, -3]", 8, "tank.max = [2, 2, -3]", "must lie above tank.min"},
    {"region_flat", "max = [2, 2, 0]", "max = [2, -2, 0]", 17, "fluid.region[0].max = [2, -2, 0]",
     "must lie above min"},
    {"ball_through_the_wall", "position = [0, 0, 0.31]", "position = [0, 1.9, 0.31]", 21,
     "body.ball.position = [0, 1.9, 0.31]", "leaves the tank [-2, 2] x [-2, 2] x [-1, 1] m"},
    {"bodies_overlap", "position = [1, 0, 0.05]", "position = [0.2, 0.1, 0.2]", 29,
     "body.cone.position = [0.2, 0.1, 0.2]", "overlaps body.ball"},
};

INSTANTIATE_TEST_SUITE_P(table, SpatialSceneIsRefused, ::testing::ValuesIn(mistakes),
                         [](const auto& tested) { return std::string(tested.param.name); });

Body brick() {
  Body body;
  body.name = "brick";
  body.shape = BoxShape{.size = {0.4, 0.2, 0.1}};
  body.density = 300;
  body.free = freedom_names(3);
  return body;
}

TEST(Attitude, turns_the_nose_by_heading_then_up_by_pitch_then_rolls) {
  Body body = brick();
  body.attitude = {.heading_deg = 90};
  EXPECT_NEAR((body_spec<3>(body).pose.linear() * Point::UnitX() - Point::UnitY()).norm(), 0, eps);
  body.attitude = {.pitch_deg = 90};
  EXPECT_NEAR((body_spec<3>(body).pose.linear() * Point::UnitX() - Point::UnitZ()).norm(), 0, eps);
  body.attitude = {.roll_deg = 90};
  EXPECT_NEAR((body_spec<3>(body).pose.linear() * Point::UnitY() - Point::UnitZ()).norm(), 0, eps);
  body.attitude = {.heading_deg = 90, .pitch_deg = 90, .roll_deg = 90};
  const Eigen::Matrix3d turn = body_spec<3>(body).pose.linear();
  EXPECT_NEAR((turn * Point::UnitX() - Point::UnitZ()).norm(), 0, eps);
  EXPECT_NEAR((turn * Point::UnitY() + Point::UnitY()).norm(), 0, eps) << "rolled up, pitched back to -x, headed to -y";
}

TEST(SpatialBody, has_its_origin_at_the_centre_of_mass_and_its_world_axes_free) {
  Body body = brick();
  body.centre_of_mass.emplace(0.1, 0, 0);
  body.position = {2, 3, 4};
  body.attitude = {.heading_deg = 90};
  body.free = {"z", "yaw"};
  body.spin_deg = {0, 0, 180};
  const auto spec = body_spec<3>(body);
  EXPECT_NEAR((spec.pose.translation() - Point(2, 3.1, 4)).norm(), 0, eps);
  EXPECT_EQ(spec.free, (std::array<bool, 6>{false, false, true, false, false, true}));
  EXPECT_NEAR(spec.velocity[5], pi, eps);
  EXPECT_NEAR(spec.mass, 300 * 0.4 * 0.2 * 0.1, eps);
  EXPECT_NEAR(spec.inertia(0, 0), spec.mass / 12 * (0.2 * 0.2 + 0.1 * 0.1), eps);
}

TEST(SpatialBody, on_a_path_starts_with_the_paths_derivative) {
  Body body = brick();
  body.motion = Motion::prescribed;
  body.centre_of_mass.emplace(0.1, 0.05, -0.02);
  body.path = {{0, {0, 0, 1}, {.heading_deg = 20, .pitch_deg = 30, .roll_deg = 40}},
               {2, {1, 2, 0}, {.heading_deg = 80, .pitch_deg = -30, .roll_deg = 10}}};
  body.position = body.path[0].position;
  body.attitude = body.path[0].attitude;
  const auto spec = body_spec<3>(body);
  const double dt = 1e-6;
  const auto start = spec.path(0), next = spec.path(dt);
  EXPECT_TRUE(start.isApprox(spec.pose, eps));
  const Eigen::Matrix3d rate = (next.linear() - start.linear()) / dt * start.linear().transpose();
  // First order in dt, with accelerations of order one.
  EXPECT_NEAR((spec.velocity.head<3>() - (next.translation() - start.translation()) / dt).norm(), 0, 2e-6);
  EXPECT_NEAR((spec.velocity.tail<3>() - Point(rate(2, 1), rate(0, 2), rate(1, 0))).norm(), 0, 2e-6);
}

TEST(SpatialBody, that_is_prescribed_to_spin_turns_about_the_worlds_axis) {
  Body body = brick();
  body.motion = Motion::prescribed;
  body.attitude = {.heading_deg = 30, .roll_deg = 50};
  body.velocity = {1, 2, 3};
  body.spin_deg = {90, 0, 0};
  const auto spec = body_spec<3>(body);
  const auto later = spec.path(1);
  const Eigen::Matrix3d quarter = Eigen::AngleAxisd(pi / 2, Point::UnitX()).toRotationMatrix();
  EXPECT_NEAR((later.linear() - quarter * spec.pose.linear()).norm(), 0, eps);
  EXPECT_NEAR((later.translation() - Point(1, 2, 3)).norm(), 0, eps);
}

TEST(SpatialWalls, enclose_the_solid) {
  const auto spec = fluid_spec<3>(scene_of(landing));
  ASSERT_EQ(spec.walls.size(), 3u);
  EXPECT_NEAR(rigid::mass_properties<3>({spec.walls[0].surface.vertices, spec.walls[0].surface.facets}).mass,
              4. / 3 * pi * 0.027, 1e-3 * 0.113);
  auto tank = spec.walls[2].surface;
  tank.facets.row(1).swap(tank.facets.row(2));
  EXPECT_NEAR(rigid::mass_properties<3>({tank.vertices, tank.facets}).mass, 32, 1e-12) << "inside out";
}

/// A folder with a hull: a tetrahedron with edges of 0.3 m along the axes, in millimetres.
class SurfaceSceneTest : public ::testing::Test, protected ScratchFolder {
 protected:
  SurfaceSceneTest() {
    write("hull.obj", "v 0 0 0\nv 300 0 0\nv 0 300 0\nv 0 0 300\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 1 4 3\n");
  }
  SceneFile read(const std::string& shape) const {
    return read_scene_text(landing_with("{ type = \"sphere\", radius = 0.3 }", shape),
                           (path() / "scene.toml").string());
  }
};

TEST_F(SurfaceSceneTest, a_hull_from_a_file_is_found_beside_the_scene_and_scaled_to_metres) {
  const auto file = read("{ type = \"surface\", file = \"hull.obj\", scale = 0.001 }");
  const auto spec = body_spec<3>(file.scene.bodies[0]);
  EXPECT_NEAR(shape_of<3>(file.scene.bodies[0].shape).at_unit_density.mass, 0.3 * 0.3 * 0.3 / 6, eps);
  EXPECT_NEAR((spec.pose.translation() - Point(0.075, 0.075, 0.31 + 0.075)).norm(), 0, eps);
  // The text with all values in force is a scene in whatever folder.
  EXPECT_EQ(read_scene_text(file.resolved, "elsewhere/scene.resolved.toml").resolved, file.resolved);
}

TEST_F(SurfaceSceneTest, a_hull_that_is_none_is_told_with_file_line_what_and_cure) {
  const auto told = [&](const std::string& shape) {
    return ::testing::PrintToString(testing::refusal_of([&] { read(shape); }));
  };
  const auto none = told("{ type = \"surface\", file = \"none.stl\" }");
  EXPECT_NE(none.find("scene.toml:25: body.ball.shape.file = \\\"none.stl\\\": cannot be read: No such file"),
            std::string::npos)
      << none;
  const auto open = told("{ type = \"surface\", file = \"open.obj\" }");
  EXPECT_NE(open.find("body.ball.shape.file"), std::string::npos) << open;
  const auto large = told("{ type = \"surface\", file = \"hull.obj\" }");
  EXPECT_NE(large.find("leaves the tank"), std::string::npos) << large;
  EXPECT_NE(large.find("Is its file in millimetres? shape.scale = 0.001 makes it 0.3 m long. Move the body"),
            std::string::npos)
      << large;
  ASSERT_EQ(::mkfifo((path() / "pipe.stl").c_str(), 0600), 0);
  const auto pipe = told("{ type = \"surface\", file = \"pipe.stl\" }");
  EXPECT_NE(pipe.find("cannot be read: it is a pipe or a device, not a file. Name a file"), std::string::npos) << pipe;
  const auto huge = told("{ type = \"surface\", file = \"hull.obj\", scale = 1e6 }");
  EXPECT_NE(
      huge.find("is 3e+08 m long and reaches 3e+08 m from its origin at scale = 1e+06; hulls have 1e-09 to 1e+06 m"),
      std::string::npos)
      << huge;
}

TEST(SpatialScales, count_heights_along_z) {
  const auto scene = scene_of(landing);
  EXPECT_EQ(*still_water_level<3>(scene), 0);
  const auto s = scales<3>(scene);
  EXPECT_NEAR(s.length, 0.6, eps);
  EXPECT_NEAR(s.speed, std::sqrt(10 + 2 * 9.81 * 0.01), 1e-9);
}

TEST(SpatialCost, counts_the_nodes_of_a_uniform_box) {
  auto scene = scene_of(landing_with("far = 0.3\n", ""));
  scene.bodies.clear();
  EXPECT_NEAR(predicted_cost<3>(scene).nodes, 16 * std::sqrt(2.) / std::pow(0.05, 3), 1);
}

TEST(SpatialWorld, a_body_in_flight_falls_freely) {
  auto world = build_world<3>(scene_of(R"(dimension = 3
[time]
end = 1
[gravity]
[[body]]
name = "a"
mass = 1
velocity = [1, 0, 2]
shape = {type = "sphere", radius = 0.1}
)"));
  EXPECT_FALSE(world.fluid);
  ASSERT_TRUE(world.stepper->attempt(0.1).ok());
  world.stepper->commit();
  EXPECT_NEAR((world.bodies->state(0).pose.translation() - Point(0.1, 0, 0.2 - 9.81 * 0.005)).norm(), 0, eps);
}

}  // namespace
}  // namespace splashdown::apps::spatial_scene_test
