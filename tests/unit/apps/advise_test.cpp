// What theory says of effects obeys laws, whatever the scene: here of scenes drawn at random.
#include "apps/advise/advise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "apps/effects/theory/theory.hpp"
#include "apps/scene/read/read.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::advise_test {
namespace {

using std::numbers::pi;

Scene scene_with(const std::vector<std::string>& set) {
  return read_scene_text(testing::wedge_drop, "scene.toml", set).scene;
}

const AdvisedEffect* effect_in(const SceneAdvice& advice, const std::string& name) {
  const auto found = std::ranges::find(advice.effects, name, &AdvisedEffect::name);
  return found == advice.effects.end() ? nullptr : &*found;
}

/// --set arguments of wedges that are light or heavy, flat or steep, slow or fast, of centimetres or metres.
class Drawn {
 public:
  explicit Drawn(unsigned seed) : random_(seed) {}
  std::vector<std::string> scene() {
    const double breadth = log(0.05, 2);
    return {"record=",
            key("body.wedge.velocity.1", -log(0.1, 40)),
            key("body.wedge.mass", log(5, 1000) * breadth * breadth),
            key("body.wedge.shape.deadrise_deg", log(2, 70)),
            key("body.wedge.shape.breadth", breadth),
            key("body.wedge.position.1", log(1e-4, 0.1)),
            key("body.wedge.size", breadth / 50),
            key("time.end", log(0.02, 5))};
  }
  static std::string key(const std::string& name, double value) { return name + "=" + std::to_string(value); }
  double log(double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<double>(0, 1)(random_));
  }

 private:
  std::mt19937 random_;
};

std::vector<std::string> with(std::vector<std::string> set, const std::string& argument) {
  set.push_back(argument);
  return set;
}

Advised advised_of(const std::string& name, const std::vector<std::string>& set) {
  const auto advice = advice_of(scene_with(set));
  const auto* effect = effect_in(advice, name);
  EXPECT_NE(effect, nullptr) << name;
  return effect ? effect->advice.advised : Advised::off;
}

TEST(Outlook, load_of_a_wedge_at_constant_speed_is_that_of_its_growing_added_mass) {
  // F = dM_a/dt V with M_a = pi/2 rho c^2 and c = 1.25 V t cot(beta): largest where the sides end.
  const auto scene = scene_with({"body.wedge.motion=prescribed", "body.wedge.mass=", "body.wedge.free=", "time.end=1"});
  const auto look = outlook<2>(scene);
  ASSERT_TRUE(look.has_load());
  const double raised = 1.25, c = 0.25, V = 6.15, slope = raised / std::tan(pi / 6);
  const double steps = 200;  // of the scan, which takes differences between them
  EXPECT_NEAR(look.entry->peak_load / (pi * 1000 * c * slope * V * V), 1, 2 / steps);
  EXPECT_NEAR(look.entry->peak_depth * slope / c, 1, 2 / steps);
  EXPECT_NEAR(look.entry->contact_speed / (slope * V), 1, 1e-6);
}

TEST(Outlook, peak_of_a_free_wedge_is_where_the_added_mass_is_a_fifth_of_its_own) {
  const auto look = outlook<2>(scene_with({"gravity="}));
  ASSERT_TRUE(look.has_load());
  const double K = 0.5 * pi * 1000 * std::pow(1.25 / std::tan(pi / 6), 2), m = 241, depth = std::sqrt(m / (5 * K));
  EXPECT_NEAR(look.entry->peak_depth / depth, 1, 0.02);  // a flat maximum between steps of 1/200 of the height
  EXPECT_NEAR(look.entry->peak_load / (2 * K * depth * 6.15 * 6.15 / std::pow(1.2, 3)), 1, 1e-3);
}

TEST(Outlook, loads_go_with_the_square_of_the_speed_and_with_the_density) {
  const auto load = [](const std::vector<std::string>& set) {
    return outlook<2>(scene_with(with(with(set, "gravity="), "time.end=1"))).entry->peak_load;
  };
  const double own = load({});
  EXPECT_NEAR(load({"body.wedge.velocity=[0.0, -12.3]"}) / own, 4, 1e-12);
  EXPECT_NEAR(load({"fluid.density=2000", "body.wedge.mass=482"}) / own, 2, 1e-12);
}

