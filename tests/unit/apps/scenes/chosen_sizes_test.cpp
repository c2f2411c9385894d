// Sizes that a scene leaves open: what is chosen is what could have been written, and it scales with the scene.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "apps/scene/choose/sizes.hpp"
#include "apps/scene/read/read.hpp"

namespace splashdown::apps::chosen_sizes_test {
namespace {

/// The guide's first scene, `k` times as large with Froude's speeds and times.
std::string box_scene(double k, const std::string& sizes = "", const std::string& hull_size = "") {
  const double root = std::sqrt(k);
  return fmt::format(
      "[time]\nend = {}\n[gravity]\n[tank]\nmin = [{}, {}]\nmax = [{}, {}]\n[fluid]\ndensity = 1000\n{}"
      "[[fluid.region]]\nshape = \"box\"\nmin = [{}, {}]\nmax = [{}, 0.0]\n"
      "[[body]]\nname = \"box\"\nshape = {{type = \"box\", width = {}, height = {}}}\ndensity = 300\n"
      "position = [0.0, {}]\npitch_deg = 20\nvelocity = [{}, {}]\n{}",
      0.5 * root, -2 * k, -k, 2 * k, k, sizes, -2 * k, -k, 2 * k, 0.3 * k, 0.2 * k, 0.25 * k, 0.5 * root, -2 * root,
      hull_size);
}

SceneFile read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return read_scene_text(text, "scene.toml", overrides);
}

TEST(ChosenSizes, written_out_are_the_same_scene_bit_for_bit) {
  const auto open = read(box_scene(1));
  ASSERT_FALSE(open.chosen.empty());
  EXPECT_TRUE(read(open.resolved).chosen.empty()) << "scene.resolved.toml names all sizes";
  EXPECT_EQ(read(open.resolved).resolved, open.resolved);
  std::string fluid = "[fluid.size]\n", hull;
  for (const auto& size : size_rules<2>(open.scene))
    (size.table == "body" ? hull : fluid) += fmt::format("{} = {}\n", size.key, size.value);
  EXPECT_EQ(read(box_scene(1, fluid, hull)).resolved, open.resolved);
}

TEST(ChosenSizes, of_a_scene_ten_times_as_large_are_ten_times_as_large) {
  const auto one = read(box_scene(1)).scene, ten = read(box_scene(10)).scene;
  const double digits = 1e-12;  // of lengths that were rounded to two
  EXPECT_NEAR(ten.fluid->size.surface / one.fluid->size.surface, 10, 10 * digits);
  EXPECT_NEAR(ten.fluid->size.far / one.fluid->size.far, 10, 10 * digits);
  EXPECT_NEAR(ten.bodies[0].size / one.bodies[0].size, 10, 10 * digits);
  EXPECT_EQ(ten.fluid->size.growth, one.fluid->size.growth);
  EXPECT_EQ(ten.fluid->size.wetted_fraction, one.fluid->size.wetted_fraction);
}

TEST(ChosenSizes, are_divided_by_refine_like_those_that_are_written) {
  const auto coarse = read(box_scene(1)).scene, fine = read(box_scene(1), {"fluid.size.refine=2"}).scene;
  EXPECT_EQ(fine.fluid->size.surface, coarse.fluid->size.surface / 2);
  EXPECT_EQ(fine.fluid->size.wetted_fraction, coarse.fluid->size.wetted_fraction / 2);
  EXPECT_EQ(fine.bodies[0].size, coarse.bodies[0].size / 2);
}

TEST(ChosenSizes, leave_alone_what_is_given) {
  const auto hull = read(box_scene(1, "", "size = 0.004\n"));
  EXPECT_EQ(hull.scene.bodies[0].size, 0.004);
  EXPECT_FALSE(hull.chosen.empty());
  const auto surface = read(box_scene(1, "[fluid.size]\nsurface = 0.02\n"));
  EXPECT_TRUE(surface.chosen.empty()) << "who names the surface has the defaults for the rest";
  EXPECT_EQ(surface.scene.bodies[0].size, 0.02);
  EXPECT_EQ(surface.scene.fluid->size.growth, Sizes{}.growth);
}

TEST(ChosenSizes, obey_their_own_rules_and_printed_ones_are_told_when_they_do_not) {
  EXPECT_TRUE(sizes_against_rules<2>(read(box_scene(1)).scene).empty());
  const auto coarse =
      sizes_against_rules<2>(read(box_scene(1, "[fluid.size]\nsurface = 0.02\n", "size = 0.01\n")).scene);
  ASSERT_EQ(coarse.size(), 1u);
  for (const char* piece : {"body.box.size = 0.01 m", "4.8 elements", "not 50", "use 0.00096 m"})
    EXPECT_NE(coarse[0].find(piece), std::string::npos) << piece << " is not in: " << coarse[0];
}

TEST(ChosenSizes, of_a_hull_in_space_may_be_twice_as_large_where_the_root_of_its_jet_has_small_elements) {
  const auto told = [](const std::string& root) {
    return sizes_against_rules<3>(
        read("dimension = 3\n[time]\nend = 0.3\n[tank]\nmin = [-9, -9, -9]\nmax = [9, 9, 2]\n[fluid]\ndensity = 1000\n"
             "[fluid.size]\nsurface = 0.3\ngrowth = 0.25\nwetted_fraction = 0.06\n" +
             root +
             "[[fluid.region]]\nshape = \"box\"\nmin = [-9, -9, -9]\nmax = [9, 9, 0]\n[[body]]\nname = \"ball\"\n"
             "shape = {type = \"sphere\", radius = 1.0}\nmotion = \"prescribed\"\nposition = [0, 0, 1]\n"
             "velocity = [0, 0, -1]\nsize = 0.05\n")
            .scene);
  };
  EXPECT_EQ(told("").size(), 2u) << "size and wetted_fraction";
  EXPECT_EQ(told("hollow = 0.3\nhollow_min = 0.02\n").size(), 2u);
  EXPECT_TRUE(told("hollow = 0.3\nhollow_min = 0.006\n").empty());
}

/// A wedge that is wetted for 1 m to either side at the end: its jet is tan^2 beta / 2 pi thick.
SceneFile read_wedge(double beta, const std::string& sizes, const std::string& hull_size,
                     const std::string& motion = "motion = \"prescribed\"\n") {
  const double end = 2 / std::numbers::pi * std::tan(beta * std::numbers::pi / 180);
  return read(
      fmt::format("dimension = 2\n[time]\nend = {}\n[tank]\nmin = [-9, -9]\nmax = [9, 2]\n[fluid]\ndensity = 1000\n{}"
                  "[[fluid.region]]\nshape = \"box\"\nmin = [-9, -9]\nmax = [9, 0]\n"
                  "[[body]]\nname = \"wedge\"\nshape = {{type = \"wedge\", deadrise_deg = {}, breadth = 4}}\n"
                  "velocity = [0, -1]\n{}{}",
                  end, sizes, beta, motion, hull_size));
}

TEST(ChosenSizes, of_a_hull_of_small_deadrise_resolve_its_jet) {
  const auto told = [](double beta, const std::string& hollow) {
    const auto rules =
        sizes_against_rules<2>(read_wedge(beta, "[fluid.size]\nsurface = 0.3\n" + hollow, "size = 0.01\n").scene);
    return rules.empty() ? "" : rules[0];
  };
  const auto none = told(5, "");
  EXPECT_NE(none.find("without fluid.size.hollow"), std::string::npos) << none;
  EXPECT_NE(none.find("0.0012 m thick, fewer than two elements: use hollow = 0.2, hollow_min = 0.00061 m"),
            std::string::npos)
      << none;
  EXPECT_NE(told(5, "hollow = 0.2\nhollow_min = 0.0025\n").find("hollow_min = 0.0025 m leaves"), std::string::npos);
  EXPECT_EQ(told(5, "hollow = 0.2\nhollow_min = 0.00061\n"), "");
  EXPECT_EQ(told(20, ""), "") << "the hull's own elements do";
  EXPECT_EQ(told(2, ""), "") << "trapped air decides";
}

TEST(ChosenSizes, have_small_elements_at_the_root_of_a_thin_jet_down_to_an_eighth_of_the_hulls) {
  const auto chosen = [](double beta, const std::string& hull_size = "") {
    return read_wedge(beta, "", hull_size).scene.fluid->size;
  };
  EXPECT_EQ(chosen(15).hollow, 0.2);
  EXPECT_EQ(chosen(15).hollow_min, 0.0057) << "half of 0.0114 m";
  EXPECT_TRUE(sizes_against_rules<2>(read_wedge(15, "", "").scene).empty());
  EXPECT_EQ(chosen(5).hollow_min, 0.0025) << "of 0.02 m";
  EXPECT_EQ(sizes_against_rules<2>(read_wedge(5, "", "").scene).size(), 1u) << "and what it leaves is told";
  EXPECT_FALSE(chosen(20).hollow) << "the hull's own elements do";
  EXPECT_FALSE(chosen(15, "size = 0.005\n").hollow) << "so do those that are given";
  EXPECT_FALSE(chosen(2).hollow) << "trapped air decides";
  const auto free = read_wedge(10, "", "", "density = 300\n").scene;
  EXPECT_FALSE(free.fluid->size.hollow) << "it goes on after its peak";
}

TEST(ChosenSizes, of_a_scene_with_mistakes_are_not_among_them) {
  try {
    read(box_scene(1, "", "colour = 1\n"));
    FAIL() << "an unknown key";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("colour"), std::string::npos);
    EXPECT_EQ(std::string(error.what()).find("size.surface"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace splashdown::apps::chosen_sizes_test
