// --set changes any key under the same rules as the file.
#include <gtest/gtest.h>

#include "apps/effects/viscosity/viscosity.hpp"
#include "apps/scene/read/override.hpp"
#include "apps/scene/read/read.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::override_scene_test {
namespace {

Scene with(std::vector<std::string> overrides) {
  return read_scene_text(testing::wedge_drop, "scene.toml", overrides).scene;
}

std::string refusal(const std::string& argument) {
  const auto messages = testing::messages_of(testing::wedge_drop, {argument});
  return messages.size() == 1 ? messages[0] : ::testing::PrintToString(messages);
}

TEST(Override, replaces_values_of_every_type) {
  EXPECT_EQ(with({"fluid.density=1025"}).fluid->density, 1025);
  EXPECT_EQ(with({"title=test"}).title, "test");
  EXPECT_EQ(with({"title=\"a test\""}).title, "a test");
  EXPECT_EQ(with({"tank.max=[3, 4]"}).tank->max, Point(3, 4, 0));
  EXPECT_EQ(
      std::get<WedgeShape>(with({"body.wedge.shape={type=\"wedge\", deadrise_deg=45, breadth=1}"}).bodies[0].shape)
          .breadth,
      1);
}

TEST(Override, chooses_array_elements_by_name_or_index) {
  EXPECT_EQ(*with({"body.wedge.mass=100"}).bodies[0].mass, 100);
  EXPECT_EQ(*with({"body.0.mass=100"}).bodies[0].mass, 100);
  EXPECT_EQ(*with({"body[0].mass=100"}).bodies[0].mass, 100);
  EXPECT_EQ(std::get<WedgeShape>(with({"body.wedge.shape.deadrise_deg=45"}).bodies[0].shape).deadrise_deg, 45);
}

TEST(Override, adds_keys_and_tables) {
  EXPECT_EQ(with({"time.cfl=0.25"}).time.cfl, 0.25);
  EXPECT_EQ(with({"fluid.viscosity.dynamic=2"}).effects.find<Viscosity>()->dynamic, 2);
  EXPECT_EQ(with({"fluid.viscosity={}"}).effects.find<Viscosity>()->dynamic, 1e-3);
  EXPECT_EQ(with({"coupling.scheme=staggered"}).coupling->scheme, "staggered");
}

TEST(Override, with_an_empty_value_removes) {
  EXPECT_FALSE(with({"gravity="}).gravity);
  EXPECT_FALSE(with({"fluid.viscosity={}", "fluid.viscosity="}).effects.find<Viscosity>());
  EXPECT_EQ(with({"body.wedge.size="}).bodies[0].size, 0.01);
  EXPECT_EQ(refusal("fluid.viscosity="),
            "--set fluid.viscosity=: there is no such key to remove. Give a value behind the equals sign.");
}

TEST(Override, removes_elements_of_arrays_of_tables) {
  EXPECT_TRUE(with({"record.0="}).records.empty());
  EXPECT_TRUE(with({"record.keel="}).records.empty());
  EXPECT_TRUE(with({"record.keel=", "body.wedge="}).bodies.empty());
  const auto two =
      with({"record=[{kind = \"pressure\", name = \"a\", point = [0, -0.5]}, {kind = \"pressure\", name = \"b\", "
            "point = [1, -0.5]}]",
            "record.0="});
  ASSERT_EQ(two.records.size(), 1u) << "later ones move up";
  EXPECT_EQ(std::get<PressureEntry>(two.records[0]).name, "b");
  EXPECT_EQ(refusal("record.1="), "--set record.1=: no record is called '1'. There is 'keel'.");
}

TEST(Override, changes_an_entry_of_a_list_counted_from_zero) {
  EXPECT_EQ(with({"body.wedge.velocity.1=-4"}).bodies[0].velocity, Point(0, -4, 0));
  EXPECT_EQ(with({"tank.min[0]=-3"}).tank->min, Point(-3, -1, 0));
  EXPECT_EQ(with({"body.wedge.shape={type=\"polygon\", points=[[0, 0], [1, 0], [0, 0.5]]}",
                  "body.wedge.shape.points.2.1=0.25"})
                .bodies[0]
                .shape.index(),
            0u);
  EXPECT_EQ(
      refusal("body.wedge.velocity.2=1"),
      "--set body.wedge.velocity.2=1: body.wedge.velocity has the entries 0 to 1, not '2'. The first is 0: x, then y "
      "(and z).");
  EXPECT_EQ(with({"body.wedge.free=[\"x\", \"y\"]", "body.wedge.free.0=rotation"}).bodies[0].free,
            (std::vector<std::string>{"rotation", "y"}));
  EXPECT_EQ(refusal("body.wedge.velocity.1=fast"),
            "--set body.wedge.velocity.1=fast: body.wedge.velocity = [0, \"fast\"]: must be a number (m/s), not a "
            "string. Write the number alone, in m/s.");
  EXPECT_EQ(refusal("body.wedge.centre_of_mass.1=1"),
            "--set body.wedge.centre_of_mass.1=1: body.wedge.centre_of_mass is not in the scene, so it has no entry 1. "
            "Give all of it, e.g. --set body.wedge.centre_of_mass=[0.0, 1.0].");
  EXPECT_TRUE(refusal("tank.max.0=-5").starts_with("--set tank.max.0=-5: tank.max = [-5, 1]: must lie above tank.min"))
      << refusal("tank.max.0=-5");
}

TEST(Override, of_the_end_brings_later_times_of_records_to_it_with_a_note) {
  const auto text = testing::wedge_drop +
                    "[[record]]\nkind = \"surface_pressure\"\nwall = \"wedge\"\ntimes = [0.0002, 0.01, 0.015]\n";
  const std::vector<std::string> shorter{"time.end=0.0005"};
  const auto file = read_scene_text(text, "scene.toml", shorter);
  EXPECT_EQ(std::get<SurfacePressureEntry>(file.scene.records[1]).times, (std::vector<double>{0.0002, 0.0005}));
  EXPECT_EQ(file.scene.output.interval, 0.0005);
  ASSERT_EQ(file.notes.size(), 3u) << ::testing::PrintToString(file.notes);
  EXPECT_EQ(file.notes[1], "record[1].times: 0.01 s lies after time.end = 0.0005 s of --set: taken at the end");
  EXPECT_EQ(read_scene_text(file.resolved, "scene.toml").resolved, file.resolved);
  EXPECT_TRUE(read_scene_text(text, "scene.toml").notes.empty());
  EXPECT_FALSE(testing::messages_of(testing::replaced(text, "0.015", "0.5")).empty()) << "the file's own end is a rule";
}

TEST(Override, later_ones_win) { EXPECT_EQ(with({"fluid.density=1", "fluid.density=2"}).fluid->density, 2); }

TEST(Override, may_have_blanks_around_the_equals_sign) {
  EXPECT_EQ(with({"fluid.density = 1025 "}).fluid->density, 1025);
}

TEST(Override, is_checked_like_the_file_and_named_in_the_message) {
  EXPECT_EQ(refusal("fluid.density=-3"),
            "--set fluid.density=-3: fluid.density = -3: must be positive (kg/m^3). Use e.g. 1000 for water.");
  EXPECT_TRUE(refusal("fluid.densty=3")
                  .starts_with("--set fluid.densty=3: fluid.densty = 3: unknown key. Did you mean 'density'?"))
      << refusal("fluid.densty=3");
  EXPECT_TRUE(
      refusal("body.wedge.mass=-1").starts_with("--set body.wedge.mass=-1: body.wedge.mass = -1: must not be below 0"));
  EXPECT_TRUE(refusal("coupling.relaxation=2")
                  .starts_with("--set coupling.relaxation=2: coupling.relaxation = 2: must lie in (0, 1]"));
}

TEST(Override, that_names_nothing_is_refused) {
  EXPECT_TRUE(refusal("body.wegde.mass=1")
                  .starts_with("--set body.wegde.mass=1: no body is called 'wegde'. Did you mean 'wedge'?"));
  EXPECT_TRUE(refusal("body.7.mass=1").starts_with("--set body.7.mass=1: no body is called '7'. There is 'wedge'."));
  EXPECT_TRUE(refusal("fluid.density.x=1").starts_with("--set fluid.density.x=1: fluid.density is a single value"));
  EXPECT_TRUE(refusal("fluid.region.0=1").find("is a whole table") != std::string::npos);
  EXPECT_EQ(refusal("fluid.density=1,5"),
            "--set fluid.density=1,5: numbers have a point, not a comma, and lists stand in brackets: did you mean 1.5 "
            "or [1,5]?");
  EXPECT_EQ(refusal("body.wedge.position=0,-1.5"),
            "--set body.wedge.position=0,-1.5: a list stands in brackets: did you mean [0,-1.5]?");
  EXPECT_TRUE(refusal("nonsense").starts_with("--set nonsense: must read key.path=value"));
  EXPECT_TRUE(refusal("=1").find("must read key.path=value") != std::string::npos);
  EXPECT_TRUE(refusal("fluid..density=1").find("a word of the key is empty") != std::string::npos);
  EXPECT_TRUE(refusal("fluid.density=[1").find("not TOML") != std::string::npos);
  EXPECT_TRUE(refusal("fluid.density=1\nx = 2").find("not TOML") != std::string::npos);
}

TEST(Override, of_an_option_of_its_own_is_told_apart_from_what_it_sets) {
  EXPECT_EQ(override_of("--refine 2: fluid.size.refine=2").argument, "fluid.size.refine=2");
  EXPECT_EQ(override_of("--refine 2: fluid.size.refine=2").source, "--refine 2");
  EXPECT_EQ(override_of("title=a: b").argument, "title=a: b");
}

}  // namespace
}  // namespace splashdown::apps::override_scene_test
