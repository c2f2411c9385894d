// Keys and words of the other dimension say where they belong: every one that its reader asks for.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>

#include "apps/scene/read/read.hpp"
#include "apps/scene/sketch.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::dimension_test {
namespace {

const std::string in_space = R"(dimension = 3
[time]
end = 1
[gravity]
[tank]
min = [-2, -2, -2]
max = [2, 2, 2]
[fluid]
density = 1000
[fluid.size]
surface = 0.2
[[fluid.region]]
shape = "box"
min = [-2, -2, -2]
max = [2, 2, 0]
[[body]]
name = "hull"
shape = {type = "box", size = [1.0, 0.5, 0.3]}
mass = 24
[[joint]]
type = "weld"
body = "hull"
[[record]]
kind = "acceleration"
name = "seat"
body = "hull"
point = [0, 0, 0]
)";
const std::string in_plane = testing::wedge_drop + "[[joint]]\ntype = \"weld\"\nbody = \"wedge\"\n";

/// Tables of scenes by their headers, and where they stand in both scenes.
const std::map<std::string, std::string> tables = {
    {"time", "time"},       {"fluid", "fluid"},   {"fluid.size", "fluid.size"},   {"fluid.region", "fluid.region.0"},
    {"tank", "tank"},       {"body", "body.0"},   {"body.shape", "body.0.shape"}, {"joint", "joint.0"},
    {"record", "record.0"}, {"output", "output"}, {"gravity", "gravity"}};

std::set<std::string> keys_of(const Sketch& sketch, const std::string& header) {
  std::set<std::string> keys;
  if (const auto* visits = sketch.find(header))
    for (const auto& visit : *visits)
      for (const auto& [key, wanted] : visit.keys) keys.insert(key);
  return keys;
}

TEST(KeyOfTheOtherDimension, says_so_whichever_it_is) {
  std::array<Sketch, 2> sketches;
  for (const int d : {2, 3}) sketch_scene(sketches[static_cast<std::size_t>(d - 2)], d);
  std::set<std::string> seen;
  for (const int d : {2, 3})
    for (const auto& [header, place] : tables) {
      const auto own = keys_of(sketches[static_cast<std::size_t>(d - 2)], header);
      for (const auto& key : keys_of(sketches[static_cast<std::size_t>(3 - d)], header)) {
        if (own.contains(key)) continue;
        seen.insert(header + "." + key);
        const auto messages = testing::messages_of(d == 2 ? in_plane : in_space, {place + "." + key + "=1"});
        const std::string rule =
            d == 2 ? ": exists in space only (dimension = 3)" : ": exists in the plane only (dimension = 2)";
        EXPECT_TRUE(std::ranges::any_of(
            messages,
            [&](const std::string& message) { return message.find("." + key + " = 1" + rule) != std::string::npos; }))
            << place << "." << key << ": " << ::testing::PrintToString(messages);
      }
    }
  for (const char* known :
       {"fluid.region.surface_amplitude", "body.heading_deg", "body.shape.breadth", "body.shape.profile", "record.y"})
    EXPECT_TRUE(seen.contains(known)) << known;
}

TEST(WordOfTheOtherDimension, says_so) {
  const auto told = [](const std::string& scene, const char* set, const char* text) {
    const auto messages = testing::messages_of(scene, {set});
    ASSERT_FALSE(messages.empty()) << set;
    EXPECT_NE(messages[0].find(text), std::string::npos) << messages[0];
  };
  told(in_space, "body.0.shape.type=wedge", "'wedge' exists in the plane only (dimension = 2)");
  told(in_space, "fluid.region.0.shape=ellipse", "'ellipse' exists in the plane only");
  told(in_space, "body.0.free=[\"rotation\"]", "'rotation' exists in the plane only");
  told(in_plane, "body.0.shape.type=sphere", "'sphere' exists in space only (dimension = 3)");
  told(in_plane, "body.0.free=[\"roll\", \"z\"]", "'roll' exists in space only");
}

