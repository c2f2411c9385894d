// What a World is built from: poses, walls, effects that are there and effects that are not.
#include "apps/build/build.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "apps/scene/read/read.hpp"
#include "apps/simulation/approach.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::build_test {
namespace {

constexpr double eps = 1e-14;  // a few round-offs of numbers of order one

Scene scene_of(const std::string& text) { return read_scene_text(text, "scene.toml").scene; }

Body capsule() {
  Body body;
  body.name = "capsule";
  body.shape = CapsuleShape{.radius = 0.1, .length = 0.4};
  body.density = 300;
  return body;
}

TEST(BodySpec, has_its_origin_at_the_centre_of_mass) {
  Body body = capsule();
  body.centre_of_mass = Point(0.1, 0, 0);
  body.position = {2, 3, 0};
  body.attitude.pitch_deg = 90;
  const auto spec = body_spec<2>(body);
  EXPECT_NEAR((spec.pose.translation() - rigid::Vec<2>(2, 3.1)).norm(), 0, eps);
  // The shape stays where it was put: its reference point is at the position.
  EXPECT_NEAR((spec.pose * rigid::Vec<2>(-0.1, 0) - rigid::Vec<2>(2, 3)).norm(), 0, eps);
  EXPECT_NEAR(spec.surface.vertices.row(0).minCoeff(), -0.3 - 0.1, eps);
}

TEST(BodySpec, has_the_freedoms_that_are_named) {
  Body body = capsule();
  body.free = {"y", "rotation"};
  EXPECT_EQ(body_spec<2>(body).free, (std::array<bool, 3>{false, true, true}));
}

TEST(BodySpec, prescribed_motion_is_steady_or_along_its_path) {
  Body body = capsule();
  body.motion = Motion::prescribed;
  body.velocity = {1, -2, 0};
  body.spin_deg = {0, 0, 90};
  const auto steady = body_spec<2>(body);
  const auto pose = steady.path(2);
  EXPECT_NEAR((pose.translation() - rigid::Vec<2>(2, -4)).norm(), 0, eps);
  EXPECT_NEAR(pose.linear()(0, 0), -1, eps);  // half a turn

  body.path = {{0, {0, 1, 0}, {}}, {2, {4, 1, 0}, {.pitch_deg = 90}}, {3, {4, 1, 0}, {.pitch_deg = 90}}};
  body.position = {0, 1, 0};
  body.centre_of_mass = Point(0, 0.1, 0);
  const auto along = body_spec<2>(body);
  EXPECT_NEAR((along.path(0).translation() - rigid::Vec<2>(0, 1.1)).norm(), 0, eps);
  EXPECT_NEAR((along.path(2).translation() - rigid::Vec<2>(3.9, 1)).norm(), 0, eps);
  EXPECT_TRUE(along.path(7).isApprox(along.path(3)));
  // The velocity at the start is the path's derivative there.
  const double dt = 1e-6;
  const rigid::Vec<2> difference = (along.path(dt).translation() - along.path(0).translation()) / dt;
  EXPECT_NEAR((along.velocity.head<2>() - difference).norm(), 0, 1e-6);  // first order in dt, spin 0.8/s
  EXPECT_NEAR(along.velocity[2], std::numbers::pi / 4, eps);
}

TEST(FluidSpec, has_a_wall_for_each_body_and_then_the_tank) {
  const auto scene = scene_of(testing::wedge_drop);
  const auto spec = fluid_spec<2>(scene);
  ASSERT_EQ(spec.walls.size(), 2u);
  EXPECT_EQ(spec.walls[0].name, "wedge");
  EXPECT_EQ(spec.walls[0].size, 0.005);
  EXPECT_EQ(spec.walls[0].velocity[1], -6.15);
  EXPECT_EQ(spec.walls[1].name, "tank");
  EXPECT_EQ(spec.walls[1].size, 0.2);
  EXPECT_EQ(spec.liquids.size(), 1u);
  EXPECT_FALSE(spec.liquids[0].velocity) << "liquid at rest has no velocity field";
  EXPECT_EQ(spec.step.dt_max, scene.time.dt_max);
}

TEST(FluidSpec, walls_enclose_the_solid) {
  const auto spec = fluid_spec<2>(scene_of(testing::wedge_drop));
  const auto area = [](const fluid::Surface<2>& s) {
    double sum = 0;
    for (Eigen::Index i = 0; i < s.facets.cols(); ++i) {
      const fluid::Vec<2> a = s.vertices.col(s.facets(0, i)), b = s.vertices.col(s.facets(1, i));
      sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
    return sum;
  };
  EXPECT_GT(area(spec.walls[0].surface), 0);
  EXPECT_NEAR(area(spec.walls[1].surface), -8, eps * 8);
}

TEST(FluidSpec, gives_regions_their_velocity_field) {
  const auto spec = fluid_spec<2>(scene_of(testing::wedge_drop_with(
      "max = [2, 0]",
      "max = [2, 0]\nvelocity = [1, 2]\nvelocity_gradient = [[3, 4], [5, -3]]\nvelocity_origin = [1, 1]")));
  const auto v = spec.liquids[0].velocity(fluid::Vec<2>(2, 3));
  EXPECT_NEAR((v - fluid::Vec<2>(1 + 3 + 8, 2 + 5 - 6)).norm(), 0, eps);
}

TEST(Effects, that_a_scene_does_not_name_are_absent) {
  const auto scene = scene_of(testing::wedge_drop_with("[gravity]\nacceleration = [0, -9.81]\n", ""));
  const auto parts = parts_of<2>(scene);
  EXPECT_TRUE(parts.effects.empty());
  EXPECT_TRUE(parts.forces.empty());
}

TEST(Effects, that_a_scene_names_are_there_once) {
  const auto scene = scene_of(testing::wedge_drop);
  const auto [effects, forces] = parts_of<2>(scene);
  ASSERT_EQ(effects.size(), 1u);
  EXPECT_EQ(effects[0]->name(), "gravity");
  EXPECT_EQ(effects[0]->potential({0, 2}), 2 * 9.81);
  ASSERT_EQ(forces.size(), 1u);
}

TEST(RecorderSettings, points_move_from_the_shapes_frame_to_the_bodys) {
  auto scene = scene_of(testing::wedge_drop);
  scene.bodies[0].centre_of_mass = Point(0, 0.1, 0);
  scene.records.push_back(AccelerationEntry{"seat", 0, {0.1, 0.1, 0}});
  scene.records.push_back(PressureEntry{"fixed", {1, -0.5, 0}, {}});
  scene.records.push_back(ElevationEntry{"gauge", 0.7});
  scene.records.push_back(AddedMassEntry{0, 0.5, {}});
  scene.records.push_back(PatchEntry{"face", 0, Point(0.125, 0.125 * std::tan(std::numbers::pi / 6), 0), 0.05, {}, {}});
  scene.records.push_back(MaximumPressureEntry{0, 0.02});
  const auto settings = recorder_settings<2>(scene, "folder");
  ASSERT_EQ(settings.added_mass.size(), 1u);
  EXPECT_EQ(settings.added_mass[0].body, "wedge");
  EXPECT_EQ(settings.added_mass[0].every, 0.5);
  EXPECT_TRUE(recorder_settings<2>(scene_of(testing::wedge_drop), "folder").added_mass.empty());
  ASSERT_EQ(settings.pressure_probes.size(), 2u);
  EXPECT_EQ(settings.pressure_probes[0].body, "wedge");
  EXPECT_NEAR((settings.pressure_probes[0].point - fluid::Vec<2>(0, -0.1)).norm(), 0, eps);
  EXPECT_EQ(settings.pressure_probes[1].body, "");
  EXPECT_EQ(settings.pressure_probes[1].point, fluid::Vec<2>(1, -0.5));
  EXPECT_NEAR((settings.equipment[0].point - fluid::Vec<2>(0.1, 0)).norm(), 0, eps);
  EXPECT_EQ(settings.gauges[0].at[0], 0.7);
  EXPECT_EQ(settings.interval, 0.001);
  ASSERT_EQ(settings.patches.size(), 1u);
  EXPECT_NEAR(settings.patches[0].area, 0.1, 1e-14);  // of the outline, in the body's frame as in the shape's
  EXPECT_NEAR((*settings.patches[0].region.facing - fluid::Vec<2>(0.5, -std::sqrt(0.75))).norm(), 0, 1e-14);
  ASSERT_EQ(settings.hull_maps.size(), 1u);
  EXPECT_NEAR(settings.hull_maps[0].surface.vertices.row(1).minCoeff(), -0.1, eps);
  EXPECT_EQ(settings.centre_of_mass.at("wedge"), fluid::Vec<2>(0, 0.1));
}

TEST(World, has_the_parts_its_scene_has) {
  const auto both = build_world<2>(scene_of(testing::wedge_drop));
  EXPECT_TRUE(both.fluid);
  EXPECT_TRUE(both.bodies);
  const auto flight =
      build_world<2>(scene_of("[time]\nend = 1\n[[body]]\nname = \"a\"\nmass = 1\nshape = {type = \"box\", "
                              "width = 1, height = 1}\n"));
  EXPECT_FALSE(flight.fluid);
  EXPECT_EQ(flight.bodies->size(), 1u);
  const auto drop =
      build_world<2>(scene_of("[time]\nend = 1\n[fluid]\ndensity = 1000\nsize = {surface = "
                              "0.2}\n[[fluid.region]]\nshape = \"circle\"\ncentre = [0, "
                              "0]\nradius = 1\n"));
  EXPECT_TRUE(drop.fluid);
  EXPECT_FALSE(drop.bodies);
}

TEST(Approach, a_dry_hull_moves_by_a_share_of_its_elements_or_half_the_gap) {
  // Keel 0.01 m above the water, h = 0.005 m, cfl = 0.5: half the gap is more.
  const auto near = build_world<2>(scene_of(testing::wedge_drop));
  EXPECT_NEAR(approach_dt(*near.fluid, *near.bodies, 0.5), 0.005 / 6.15, 1e-12);
  const auto touching = build_world<2>(scene_of(testing::wedge_drop_with("position = [0, 0.01]", "position = [0, 0]")));
  EXPECT_NEAR(approach_dt(*touching.fluid, *touching.bodies, 0.5), 0.5 * 0.005 / 6.15, 1e-12);
  const auto wet = build_world<2>(scene_of(testing::wedge_drop_with("position = [0, 0.01]", "position = [0, -0.05]")));
  EXPECT_EQ(approach_dt(*wet.fluid, *wet.bodies, 0.5), std::numeric_limits<double>::infinity());
}

TEST(Approach, water_counts_with_its_own_distance_and_speed) {
  const auto beside_a_drop = [](const std::string& x, const std::string& speed) {
    const auto world =
        build_world<2>(scene_of(testing::wedge_drop + "[[fluid.region]]\nshape = \"circle\"\ncentre = [" + x +
                                ", 0.1]\nradius = 0.05\nvelocity = [0, -" + speed + "]\n"));
    return approach_dt(*world.fluid, *world.bodies, 0.5);
  };
  EXPECT_NEAR(beside_a_drop("1.5", "400"), 0.005 / 6.15, 1e-12);  // far away, however fast
  EXPECT_NEAR(beside_a_drop("0.5", "1000"), 0.5 * 0.2 / 1006.15, 1e-6);
}

/// A step made by hand, with what a recorder is told of the body.
TEST(World, a_body_in_flight_falls_freely) {
  auto world = build_world<2>(scene_of(R"([time]
end = 1
[gravity]
[[body]]
name = "a"
mass = 1
velocity = [1, 2]
shape = {type = "box", width = 1, height = 1}
)"));
  ASSERT_TRUE(world.stepper->attempt(0.1).ok());
  // Half a kick from t_0: the velocity at t_{1/2}.
  const auto trial = world.bodies->trials();
  ASSERT_EQ(trial.size(), 1u);
  EXPECT_NEAR(trial[0].velocity[1], 2 - 9.81 * 0.05, eps);
  world.stepper->commit();
  EXPECT_EQ(world.stepper->time(), 0.1);
  EXPECT_NEAR(world.bodies->state(0).pose.translation().y(), 0.2 - 9.81 * 0.005, eps);
}

}  // namespace
}  // namespace splashdown::apps::build_test
