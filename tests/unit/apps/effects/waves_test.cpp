// [waves]: what is read, refused and asked, the water at t = 0, and bodies that meet the wave where it is wanted.
#include "apps/effects/waves/waves.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "apps/build/build.hpp"
#include "apps/check/questions.hpp"
#include "apps/effects/waves/region.hpp"
#include "apps/effects/waves/sea.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/read/read.hpp"
#include "fluid/effects/waves/waves.hpp"
#include "fluid/pfem/spec.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::waves_test {
namespace {

using testing::Mistake;

const std::string tank_of_waves = R"([time]
end = 3
[gravity]
[tank]
min = [-6, -0.4]
max = [6, 1.5]
[fluid]
density = 1000
[fluid.size]
surface = 0.05
[[fluid.region]]
shape = "box"
min = [-6, -0.4]
max = [6, 0]
[waves]
type = "regular"
height = 0.08
period = 1.2
[[body]]
name = "ball"
shape = {type = "circle", radius = 0.05}
density = 300
position = [0.3, 0.6]
)";

std::string waves_with(const std::string& from, const std::string& to) {
  return testing::replaced(tank_of_waves, from, to);
}
Scene scene_of(const std::string& text) { return read_scene_text(text, "scene.toml").scene; }

class BadWaves : public ::testing::TestWithParam<Mistake> {};

TEST_P(BadWaves, are_refused_with_place_key_rule_and_cure) {
  const auto& bad = GetParam();
  testing::expect_refused(waves_with(bad.from, bad.to), bad);
}

const std::vector<Mistake> mistakes = {
    {"type_unknown", "\"regular\"", "\"reglar\"", 16, "waves.type = \"reglar\"", "Did you mean 'regular'?"},
    {"breaks", "height = 0.08", "height = 0.25", 17, "waves.height = 0.25: waves", "Use a lower or a longer wave"},
    {"no_period", "period = 1.2\n", "", 15, "waves.period: a wave has a period or a length", "Give one of them"},
    {"period_and_length", "period = 1.2", "period = 1.2\nlength = 2", 19,
     "waves.length = 2: a wave has a period or a length", "Remove one"},
    {"of_another_type", "period = 1.2", "period = 1.2\nseed = 3", 19, "waves.seed = 3: unknown key", "Valid here"},
    {"no_gravity", "[gravity]\n", "", 14, "waves: needs [gravity]", "Add [gravity]"},
    {"region_too_short", "min = [-6, -0.4]\nmax = [6, 0]", "min = [-5, -0.4]\nmax = [6, 0]", 15,
     "waves: needs a fluid.region", "from wall to wall"},
    {"absorber_beside", "[fluid.size]", "[fluid.absorber]\nwidth = 1\nrate = 5\n[fluid.size]", 18, "waves: absorbs",
     "Remove [fluid.absorber]"},
    {"zones_fill_the_tank", "period = 1.2", "period = 1.2\nzone = 6", 19, "waves.zone = 6: two zones", "between them"},
    {"tank_too_short", "period = 1.2", "period = 2.5", 6, "tank.max", "two zones of"},
    {"askew_in_the_plane", "period = 1.2", "period = 1.2\ndirection_deg = 30", 19, "waves.direction_deg = 30",
     "0 or 180 in the plane"},
    {"touchdown_of_nobody", "[[body]]", "[waves.touchdown]\nbody = \"bal\"\nat = \"crest\"\n[[body]]", 20,
     "waves.touchdown.body = \"bal\"", "Did you mean 'ball'?"},
    {"touchdown_nowhere", "[[body]]", "[waves.touchdown]\nbody = \"ball\"\nat = \"top\"\n[[body]]", 21,
     "waves.touchdown.at = \"top\"", "'crest'"},
    {"touchdown_twice", "[[body]]", "[waves.touchdown]\nbody = \"ball\"\nat = \"crest\"\nphase_deg = 3\n[[body]]", 21,
     "waves.touchdown.at", "exclude each other"},
    {"touchdown_too_late", "end = 3", "end = 0.1\n[waves.touchdown]\nbody = \"ball\"\nat = \"crest\"", 3,
     "waves.touchdown", "does not touch the water"},
};
INSTANTIATE_TEST_SUITE_P(All, BadWaves, ::testing::ValuesIn(mistakes), [](const auto& of) { return of.param.name; });