TEST(Outlook, a_fall_ends_with_the_speed_of_its_height) {
  const auto look =
      outlook<2>(scene_with({"body.wedge.velocity=[0.0, 0.0]", "body.wedge.position=[0.0, 0.5]", "time.end=0.5"}));
  ASSERT_TRUE(look.entry);
  EXPECT_NEAR(look.entry->speed, std::sqrt(2 * 9.81 * 0.5), 1e-6);
  EXPECT_FALSE(outlook<2>(scene_with({"body.wedge.velocity=[0.0, 1.0]"})).entry) << "it goes up";
}

TEST(Advice, is_on_or_off_only_where_a_factor_of_three_does_not_change_that) {
  for (const double change : {1e-5, 1e-3, 0.01, 0.1, 2.}) {
    EXPECT_LE(judged(change), judged(1.5 * change));
    EXPECT_EQ(judged(change), judged(-change));
    EXPECT_FALSE(judged(change / trust) == Advised::on && judged(change * trust) == Advised::off);
  }
  EXPECT_EQ(judged(least_change), Advised::doubtful);
}

struct Monotone {
  const char *name, *key;
  double low, high;  ///< values of the key between which the advice must not fall
};

class Grows : public ::testing::TestWithParam<Monotone> {};

TEST_P(Grows, with_what_it_comes_from) {
  const auto& [name, key, low, high] = GetParam();
  Drawn drawn(7);
  for (int i = 0; i < 30; ++i) {
    const auto scene = drawn.scene();
    double a = drawn.log(std::min(low, high), std::max(low, high)),
           b = drawn.log(std::min(low, high), std::max(low, high));
    if ((a > b) == (low < high)) std::swap(a, b);
    const bool down = std::string(key).starts_with("body.wedge.velocity");
    const auto text = [key = key, down](double value) { return Drawn::key(key, down ? -value : value); };
    EXPECT_LE(advised_of(name, with(scene, text(a))), advised_of(name, with(scene, text(b))))
        << text(a) << " " << text(b);
  }
}

INSTANTIATE_TEST_SUITE_P(Effects, Grows,
                         ::testing::Values(Monotone{"compressibility", "body.wedge.velocity.1", 0.1, 70},
                                           Monotone{"cavitation", "body.wedge.velocity.1", 0.1, 70},
                                           Monotone{"trapped air", "body.wedge.shape.deadrise_deg", 60, 0.5},
                                           Monotone{"elasticity", "body.wedge.shape.deadrise_deg", 60, 2},
                                           Monotone{"surface tension", "fluid.density", 10000, 100},
                                           Monotone{"gravity", "time.end", 0.01, 5},
                                           Monotone{"form_drag", "time.end", 0.01, 5}),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           std::ranges::replace(name, ' ', '_');
                           return name;
                         });

TEST(Advice, of_drawn_scenes_has_sources_and_keys_that_add_what_is_advised) {
  Drawn drawn(11);
  for (int i = 0; i < 40; ++i) {
    auto set = drawn.scene();
    if (i % 3 == 1) set.emplace_back("gravity=");
    if (i % 4 == 1) set.emplace_back("tank=");
    const auto advice = advice_of(scene_with(set));
    for (const auto& effect : advice.effects) {
      const auto& of = effect.advice;
      EXPECT_FALSE(of.reason.empty()) << effect.name;
      EXPECT_FALSE((of.change.peak || of.change.motion) && of.source.empty()) << effect.name;
      for (const auto& change : {of.change.peak, of.change.motion})
        EXPECT_TRUE(std::isfinite(change.value_or(0)) && change.value_or(0) >= 0) << effect.name << " " << *change;
      for (const auto& number : of.numbers) EXPECT_FALSE(std::isnan(number.value)) << effect.name << " " << number.name;
      if (effect.present || of.set.empty()) continue;
      auto added = set;
      added.insert(added.end(), of.set.begin(), of.set.end());
      const auto* then = effect_in(advice_of(scene_with(added)), effect.name);
      ASSERT_NE(then, nullptr);
      EXPECT_TRUE(then->present) << effect.name;
    }
  }
}

TEST(Advice, recommends_nothing_that_is_impossible_in_the_scene) {
  Drawn drawn(13);
  for (int i = 0; i < 20; ++i) {
    const auto set = drawn.scene();
    EXPECT_EQ(advised_of("absorber", with(set, "tank=")), Advised::off);
    EXPECT_EQ(advised_of("absorber", with(set, "gravity=")), Advised::off);
    EXPECT_EQ(advised_of("waves", with(set, "gravity=")), Advised::off);
    EXPECT_EQ(advised_of("wind", with(set, "gravity=")), Advised::off);
    EXPECT_NE(advised_of("gravity", with(with(set, "tank="), "gravity=")), Advised::on) << "all would fall together";
    EXPECT_EQ(advised_of("skin_friction", with(set, "body.wedge.shape.deadrise_deg=30")), Advised::off)
        << "nothing slides";
  }
  const std::vector<std::string> still = {"body.wedge.motion=fixed",
                                          "body.wedge.mass=", "body.wedge.free=", "body.wedge.velocity="};
  for (const char* name : {"waves", "form_drag", "trapped air", "elasticity", "absorber"})
    EXPECT_EQ(advised_of(name, still), Advised::off) << name;
}

