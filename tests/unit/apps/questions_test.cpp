// What a scene may not mean is asked, once and with a proposal; scenes that mean it are left alone.
#include "apps/check/questions.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "apps/scene/read/read.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::questions_test {
namespace {

template <int d>
std::vector<std::string> asked_of(const Scene& scene) {
  return questions<d>(scene, predicted_cost<d>(scene));
}

std::vector<std::string> asked_of(const Scene& scene) {
  return scene.dimension == 2 ? asked_of<2>(scene) : asked_of<3>(scene);
}

Scene wedge_drop_with(const std::string& from, const std::string& to) {
  return read_scene_text(testing::wedge_drop_with(from, to), "scene.toml").scene;
}

struct Slip {
  const char *name, *from, *to, *question;
};
void PrintTo(const Slip& slip, std::ostream* out) { *out << slip.name; }

class Slips : public ::testing::TestWithParam<Slip> {};

TEST_P(Slips, are_asked_about_once_with_a_proposal) {
  const auto list = asked_of(wedge_drop_with(GetParam().from, GetParam().to));
  ASSERT_EQ(list.size(), 1u) << ::testing::PrintToString(list);
  EXPECT_EQ(list[0], GetParam().question);
}

const std::vector<Slip> slips = {
    {"no_tank", "[tank]\nmin = [-2, -1]\nmax = [2, 1]\n", "",
     "there is gravity, but nothing holds the liquid: it falls freely, and what floats in it too: did you mean to "
     "write "
     "a [tank] with min and max?"},
    {"gravity_upward", "[0, -9.81]", "[0, 9.81]",
     "gravity.acceleration points upward (9.81 along y): did you mean [0.0, -9.81]?"},
    {"density_in_grams", "density = 1000", "density = 1.0",
     "fluid.density = 1: lighter than any liquid (liquid hydrogen 70, mercury 13600 kg/m^3): did you mean 1000?"},
    {"density_of_no_liquid", "density = 1000", "density = 1e6",
     "fluid.density = 1e+06: heavier than any liquid (liquid hydrogen 70, mercury 13600 kg/m^3): did you mean 1000?"},
    {"end_in_milliseconds", "end = 0.02", "end = 500",
     "time.end = 500 s: about 220000 steps, 6200 times the 81.09 ms in which things move by their length: did you "
     "mean "
     "0.5 s?"},
    {"body_size_in_millimetres", "size = 0.005", "size = 1e-5",
     "body.wedge.size = 1e-05 m: 50000 elements across the body of 0.5 m: did you mean 0.01 m?"},
    {"mass_in_grams", "mass = 241", "mass = 241e3",
     "body.wedge has a mean density of 6.68e+06 kg/m^3: denser than any matter (osmium 22600): did you mean mass = "
     "241?"},
    {"body_density_in_grams", "mass = 241", "density = 0.3",
     "body.wedge has a mean density of 0.3 kg/m^3: lighter than air: did you mean density = 300?"},
    {"velocity_upward", "[0, -6.15]", "[0, 6.15]",
     "body.wedge.velocity points upward, away from the water (6.15 along y): did you mean [0.0, -6.15]?"},
    {"frames_a_second", "interval = 0.001", "frames = 50",
     "output.frames = 50 s is the time from frame to frame, and the run ends at 0.02 s: did you mean 0.0002, for 100 "
     "frames?"},
};
INSTANTIATE_TEST_SUITE_P(Table, Slips, ::testing::ValuesIn(slips),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Questions, are_not_asked_of_any_shipped_example) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SPLASHDOWN_EXAMPLES)) {
    const auto name = entry.path().filename().string();
    if (!name.starts_with("scene") || entry.path().extension() != ".toml") continue;
    ++scenes;
    const auto list = asked_of(read_scene(entry.path()).scene);
    EXPECT_TRUE(list.empty()) << entry.path() << ": " << ::testing::PrintToString(list);
  }
  EXPECT_GE(scenes, 30);
}