/// What stands where a number is wanted, and what to write.
struct Text {
  const char *set, *cure;
};
TEST(TextInPlaceOfANumber, has_a_cure_about_the_number) {
  for (const auto& [set, cure] :
       {Text{"body.0.mass=\"2.5 kg\"", "Write the number alone, in kg/m: 2.5."},
        Text{"body.0.mass=\"2.5 t\"", "in kg/m: 2500."}, Text{"body.0.mass=\"250 g\"", "in kg/m: 0.25."},
        Text{"body.0.mass=\"heavy\"", "Write the number alone, in kg/m."},
        Text{"body.0.mass=\"2.5 stone\"", "Write the number alone, in kg/m."},
        Text{"body.0.mass=true", "Write one number, in kg/m."}, Text{"body.0.mass=[2.5]", "Write one number, in kg/m."},
        Text{"body.0.size=\"5 mm\"", "in m: 0.005."}, Text{"body.0.size=\"1 in\"", "in m: 0.0254."},
        Text{"body.0.velocity=[\"0\", -1]", "in m/s: 0."}, Text{"body.0.velocity=[0, \"-36 km/h\"]", "in m/s: -10."},
        Text{"body.0.pitch_deg=\"0.5 rad\"", "in deg: 28.6479."}, Text{"body.0.spin_deg=\"10 rpm\"", "in deg/s: 60."},
        Text{"time.end=\"20 ms\"", "in s: 0.02."}, Text{"fluid.density=\"1 g/cm^3\"", "in kg/m^3: 1000."},
        Text{"time.cfl=\"0.5\"", "Write the number without quotes: 0.5."},
        Text{"coupling.max_passes=50.0", "without a point, e.g. 50."}}) {
    const auto messages = testing::messages_of(testing::wedge_drop, {set});
    ASSERT_EQ(messages.size(), 1u) << set << ::testing::PrintToString(messages);
    EXPECT_TRUE(messages[0].ends_with(cure)) << messages[0] << "\nshould end with " << cure;
  }
}

/// Sizes that refine makes too large, and what a message calls them.
TEST(SizeThatRefineChanged, names_the_key_its_value_and_what_changed_it) {
  const auto without_sizes = testing::wedge_drop_with("[fluid.size]\nsurface = 0.01\nfar = 0.2\n", "");
  const std::string tail =
      "must not exceed the smallest extent of fluid.region[0], 1 m. Use e.g. a twentieth of it. Or use a "
      "refine nearer to 1.";
  struct Origin {
    std::string scene, set, text;
  };
  for (const auto& [scene, set, text] :
       {Origin{testing::wedge_drop_with("surface = 0.01", "surface = 0.19"), "--refine 0.1: fluid.size.refine=0.1",
               "scene.toml:12: fluid.size.surface = 0.19, 1.9 once divided by --refine 0.1: "},
        Origin{testing::wedge_drop_with("surface = 0.01", "surface = 0.19"), "fluid.size.refine=0.1",
               "scene.toml:12: fluid.size.surface = 0.19, 1.9 once divided by --set fluid.size.refine=0.1: "},
        Origin{testing::wedge_drop_with("surface = 0.01", "surface = 0.19"),
               "--accuracy 2% (refine 0.1): fluid.size.refine=0.1",
               "scene.toml:12: fluid.size.surface = 0.19, 1.9 once divided by --accuracy 2% (refine 0.1): "},
        Origin{testing::wedge_drop_with("surface = 0.01", "refine = 0.1\nsurface = 0.19"), "title=a",
               "scene.toml:13: fluid.size.surface = 0.19, 1.9 once divided by fluid.size.refine = 0.1: "},
        Origin{without_sizes, "--refine 0.05: fluid.size.refine=0.05",
               "--refine 0.05: fluid.size.surface = 0.1 (chosen, because the scene names none), 2 once divided by "
               "--refine 0.05: "}}) {
    const auto messages = testing::messages_of(scene, {set});
    EXPECT_TRUE(std::ranges::any_of(messages, [&](const std::string& message) { return message == text + tail; }))
        << ::testing::PrintToString(messages) << "\nshould hold " << text + tail;
  }
}

/// Geometry that cannot be built is told by its key.
TEST(GeometryThatCannotBeBuilt, is_refused_with_its_key) {
  for (const auto& [set, key] :
       {std::pair{"fluid.region.0.max=[2, -0.9999999995]", "fluid.region[0].max"},
        std::pair{"tank.max=[2, -0.9999999995]", "tank.max"}, std::pair{"tank.max=[-1.9999999999, 1]", "tank.max"},
        std::pair{"fluid.region.0.min=[1.9999999999, -1]", "fluid.region[0].max"},
        std::pair{"body.0.shape.height=1e-12", "body.wedge.shape.height"}}) {
    const auto messages = testing::messages_of(testing::wedge_drop, {set});
    EXPECT_TRUE(std::ranges::any_of(
        messages,
        [&, k = std::string(key)](const std::string& message) { return message.find(k + " = ") != std::string::npos; }))
        << set << ": " << ::testing::PrintToString(messages);
  }
  const auto of_polygon = testing::messages_of(
      testing::wedge_drop_with("shape = \"box\"\nmin = [-2, -1]\nmax = [2, 0]",
                               "shape = \"ellipse\"\ncentre = [0, -0.5]\nsemi_axes = [1.0, 1e-9]"));
  ASSERT_FALSE(of_polygon.empty());
}

}  // namespace
}  // namespace splashdown::apps::dimension_test
