// What good scenes are read to: values, defaults, presence of effects, and the text of scene.resolved.toml.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "apps/effects/compressibility/compressibility.hpp"
#include "apps/effects/form_drag/form_drag.hpp"
#include "apps/effects/skin_friction/skin_friction.hpp"
#include "apps/effects/viscosity/viscosity.hpp"
#include "apps/scene/choose/presets.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/numbers.hpp"
#include "apps/scene/read/read.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::good_scene_test {
namespace {

Scene scene_of(const std::string& text) { return read_scene_text(text, "scene.toml").scene; }

// A bird: half a disc before its box. A spline of degree 2 through (-1, 0), (0, 0) and (1, 0) encloses two thirds of its control triangle.
TEST(GoodScene, regions_are_unions_and_splines) {
  const auto regions = scene_of(R"(title = "regions"
[time]
end = 1
[fluid]
density = 1000
[fluid.size]
surface = 0.1
[[fluid.region]]
shape = "union"
[[fluid.region.part]]
shape = "box"
min = [-1, 0]
max = [1, 3]
[[fluid.region.part]]
shape = "circle"
centre = [0, 0]
radius = 1
[[fluid.region]]
shape = "spline"
points = [[-1, 0], [0, 2], [1, 0]]
degree = 2
position = [5, 0]
)")
                           .fluid->regions;
  const auto area = [](const Region& region) { return rigid::mass_properties<2>(outline<2>(region)).mass; };
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_NEAR(area(regions[0]), 6 + std::numbers::pi / 2, 2e-4 * std::numbers::pi);  // a circle of 256 chords
  EXPECT_NEAR(area(regions[1]), 4. / 3, 1e-3);
  EXPECT_EQ(regions[1].velocity_origin, Point::Zero());
  EXPECT_NEAR(extents<2>(outline<2>(regions[1])).center().x(), 5, 1e-3);
}

TEST(GoodScene, says_what_its_file_says) {
  const auto scene = scene_of(testing::wedge_drop);
  EXPECT_EQ(scene.title, "wedge");
  EXPECT_EQ(scene.time.end, 0.02);
  EXPECT_EQ(scene.gravity->acceleration, Point(0, -9.81, 0));
  EXPECT_EQ(scene.tank->max, Point(2, 1, 0));
  EXPECT_EQ(scene.fluid->density, 1000);
  EXPECT_EQ(scene.fluid->size.far, 0.2);
  ASSERT_EQ(scene.fluid->regions.size(), 1u);
  EXPECT_EQ(std::get<BoxRegion>(scene.fluid->regions[0].shape).min, Point(-2, -1, 0));
  ASSERT_EQ(scene.bodies.size(), 1u);
  const auto& body = scene.bodies[0];
  EXPECT_EQ(body.name, "wedge");
  EXPECT_EQ(*body.mass, 241);
  EXPECT_FALSE(body.density);
  EXPECT_EQ(body.free, std::vector<std::string>{"y"});
  EXPECT_EQ(body.velocity, Point(0, -6.15, 0));
  EXPECT_EQ(std::get<WedgeShape>(body.shape).deadrise_deg, 30);
  EXPECT_EQ(std::get<PressureEntry>(scene.records.at(0)).body, 0u);
  EXPECT_EQ(scene.output.interval, 0.001);
}

TEST(GoodScene, a_free_body_without_mass_has_the_least_that_one_in_this_fluid_has) {
  for (const char* none : {"mass = 0", "density = 0"}) {
    const auto file = read_scene_text(testing::wedge_drop_with("mass = 241", none), "scene.toml");
    const auto& body = file.scene.bodies.at(0);
    EXPECT_TRUE(body.without_mass);
    EXPECT_FALSE(body.mass);
    EXPECT_DOUBLE_EQ(body.density.value(), 0.1);
    EXPECT_TRUE(read_scene_text(file.resolved, "scene.resolved.toml").scene.bodies.at(0).without_mass);
  }
  EXPECT_FALSE(scene_of(testing::wedge_drop).bodies.at(0).without_mass);
  const auto held = scene_of(testing::replaced(testing::wedge_drop_with("mass = 241", "mass = 0"), "free = [\"y\"]",
                                               "motion = \"prescribed\""));
  EXPECT_EQ(held.bodies.at(0).mass, 0.);
}

TEST(GoodScene, friction_and_drag_of_hulls_are_read_and_echoed) {
  const auto with = [](const std::string& tables) {
    return read_scene_text(testing::wedge_drop_with("[tank]", tables + "[tank]"), "scene.toml");
  };
  EXPECT_FALSE(scene_of(testing::wedge_drop).effects.find<FormDrag>());
  EXPECT_FALSE(scene_of(testing::wedge_drop).effects.find<SkinFriction>());
  const auto plain = with("[fluid.skin_friction]\n[fluid.form_drag]\n").scene;
  EXPECT_EQ(plain.effects.find<SkinFriction>()->line, "ittc1957");
  EXPECT_EQ(plain.effects.find<SkinFriction>()->dynamic_viscosity, 1e-3);
  EXPECT_TRUE(plain.effects.find<FormDrag>()->coefficients.empty());
  const auto file = with(
      "[fluid.viscosity]\ndynamic = 2e-3\n[fluid.skin_friction]\nline = \"flat_plate\"\n[fluid.form_drag]\n"
      "coefficients = {wedge = 1.25}\n");
  for (const auto& scene : {file.scene, scene_of(file.resolved)}) {
    EXPECT_EQ(scene.effects.find<SkinFriction>()->line, "flat_plate");
    EXPECT_EQ(scene.effects.find<SkinFriction>()->dynamic_viscosity, 2e-3);  // of the water, unless given
    EXPECT_EQ(scene.effects.find<FormDrag>()->coefficients, (std::map<std::string, double>{{"wedge", 1.25}}));
  }
}

TEST(GoodScene, compressibility_is_water_s_unless_given) {
  const auto with = [](const std::string& keys) {
    return read_scene_text(testing::wedge_drop_with("[tank]", "[fluid.compressibility]\n" + keys + "[tank]"),
                           "scene.toml");
  };
  EXPECT_FALSE(scene_of(testing::wedge_drop).effects.find<Compressibility>());
  EXPECT_DOUBLE_EQ(bulk_modulus_of(*with("").scene.effects.find<Compressibility>(), 1000), 1480. * 1480 * 1000);
  const auto file = with("bulk_modulus = 2e9\ngas_content = 0.1\n");
  for (const auto& scene : {file.scene, scene_of(file.resolved)}) {
    EXPECT_EQ(bulk_modulus_of(*scene.effects.find<Compressibility>(), 1000), 2e9);
    // Wood 1930: bubbles at ambient pressure make sound as slow as 40 m/s.
    EXPECT_NEAR(sound_speed_of(*scene.effects.find<Compressibility>(), 1000), 37.7, 0.1);
  }
}

TEST(GoodScene, a_limit_of_a_record_is_one_that_stands_alone) {
  const std::string
      of_record = "point = [0, 0]\nlimit = {above = 20000}\n",
      alone = "point = [0, 0]\n[[limit]]\nname = \"keel\"\nquantity = \"keel.peak_pressure\"\nabove = 20000\n";
  for (const auto& text : {of_record, alone}) {
    const auto file = read_scene_text(testing::wedge_drop_with("point = [0, 0]\n", text), "scene.toml");
    for (const auto& scene : {file.scene, read_scene_text(file.resolved, "scene.resolved.toml").scene}) {
      ASSERT_EQ(scene.limits.size(), 1u);
      const auto& limit = scene.limits[0];
      EXPECT_EQ(limit.name, "keel");
      EXPECT_EQ(limit.quantity, "keel.peak_pressure");
      EXPECT_EQ(limit.unit, "Pa");
      EXPECT_TRUE(limit.above);
      EXPECT_EQ(limit.value, 20000);
    }
  }
}

TEST(GoodScene, every_number_that_has_a_name_takes_a_limit) {
  auto text = testing::wedge_drop;
  const auto numbers = numbers_of(scene_of(text));
  EXPECT_GT(numbers.size(), 10u);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    text += fmt::format("[[limit]]\nname = \"n{}\"\nquantity = \"{}\"\nbelow = {}\n", i, numbers[i].name, i);
  const auto scene = scene_of(text);
  ASSERT_EQ(scene.limits.size(), numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_EQ(scene.limits[i].unit, numbers[i].unit);
    EXPECT_FALSE(scene.limits[i].above);
  }
}

TEST(GoodScene, has_only_the_effects_it_names) {
  const auto scene = scene_of(testing::wedge_drop_with("[gravity]\nacceleration = [0, -9.81]\n", ""));
  EXPECT_FALSE(scene.gravity);
  EXPECT_TRUE(scene.effects.empty());
  EXPECT_FALSE(scene.output.frames);
  const auto viscous = scene_of(testing::wedge_drop_with("[tank]", "[fluid.viscosity]\n[tank]"));
  const auto* viscosity = viscous.effects.find<Viscosity>();
  ASSERT_TRUE(viscosity);
  EXPECT_EQ(viscosity->dynamic, 1e-3);
  EXPECT_EQ(viscosity->walls, "slip");
}

TEST(GoodScene, takes_element_sizes_from_the_next_coarser_table) {
  const auto scene = scene_of(testing::wedge_drop_with("size = 0.005\n", ""));
  EXPECT_EQ(scene.bodies[0].size, 0.01);
  EXPECT_EQ(scene.tank->size, 0.2);
  EXPECT_EQ(scene_of(testing::wedge_drop_with("far = 0.2\n", "")).fluid->size.far, 0.01);
}

/// All lengths of a mesh, and a largest step.
const std::string sized =
    testing::replaced(testing::replaced(testing::replaced(testing::wedge_drop, "surface = 0.01\n",
                                                          "surface = 0.01\nwetted_fraction = 0.02\nhollow = 0.3\n"
                                                          "hollow_min = 0.003\n"),
                                        "max = [2, 1]\n", "max = [2, 1]\nsize = 0.3\n"),
                      "end = 0.02\n", "end = 0.02\ndt_max = 0.001\n");

TEST(GoodScene, refined_twice_is_the_scene_with_all_sizes_halved_by_hand) {
  const auto halved = std::vector<std::string>{"fluid.size.surface=0.005",
                                               "fluid.size.far=0.1",
                                               "fluid.size.wetted_fraction=0.01",
                                               "fluid.size.hollow_min=0.0015",
                                               "tank.size=0.15",
                                               "body.wedge.size=0.0025",
                                               "time.dt_max=0.0005"};
  const auto refined = std::vector<std::string>{"fluid.size.refine=2"};
  EXPECT_EQ(read_scene_text(sized, "t.toml", refined).resolved, read_scene_text(sized, "t.toml", halved).resolved);
}

TEST(GoodScene, a_preset_is_a_refinement_by_name) {
  const auto read = [](const std::string& value) {
    return read_scene_text(sized, "t.toml", std::vector{"fluid.size.refine=" + value}).resolved;
  };
  for (const auto& preset : presets) EXPECT_EQ(read(std::string(preset.name)), read(fmt::format("{}", preset.refine)));
  EXPECT_EQ(read("standard"), read_scene_text(sized, "t.toml").resolved);
}

TEST(GoodScene, sizes_that_follow_from_others_are_refined_once) {
  const auto text = testing::replaced(testing::replaced(testing::wedge_drop, "far = 0.2\n", ""), "size = 0.005\n", "");
  const auto refined = std::vector<std::string>{"fluid.size.refine=2"};
  const auto scene = read_scene_text(text, "t.toml", refined).scene;
  for (const double size : {scene.fluid->size.surface, scene.fluid->size.far, scene.tank->size, scene.bodies[0].size})
    EXPECT_EQ(size, 0.005);
  EXPECT_EQ(scene.time.dt_max, 0.5 * std::sqrt(0.005 / 9.81));
}

TEST(GoodScene, refined_keeps_what_is_no_length_of_the_mesh) {
  const auto refined = std::vector<std::string>{"fluid.size.refine=4"};
  const auto scene = read_scene_text(sized, "t.toml", refined).scene, plain = read_scene_text(sized, "t.toml").scene;
  EXPECT_EQ(scene.fluid->size.growth, plain.fluid->size.growth);
  EXPECT_EQ(scene.fluid->size.curvature, plain.fluid->size.curvature);
  EXPECT_EQ(scene.fluid->size.corner, plain.fluid->size.corner);
  EXPECT_EQ(scene.fluid->size.hollow, plain.fluid->size.hollow);
  EXPECT_EQ(scene.time.end, plain.time.end);
}

TEST(GoodScene, without_gravity_a_hundredth_of_the_end_is_refined_too) {
  const auto text = testing::replaced(testing::wedge_drop, "[gravity]\nacceleration = [0, -9.81]\n", "");
  const auto refined = std::vector<std::string>{"fluid.size.refine=2"};
  EXPECT_EQ(read_scene_text(text, "t.toml", refined).scene.time.dt_max, 0.0001);
}

TEST(GoodScene, bounds_the_time_step_by_the_shortest_surface_waves) {
  EXPECT_DOUBLE_EQ(scene_of(testing::wedge_drop).time.dt_max, 0.5 * std::sqrt(0.005 / 9.81));
  const auto no_waves = testing::wedge_drop_with("[gravity]\nacceleration = [0, -9.81]\n", "");
  EXPECT_DOUBLE_EQ(scene_of(no_waves).time.dt_max, 0.02 / 100);
}

TEST(GoodScene, is_coupled_where_a_free_body_meets_a_fluid) {
  const auto scene = scene_of(testing::wedge_drop);
  ASSERT_TRUE(scene.coupling);
  EXPECT_EQ(scene.coupling->scheme, "iterated");
  EXPECT_EQ(scene.coupling->interface_term, "rigid");
  const auto fixed = scene_of(testing::wedge_drop_with(
      "mass = 241\nposition = [0, 0.01]\nvelocity = [0, -6.15]\nfree = [\"y\"]", "motion = \"fixed\""));
  EXPECT_FALSE(fixed.coupling);
  const auto flight =
      scene_of("[time]\nend = 1\n[[body]]\nname = \"a\"\nmass = 1\nshape = {type = \"box\", width = 1, height = 1}\n");
  EXPECT_FALSE(flight.coupling);
  EXPECT_FALSE(flight.fluid);
}

TEST(GoodScene, may_leave_the_walls_out) {
  const auto scene = scene_of(R"(time = { end = 0.01 }
[fluid]
density = 1000
size = { surface = 0.05 }
[[fluid.region]]
shape = "circle"
centre = [1, 2]
radius = 1
velocity_gradient = [[-100, 0], [0, 100]]
)");
  EXPECT_FALSE(scene.tank);
  EXPECT_EQ(scene.fluid->regions[0].velocity_gradient(0, 0), -100);
  EXPECT_EQ(scene.fluid->regions[0].velocity_origin, Point(1, 2, 0));
}

TEST(GoodScene, reads_a_prescribed_path) {
  const auto scene =
      scene_of(testing::wedge_drop_with("mass = 241\nposition = [0, 0.01]\nvelocity = [0, -6.15]\nfree = [\"y\"]",
                                        "motion = \"prescribed\"\npath = [[0, 0.1, 0.2, 3], [0.5, 0.1, 0.1, 4]]"));
  const auto& body = scene.bodies[0];
  EXPECT_EQ(body.motion, Motion::prescribed);
  ASSERT_EQ(body.path.size(), 2u);
  EXPECT_EQ(body.path[1].attitude.pitch_deg, 4);
  EXPECT_EQ(body.position, Point(0.1, 0.2, 0));
}

/// One scene with every table and every shape.
const std::string everything = R"(dimension = 2
title = "all \"kinds\" of \\ things"
[time]
end = 2
cfl = 0.3
dt_max = 0.01
[gravity]
[tank]
min = [0, 0]
max = [10, 5]
size = 0.3
[fluid]
density = 1025
[fluid.size]
surface = 0.1
far = 0.4
growth = 0.1
wetted_fraction = 0.005
hollow = 0.3
hollow_min = 0.01
curvature = 0.25
corner = 0.25
[fluid.viscosity]
dynamic = 0.1
walls = "no_slip"
[fluid.absorber]
width = 1
rate = 3
[[fluid.region]]
shape = "box"
min = [0, 0]
max = [10, 2]
surface_amplitude = 0.05
surface_wavelength = 20
surface_phase_deg = 10
velocity = [0.1, 0.2]
[[fluid.region]]
shape = "circle"
centre = [1, 4]
radius = 0.5
velocity_gradient = [[0, 1], [-1, 0]]
velocity_origin = [1, 3]
[[fluid.region]]
shape = "ellipse"
centre = [3, 4]
semi_axes = [0.5, 0.3]
[[fluid.region]]
shape = "polygon"
points = [[8, 4], [9, 4], [8, 4.5]]
[[body]]
name = "a"
shape = { type = "polygon", points = [[5, 4], [5.5, 4], [5, 4.5]] }
density = 300
centre_of_mass = [5.1, 4.1]
inertia = 12
[[body]]
name = "b"
shape = { type = "ellipse", semi_axes = [0.2, 0.1] }
position = [6, 1.5]
pitch_deg = 10
spin_deg = 20
mass = 10
size = 0.05
[[body]]
name = "c"
motion = "prescribed"
shape = { type = "capsule", radius = 0.1, length = 0.3 }
path = [[0, 7, 1, 0], [1, 7, 1.2, 30]]
[[body]]
name = "d"
motion = "fixed"
shape = { type = "wedge", deadrise_deg = 20, breadth = 0.4, height = 0.3 }
position = [2, 2.5]
[coupling]
scheme = "staggered"
interface_term = "laplacian"
accelerator = "aitken"
relaxation = 0.5
tolerance = 1e-6
max_passes = 20
[output]
interval = 0.01
frames = 0.1
checkpoint = 5
[[record]]
kind = "pressure"
name = "p"
point = [1, 1]
[[record]]
kind = "surface_pressure"
wall = "tank"
times = [0.5, 1]
[[record]]
kind = "surface_pressure"
wall = "b"
interval = 0.1
[[record]]
kind = "surface_elevation"
name = "g"
x = 5
[[record]]
kind = "acceleration"
name = "seat"
body = "b"
point = [0.1, 0]
[[record]]
kind = "added_mass"
body = "b"
interval = 0.1
[[record]]
kind = "added_mass"
body = "d"
times = [0.5, 1]
[[record]]
kind = "pressure_patch"
name = "disc"
body = "b"
centre = [0, 0]
radius = 10
[[record]]
kind = "pressure_patch"
name = "part"
body = "b"
min = [-10, -10]
max = [10, 10]
[[record]]
kind = "maximum_pressure"
body = "b"
)";