TEST(Advice, does_not_depend_on_whether_viscosity_is_there_already) {
  Drawn drawn(17);
  for (int i = 0; i < 20; ++i) {
    const auto set = drawn.scene();
    EXPECT_EQ(advised_of("viscosity", set), advised_of("viscosity", with(set, "fluid.viscosity.dynamic=0.001")));
  }
}

// From rest under water: half a second is not a diameter of way, five are twenty.
TEST(Advice, form_drag_holds_up_what_sinks_from_rest) {
  const std::vector<std::string> sinks = {"body.wedge.shape={type = \"circle\", radius = 0.05}",
                                          "body.wedge.mass=",
                                          "body.wedge.density=1500",
                                          "body.wedge.velocity=",
                                          "body.wedge.position=[0.0, -0.2]",
                                          "record=",
                                          "time.end=5"};
  EXPECT_EQ(advised_of("form_drag", sinks), Advised::on);
  EXPECT_EQ(advised_of("form_drag", with(sinks, "time.end=0.05")), Advised::off);
  EXPECT_EQ(advised_of("form_drag", with(sinks, "body.wedge.density=1000")), Advised::off) << "it stays where it is";
}

TEST(Advice, form_drag_is_none_where_a_line_holds) {
  const std::vector<std::string> rises = {"body.wedge.shape={type = \"circle\", radius = 0.05}",
                                          "body.wedge.mass=",
                                          "body.wedge.density=100",
                                          "body.wedge.velocity=",
                                          "body.wedge.position=[0.0, -0.4]",
                                          "record=",
                                          "time.end=5"};
  const auto line = [&](const char* length) {
    return with(rises, std::string("line=[{name = \"tether\", body = \"wedge\", anchor = [0.0, -0.9], "
                                   "axial_stiffness = 1e5, length = ") +
                           length + "}]");
  };
  EXPECT_EQ(advised_of("form_drag", rises), Advised::on);
  EXPECT_EQ(advised_of("form_drag", line("0.505")), Advised::off);
  EXPECT_EQ(advised_of("form_drag", line("2")), Advised::on) << "it never gets taut";
}

TEST(Advice, of_what_goes_in_steep_knows_that_it_is_dry_behind_and_slides) {
  const auto goes_in = [](const char* deadrise) {
    return std::vector<std::string>{"body.wedge.motion=prescribed",
                                    "body.wedge.mass=",
                                    "body.wedge.free=",
                                    "body.wedge.velocity=[0.0, -2.0]",
                                    "record=",
                                    "time.end=0.3",
                                    std::string("body.wedge.shape.deadrise_deg=") + deadrise};
  };
  EXPECT_EQ(advised_of("form_drag", goes_in("75")), Advised::off);
  EXPECT_EQ(advised_of("skin_friction", goes_in("75")), Advised::doubtful);
  EXPECT_EQ(advised_of("skin_friction", goes_in("45")), Advised::off);
}

TEST(Advice, of_a_flat_bottom_names_air_and_compressibility) {
  const std::vector<std::string> flat = {"body.wedge.shape={type = \"box\", width = 0.5, height = 0.1}",
                                         "body.wedge.position=[0.0, 0.06]", "record="};
  EXPECT_EQ(advised_of("trapped air", flat), Advised::on);
  EXPECT_EQ(advised_of("compressibility", flat), Advised::on);
  EXPECT_EQ(advised_of("trapped air", {}), Advised::off);
  EXPECT_EQ(advised_of("compressibility", {}), Advised::off);
}

TEST(Friction, laws_meet_where_boundary_layers_turn) {
  // Turbulent friction is above laminar friction beyond the transition, and both fall.
  for (double reynolds = 5e5; reynolds < 1e10; reynolds *= 3) {
    EXPECT_GT(turbulent_friction(reynolds), laminar_friction(reynolds));
    EXPECT_GT(turbulent_friction(reynolds), turbulent_friction(3 * reynolds));
  }
  EXPECT_NEAR(turbulent_friction(1e7), 0.003, 1e-12);  // 0.075/25
}

}  // namespace
}  // namespace splashdown::apps::advise_test