TEST(WavesTable, irregular_ones_have_no_phase_to_land_on) {
  const auto messages = testing::messages_of(waves_with("type = \"regular\"\nheight = 0.08\nperiod = 1.2",
                                                        "type = \"irregular\"\nsignificant_height = 0.05\npeak_period "
                                                        "= 1.2\n[waves.touchdown]\nbody = \"ball\"\nat = \"crest\""));
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].find("an irregular sea has no one phase"), std::string::npos) << messages[0];
}

TEST(WavesTable, absent_is_absent) {
  const auto scene = scene_of(waves_with("[waves]\ntype = \"regular\"\nheight = 0.08\nperiod = 1.2\n", ""));
  EXPECT_EQ(scene.effects.find<Waves>(), nullptr);
  for (const auto& effect : parts_of<2>(scene).effects) EXPECT_NE(effect->name(), "waves");
  EXPECT_FALSE(fluid_spec<2>(scene).liquids[0].velocity);
}

// In the plane and in space, with and without a spectrum: a closed surface around as much water as below a flat one.
TEST(WavesTable, water_is_as_much_as_below_a_flat_surface) {
  const auto volume = [](const Surface<2>& s) {
    double sum = 0;
    for (Eigen::Index f = 0; f < s.facets.cols(); ++f) {
      const Vec<2> a = s.vertices.col(s.facets(0, f)), b = s.vertices.col(s.facets(1, f));
      sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
    return sum;
  };
  EXPECT_NEAR(volume(fluid_spec<2>(scene_of(tank_of_waves)).liquids[0].boundary), 12 * 0.4, 1e-9);
  BoxRegion box{.min = Point(-1, -0.5, -0.7), .max = Point(2, 1.5, 0)};
  for (const Eigen::Vector2i& pieces : {Eigen::Vector2i(7, 1), Eigen::Vector2i(30, 20)}) {
    const auto surface = wavy_box<3>(box, {pieces, [&](const Vec<3>& x) {
                                             return 0.05 * std::cos(3 * x.x() + (pieces[1] > 1 ? 2 * x.y() : 0)) + 0.02;
                                           }});
    double sum = 0;
    Vec<3> area = Vec<3>::Zero();
    for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
      const Vec<3> a = surface.vertices.col(surface.facets(0, f)), b = surface.vertices.col(surface.facets(1, f)),
                   c = surface.vertices.col(surface.facets(2, f));
      sum += a.dot(b.cross(c)) / 6;
      area += 0.5 * (b - a).cross(c - a);
    }
    EXPECT_NEAR(area.norm(), 0, 1e-12);                  // closed
    EXPECT_NEAR(sum, 3 * 2 * 0.7, 3 * 2 * 0.07 * 1e-3);  // facets are not bilinear
  }
}

// Facets that overlap are more than what they cover: a long tank's sides seen from a corner, and a wave steeper than the line of sight.
TEST(WavesTable, sides_of_a_long_tank_do_not_overlap) {
  const BoxRegion box{.min = Point(-20, -3, -4), .max = Point(20, 3, 0)};
  const int pieces = 200;
  const auto surface = wavy_box<3>(box, {{pieces, 2}, [](const Vec<3>& x) { return 0.3 * std::sin(0.7 * x.x()); }});
  double sides = 0, floor = 0,
         exact = 6 * 2 * 4.0;  // at both ends the wave's height is that of its odd part, and cancels
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
    const Vec<3> a = surface.vertices.col(surface.facets(0, f)), b = surface.vertices.col(surface.facets(1, f)),
                 c = surface.vertices.col(surface.facets(2, f));
    const Vec<3> area = 0.5 * (b - a).cross(c - a);
    if (std::abs(area.z()) < 1e-12) sides += area.norm();
    if (a.z() == -4 && b.z() == -4 && c.z() == -4) floor += area.norm();
  }
  exact += 2 * 40 * 4.0;  // under a line whose mean is the still level
  EXPECT_NEAR(sides, exact, 1e-9 * exact);
  EXPECT_NEAR(floor, 240, 1e-9 * 240);
}