TEST(ResolvedScene, reads_to_itself) {
  for (const auto& text : {everything, testing::wedge_drop}) {
    const auto once = read_scene_text(text, "scene.toml").resolved;
    const auto twice = read_scene_text(once, "scene.resolved.toml").resolved;
    EXPECT_EQ(once, twice);
  }
}

TEST(ResolvedScene, of_a_refined_scene_reads_to_itself) {
  const auto refined = std::vector<std::string>{"fluid.size.refine=1.41"};
  const auto first = read_scene_text(sized, "t.toml", refined);
  EXPECT_EQ(read_scene_text(first.resolved, "again.toml").resolved, first.resolved);
}

TEST(ResolvedScene, holds_the_defaults_in_force) {
  const auto text = read_scene_text(testing::wedge_drop, "scene.toml").resolved;
  for (const auto* line : {"growth = 0.15\n", "cfl = 0.5\n", "[body.shape]\n", "[coupling]\n", "tolerance = 1e-08\n",
                           "motion = \"free\"\n", "[[body]]\n", "[body.shape]\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << "is not in\n" << text;
  EXPECT_EQ(text.find("viscosity"), std::string::npos) << "an absent effect has no table";
}

TEST(ResolvedScene, may_carry_its_provenance) {
  EXPECT_NO_THROW(read_scene_text("[provenance]\nversion = \"1\"\n" + testing::wedge_drop.substr(16), "scene.toml"));
}

TEST(SceneGeometry, a_body_turns_about_its_reference_point) {
  Body body;
  body.shape = WedgeShape{.deadrise_deg = 45, .breadth = 2, .height = {}};
  body.position = {3, 1, 0};
  body.attitude.pitch_deg = 90;
  const auto hull = outline<2>(body);
  EXPECT_NEAR((hull.vertices.col(0) - rigid::Vec<2>(3, 1)).norm(), 0, 1e-15);
  // Its chines (+-1, 1) turn to (-1, +-1).
  EXPECT_NEAR(extents<2>(hull).min().x(), 2, 1e-15);
  EXPECT_NEAR(extents<2>(hull).max().x(), 3, 1e-15);
}

TEST(SceneGeometry, mass_follows_from_density_and_overrides_win) {
  Body body;
  body.shape = RectangleShape{.width = 2, .height = 0.5};
  body.density = 300;
  EXPECT_NEAR(mass_properties<2>(body).mass, 300, 1e-10);
  body.inertia = Eigen::Vector3d(0, 0, 7).asDiagonal();
  body.centre_of_mass = Point(0.1, 0, 0);
  EXPECT_EQ(mass_properties<2>(body).inertia(0, 0), 7);
  EXPECT_EQ(mass_properties<2>(body).centre.x(), 0.1);
}

TEST(SceneGeometry, a_wavy_region_has_the_stated_elevation) {
  Region region;
  region.shape = BoxRegion{.min = {0, -1, 0}, .max = {2, 0, 0}, .surface_amplitude = 0.1, .surface_wavelength = 4};
  const auto surface = outline<2>(region);
  double highest = -1, area = 0;
  for (int i = 0; i < surface.facets.cols(); ++i) {
    const auto a = surface.vertices.col(surface.facets(0, i)), b = surface.vertices.col(surface.facets(1, i));
    highest = std::max(highest, a.y());
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  EXPECT_DOUBLE_EQ(highest, 0.1);
  EXPECT_NEAR(area, 2, 1e-12);  // half a wave has no mean: the trapezoidal rule is exact by symmetry
}

// Text of scene.resolved.toml is a scene, and the same one.
TEST(GoodScene, of_every_example_is_read_back_from_what_it_was_read_to) {
  int count = 0;
  for (const auto& example : std::filesystem::directory_iterator(SPLASHDOWN_EXAMPLES)) {
    if (!example.is_directory()) continue;
    for (const auto& entry : std::filesystem::directory_iterator(example.path())) {
      const auto file = entry.path();
      if (file.extension() != ".toml" || !file.stem().string().starts_with("scene")) continue;
      ++count;
      const auto resolved = read_scene(file).resolved;
      try {
        EXPECT_EQ(read_scene_text(resolved, (example.path() / "resolved.toml").string()).resolved, resolved) << file;
      } catch (const SceneError& error) {
        ADD_FAILURE() << file << ": " << error.what();
      }
    }
  }
  EXPECT_GT(count, 50);
}

}  // namespace
}  // namespace splashdown::apps::good_scene_test