TEST(Questions, are_not_asked_of_a_body_without_mass) {
  for (const char* none : {"mass = 0", "density = 0"})
    EXPECT_EQ(asked_of(read_scene_text(testing::wedge_drop_with("mass = 241", none), "scene.toml").scene),
              std::vector<std::string>());
}

TEST(Questions, a_mesh_that_keeps_its_cells_does_not_bear_far_ways) {
  const auto with = [](std::vector<std::string> set) {
    set.push_back("fluid.ale.remesh=never");
    return asked_of(
        read_scene(std::filesystem::path(SPLASHDOWN_EXAMPLES) / "sedimenting_cylinder" / "scene_ale.toml", set).scene);
  };
  ASSERT_EQ(with({}).size(), 1u);
  EXPECT_NE(with({})[0].find("body.cylinder goes up to"), std::string::npos) << with({})[0];
  EXPECT_NE(with({})[0].find("did you mean \"automatic\"?"), std::string::npos) << with({})[0];
  EXPECT_TRUE(with({"time.end=0.02"}).empty());
  EXPECT_TRUE(with({"body.cylinder.density=1000"}).empty());
}

TEST(Questions, a_hull_of_a_kilometre_may_be_in_millimetres) {
  auto text = testing::wedge_drop_with("breadth = 0.5", "breadth = 500");
  for (const auto& [from, to] : {std::pair{"min = [-2, -1]\nmax = [2, 1]", "min = [-2000, -1000]\nmax = [2000, 1000]"},
                                 std::pair{"min = [-2, -1]\nmax = [2, 0]", "min = [-2000, -1000]\nmax = [2000, 0]"}})
    text = testing::replaced(text, from, to);
  const auto list = asked_of(read_scene_text(text, "scene.toml").scene);
  ASSERT_FALSE(list.empty());
  EXPECT_EQ(list[0], "body.wedge is 500 m long: are its lengths in millimetres? Did you mean 0.5 m?");
}

/// Sizes that no machine can run, and how the estimate says so.
class HugeScene : public ::testing::TestWithParam<const char*> {};

TEST_P(HugeScene, is_judged_at_once_and_has_to_be_asked_for) {
  const auto begin = std::chrono::steady_clock::now();
  const auto scene = wedge_drop_with("surface = 0.01", std::string("surface = ") + GetParam());
  const auto cost = predicted_cost<2>(scene);
  EXPECT_TRUE(cost.at_least);
  EXPECT_GT(cost.bytes, memory_unasked);
  EXPECT_TRUE(std::isfinite(cost.nodes));
  ASSERT_TRUE(too_large(cost));
  EXPECT_NE(too_large(cost)->find("more than the 4 GB that are taken unasked"), std::string::npos) << *too_large(cost);
  // A hundred times what an idle machine takes.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}
INSTANTIATE_TEST_SUITE_P(Sizes, HugeScene, ::testing::Values("1e-6", "1e-7", "1e-9"));

TEST(Cost, in_space_of_elements_a_tenth_too_small_is_a_lower_bound) {
  const auto scene = read_scene_text(R"(dimension = 3
[time]
end = 1
[gravity]
[tank]
min = [-2, -2, -2]
max = [2, 2, 1]
[fluid]
density = 1000
[fluid.size]
surface = 0.004
[[fluid.region]]
shape = "box"
min = [-2, -2, -2]
max = [2, 2, 0]
)",
                                     "scene.toml")
                         .scene;
  const auto cost = predicted_cost<3>(scene);
  EXPECT_TRUE(cost.at_least);
  EXPECT_LE(cost.nodes, 1.01 * 32 * std::sqrt(2.) / (0.004 * 0.004 * 0.004));  // what it would have
  EXPECT_GT(cost.bytes, memory_unasked);
}

}  // namespace
}  // namespace splashdown::apps::questions_test