// Wherever it starts, however fast it falls, and whatever wave it is.
TEST(Touchdown, is_where_it_is_wanted) {
  std::mt19937 draw(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const char* at : {"crest", "back", "trough", "front"})
    for (int k = 0; k < 3; ++k) {
      auto text =
          waves_with("position = [0.3, 0.6]",
                     fmt::format("position = [{}, {}]\nvelocity = [{}, {}]\nspin_deg = {}", uniform(draw) - 0.5,
                                 0.2 + uniform(draw), 2 * uniform(draw), -3 * uniform(draw), 90 * uniform(draw)));
      text = testing::replaced(text, "[[body]]",
                               fmt::format("[waves.touchdown]\nbody = \"ball\"\nat = \"{}\"\n[[body]]", at));
      if (k == 1)
        text = testing::replaced(text, "{type = \"circle\", radius = 0.05}",
                                 "{type = \"box\", width = 0.2, height = 0.1}");
      const double wanted = at[0] == 'c' ? 0 : at[0] == 'b' ? 0.25 : at[0] == 't' ? 0.5 : 0.75;
      // A flat bottom may meet any slope with a corner that is not there: that is said.
      if (k == 1) {
        try {
          scene_of(text);
        } catch (const SceneError& error) {
          EXPECT_NE(std::string(error.what()).find("too wide for this wave"), std::string::npos) << error.what();
          continue;
        }
      }
      const auto scene = scene_of(text);
      const auto sea = sea_of<2>(scene);
      const auto contact = first_contact<2>(scene, scene.bodies[0], *sea, 0, scene.time.end);
      ASSERT_TRUE(contact);
      const double turns = sea->phase(contact->place, contact->time) / (2 * std::numbers::pi) - wanted;
      EXPECT_LT(std::abs(turns - std::round(turns)), 0.005) << text;
      EXPECT_NEAR(contact->place.y(), sea->elevation(contact->place, contact->time), 1e-9);
    }
}

TEST(Touchdown, of_a_focused_group_is_at_its_crest) {
  auto text = waves_with("type = \"regular\"\nheight = 0.08\nperiod = 1.2",
                         "type = \"focused\"\ncrest = 0.06\npeak_period = 1.2\nfocus = [0, 0]\nfocus_time = 1\n"
                         "[waves.touchdown]\nbody = \"ball\"\nat = \"crest\"");
  const auto scene = scene_of(text);
  const auto sea = sea_of<2>(scene);
  const auto contact = first_contact<2>(scene, scene.bodies[0], *sea, 0, scene.time.end);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(sea->elevation(contact->place, contact->time), 0.06, 1e-4);
}

TEST(WavesTable, sizes_are_chosen_for_the_wave) {
  const auto scene = scene_of(waves_with("[fluid.size]\nsurface = 0.05\n", ""));
  EXPECT_LE(scene.fluid->size.surface, sea_of<2>(scene)->length() / 39);
}

TEST(WavesTable, gauges_tell_the_sea_without_bodies) {
  const auto scene = scene_of(tank_of_waves + "[[record]]\nkind = \"surface_elevation\"\nname = \"g\"\nx = 0.2\n");
  const auto settings = recorder_settings<2>(scene, "");
  ASSERT_EQ(settings.signals.size(), 1u);
  EXPECT_EQ(settings.signals[0].name, "g.undisturbed");
  EXPECT_NEAR(settings.signals[0].value(0.7), sea_of<2>(scene)->elevation(Vec<2>(0.2, 0), 0.7), 1e-14);
}

TEST(WavesQuestions, are_asked_once) {
  const auto asked = [](const std::string& from, const std::string& to) {
    const auto scene = scene_of(waves_with(from, to));
    const auto list = questions<2>(scene, predicted_cost<2>(scene));
    std::string all;
    for (const auto& question : list) all += question + "\n";
    return all;
  };
  EXPECT_EQ(asked("end = 3", "end = 3"), "");
  EXPECT_NE(asked("surface = 0.05", "surface = 0.099").find("elements on waves of"), std::string::npos);
  EXPECT_NE(asked("period = 1.2", "period = 1.2\nzone = 1").find("throws waves back"), std::string::npos);
  EXPECT_NE(asked("position = [0.3, 0.6]", "position = [-4, 0.6]").find("stands in a zone"), std::string::npos);
  EXPECT_NE(asked("position = [0.3, 0.6]", "position = [0.3, 0]").find("at rest in water that moves"),
            std::string::npos);
}

}  // namespace
}  // namespace splashdown::apps::waves_test
