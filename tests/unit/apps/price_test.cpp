// Laws of price lists: fits of manufactured series, seconds, rows, what is written and read back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "apps/price/cost.hpp"
#include "apps/price/probes.hpp"
#include "apps/price/write.hpp"
#include "apps/scene/read/read.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps {
namespace {

const std::vector<double> usual = {2, std::sqrt(2.), 1, std::sqrt(0.5)};  // element sizes of the usual ladder

template <class Value>
std::vector<MeshValue> series(const Value& value, const std::vector<double>& sizes = usual) {
  std::vector<MeshValue> values;
  for (const double h : sizes) values.push_back({h, value(h)});
  return values;
}

Convergence fit(const std::vector<MeshValue>& values) { return Convergence::of(values).value(); }

class Order : public ::testing::TestWithParam<double> {};

TEST_P(Order, of_an_exact_series_is_found_with_its_limit_and_the_band_is_a_quarter_wider_than_the_error) {
  const double p = GetParam();
  const auto values = series([p](double h) { return 7 - 0.3 * std::pow(h, p); });
  const auto found = fit(values);
  ASSERT_TRUE(found.order()) << found.refusal();
  const double digits = 1e-6;  // a search to 1e-9 in p, through the condition of the fit, about 1e2 here
  EXPECT_NEAR(*found.order(), p, digits);
  EXPECT_NEAR(found.extrapolated(), 7, digits);
  EXPECT_NEAR(found.band(values.back()), 1.25 * 0.3 * std::pow(values.back().h, p), digits);
}
INSTANTIATE_TEST_SUITE_P(orders, Order, ::testing::Values(0.6, 1., 1.5, 2.));

TEST(Convergence, of_a_higher_order_is_refused_and_bounded_by_one_that_the_method_has) {
  const auto values = series([](double h) { return 1 + 0.1 * h * h * h; });
  const auto found = fit(values);
  EXPECT_FALSE(found.order());
  EXPECT_NE(found.refusal().find("faster than with order 2.1"), std::string::npos) << found.refusal();
  EXPECT_EQ(found.form(), Form::second_order);
  EXPECT_GE(found.band(values.back()), std::abs(values.back().value - 1));
}

TEST(Convergence, of_a_low_order_is_refused_and_said) {
  const auto found = fit(series([](double h) { return 1 + 0.1 * std::log(h); }));
  EXPECT_FALSE(found.order());
  EXPECT_NE(found.refusal().find("below 0.5"), std::string::npos) << found.refusal();
}

TEST(Convergence, of_an_oscillating_series_has_a_band_that_holds_all_of_it) {
  int k = 0;
  const auto values = series([&](double) { return 5 + (k++ % 2 == 0 ? 0.2 : -0.2); });
  const auto found = fit(values);
  EXPECT_TRUE(found.scattered());
  for (const auto& value : values) EXPECT_GE(found.band(value), 0.2);
}

TEST(Convergence, of_a_constant_has_no_band) {
  const auto found = fit(series([](double) { return 4.; }));
  EXPECT_FALSE(found.order());
  EXPECT_EQ(found.band(1), 0);
  EXPECT_NEAR(found.extrapolated(), 4, 1e-12);  // round-off
}

TEST(Convergence, of_three_meshes_has_a_band_and_no_order) {
  const auto values = series([](double h) { return 1 + h; }, {2, 1, 0.5});
  const auto found = fit(values);
  EXPECT_FALSE(found.order());
  const double roundoff = 1e-12;
  EXPECT_NEAR(found.band(values.back()), 3 * 0.5, roundoff);
}

TEST(Convergence, needs_three_sizes_and_numbers) {
  const auto line = [](double h) { return 1 + h; };
  EXPECT_FALSE(Convergence::of(series(line, {2, 1})));
  EXPECT_FALSE(Convergence::of(series(line, {2, 1, 1.02, 0.98})));  // replicates are one
  EXPECT_FALSE(Convergence::of(series([](double h) { return h < 1 ? NAN : h; })));
}

TEST(Convergence, promises_no_less_on_coarser_meshes) {
  for (const double bend : {-0.3, -0.1, 0.1, 0.3}) {
    const auto found = fit(series([=](double h) { return 2 + 0.4 * h + bend * h * h; }));
    for (double h = 0.1; h < 4; h *= 1.1) EXPECT_LE(found.band(h), found.band(1.1 * h) * (1 + 1e-12)) << bend;
  }
}

/// Bands of series with noise, of meshes sqrt(2) apart with two replicates beside the last but one; the truth is 1.
struct NoisyBands {
  int within = 0;
  std::vector<double> bands;

  template <class Error>
  NoisyBands(const Error& error, double noise, int meshes, int tries) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal(0, noise);
    std::vector<double> sizes;
    for (int k = 0; k < meshes; ++k) sizes.push_back(std::pow(0.5, 0.5 * k));
    const double replicated = sizes[sizes.size() - 2];
    sizes.insert(sizes.end() - 1, {replicated / 0.98, replicated / 1.02});
    for (int i = 0; i < tries; ++i) {
      const auto values = series([&](double h) { return 1 + error(h) + normal(random); }, sizes);
      bands.push_back(fit(values).band(values.back()));
      within += std::abs(values.back().value - 1) <= bands.back() ? 1 : 0;
    }
  }
  double share() const { return within / static_cast<double>(bands.size()); }
  double median() {
    const auto middle = bands.begin() + static_cast<std::ptrdiff_t>(bands.size() / 2);
    std::ranges::nth_element(bands, middle);
    return *middle;
  }
};

TEST(Convergence, of_noisy_series_holds_the_true_value_in_nineteen_of_twenty) {
  for (const double p : {1., 2.})
    for (const int meshes : {4, 8})
      for (const double noise : {0.05, 0.3, 1., 3.}) {  // of the finest mesh's error
        const auto power = [p](double h) { return std::pow(h, p); };
        const double finest = power(std::pow(0.5, 0.5 * (meshes - 1)));
        EXPECT_GE(NoisyBands(power, noise * finest, meshes, 100).share(), 0.95) << p << ' ' << noise << ' ' << meshes;
      }
}

TEST(Convergence, of_mere_noise_holds_it_too_and_more_meshes_do_not_widen_the_band) {
  double before = std::numeric_limits<double>::infinity();
  for (const int meshes : {4, 6, 9}) {
    NoisyBands noise([](double) { return 0.; }, 1, meshes, 100);
    EXPECT_GE(noise.share(), 0.95) << meshes;
    const double median = noise.median();
    EXPECT_LT(median, before) << meshes;
    before = median;
  }
}

Rung rung(double refine, double seconds, std::vector<double> values, Role role = Role::rung) {
  return {.spec = {refine, role},
          .folder = "refine",
          .seconds = seconds,
          .steps = 100 * refine,
          .node_steps = 1e4 * refine * refine * refine,
          .memory_mb = 50,
          .values = std::move(values)};
}

PriceQuantity named(const std::string& name, bool counts = true) {
  return {.name = name, .unit = "N", .counts = counts, .path = "bodies." + name, .measured = {}};
}

/// A ladder of first order with seconds that follow node-steps.
std::vector<Rung> ladder() {
  std::vector<Rung> rungs;
  for (const double refine : {0.5, 0.707, 1., 1.41})
    rungs.push_back(rung(refine, 2 * std::pow(refine, 3), {10 + 0.1 / refine, std::sin(100 * refine)}));
  for (const double refine : {0.98, 1.02})
    rungs.push_back(
        rung(refine, 2 * std::pow(refine, 3), {10 + 0.1 / refine, std::sin(100 * refine)}, Role::replicate));
  return rungs;
}

Price price() {
  std::vector<std::string> notes;
  auto price = price_of(ladder(), {named("smooth"), named("wild", false)}, 2, notes);
  price.scene = "scene.toml", price.scene_digest = "0";
  EXPECT_TRUE(notes.empty());
  return price;
}

/// A scene whose time is known: nodes and steps are powers of refine, seconds = around + steps a nodes^p.
struct KnownScene {
  double nodes_power = 1, steps_power = 0.75, step_power = 1.1, around = 0, noise = 0;
  double per_node = 5e-6;
  mutable std::mt19937 random{1};

  double nodes(double refine) const { return 3000 * std::pow(refine, nodes_power); }
  double steps(double refine) const { return 300 * std::pow(refine, steps_power); }
  double seconds(double refine) const {
    return around + steps(refine) * per_node * 3000 * std::pow(nodes(refine) / 3000, step_power);
  }
  Rung made_at(double refine, Role role = Role::rung) const {
    std::normal_distribution<double> normal(0, 1);
    auto made = rung(refine, 0, {}, role);
    const double factor = std::exp(noise * normal(random));
    made.steps = steps(refine), made.node_steps = made.steps * nodes(refine);
    made.seconds = factor * seconds(refine), made.setup_seconds = factor * around;
    return made;
  }
  RunCost cost(const std::vector<double>& refines, ExpectedNodes expected = {}) const {
    std::vector<Rung> rungs;
    for (const double refine : refines) rungs.push_back(made_at(refine));
    return RunCost(rungs, std::move(expected), 2);
  }
};

TEST(RunCost, of_usual_exponents_is_exact_from_one_mesh_on) {
  EXPECT_FALSE(RunCost({}, {}, 2).known());
  // Nodes of a mesh of uniform size in the plane.
  const KnownScene scene{.nodes_power = 2};
  for (const auto& made : {std::vector{1.}, {0.5, 0.707}, {0.5, 0.707, 1., 1.41}})
    for (const double refine : {0.3, 1., 2.5})
      EXPECT_NEAR(scene.cost(made).seconds(refine) / scene.seconds(refine), 1, 1e-9);
}

TEST(RunCost, learns_exponents_from_a_ladder_and_doubts_them_with_two_meshes) {
  // As far from the usual ones as their deviations say.
  const KnownScene scene{.nodes_power = 1.85, .steps_power = 0.9, .step_power = 1.25};
  const auto error = [&](const std::vector<double>& made, double refine) {
    return std::abs(std::log(scene.cost(made).seconds(refine) / scene.seconds(refine)));
  };
  EXPECT_LT(error({0.25, 0.354, 0.5, 0.707, 1}, 4), error({0.707, 1}, 4));
  EXPECT_LT(error({0.25, 0.354, 0.5, 0.707, 1}, 4), std::log(1.3));
  // 0.15 in each of three exponents, over four times the refinement and 4^1.85 times the nodes.
  EXPECT_LT(error({0.707, 1}, 4), (0.15 + 0.15 * 2 * 1.1 + 0.15 * 1.85) * std::log(4.));
}

TEST(RunCost, what_is_around_the_steps_does_not_grow_with_them) {
  const KnownScene scene{.nodes_power = 2, .around = 30};
  const auto cost = scene.cost({0.5, 0.707, 1, 1.41});
  const KnownScene bare{.nodes_power = 2};
  // It grows as the root of the nodes where runs do not say more, and here they say that it does not grow.
  EXPECT_GT(cost.seconds(4), 30 + bare.seconds(4));
  EXPECT_LT(cost.seconds(4), 30 * 4 + bare.seconds(4));
}

TEST(RunCost, beyond_the_ladder_nodes_follow_what_the_sizes_ask_for) {
  const KnownScene scene;
  const auto cost = scene.cost({1}, {{0.5, 100}, {1, 200}, {4, 1600}});
  EXPECT_NEAR(cost.nodes(0.5), scene.nodes(1) / 2, 1e-9);
  EXPECT_NEAR(cost.nodes(4), scene.nodes(1) * 8, 1e-9);
}

TEST(RunCost, one_slow_run_of_six_decides_little) {
  const KnownScene scene;
  std::vector<Rung> rungs;
  for (const double refine : {0.5, 0.707, 1., 1.41}) rungs.push_back(scene.made_at(refine));
  for (const double refine : {0.98, 1.02}) rungs.push_back(scene.made_at(refine, Role::replicate));
  const double quiet = RunCost(rungs, {}, 2).seconds(2);
  rungs[2].seconds *= 2;
  EXPECT_LT(std::abs(std::log(RunCost(rungs, {}, 2).seconds(2) / quiet)), std::log(2.) / 4);
}

/// What probes and the run that is chosen by them take of the time asked for, as run --seconds does it.
double share_taken(const KnownScene& scene, double asked, double guess_off) {
  const auto refine = [](int k) { return std::pow(2., 0.5 * k); };
  const ProbeRange range{-8, 8};
  std::vector<Rung> rungs;
  const auto cost = [&] { return RunCost(rungs, {{1. / 64, 1}, {64, std::pow(4096, scene.nodes_power)}}, 2); };
  double spent = 0;
  std::optional<int> next = first_probe(asked, range, -4, [&](int k) { return guess_off * scene.seconds(refine(k)); });
  while (next) {
    rungs.push_back(scene.made_at(refine(*next)));
    spent += rungs.back().seconds;
    next = next_probe(asked, range, {static_cast<int>(rungs.size()), *next, spent},
                      [&](int k) { return cost().seconds(refine(k)); });
  }
  std::vector<std::string> unused;
  auto price = price_of(rungs, {}, 2, unused);
  price.expected_nodes = {{1. / 64, 1}, {64, std::pow(4096, scene.nodes_power)}};
  return (spent + scene.made_at(*price.refine_in(asked - spent)).seconds) / asked;
}

TEST(Probes, a_run_that_is_told_its_seconds_takes_them) {
  // Exponents one deviation off, clocks that differ by a twentieth from run to run, guesses that are off by six either way.
  for (const double asked : {10., 60., 300.})
    for (const double nodes_power : {0.6, 1., 2.})
      for (const double off : {-1., 0., 1.})
        for (const double guess : {1 / 6., 1., 6.}) {
          const KnownScene scene{.nodes_power = nodes_power,
                                 .steps_power = 0.75 + 0.15 * off,
                                 .step_power = 1.1 + 0.15 * off,
                                 .around = 0.3,
                                 .noise = 0.05};
          const double share = share_taken(scene, asked, guess);
          EXPECT_NEAR(share, 1, 0.3) << asked << " s, nodes " << nodes_power << ", off " << off << ", guess " << guess;
        }
}

TEST(Probes, that_are_too_dear_are_not_made) {
  const auto seconds = [](int k) { return std::pow(2., k); };
  EXPECT_EQ(first_probe(100, {-4, 8}, 0, seconds), 0);
  EXPECT_EQ(first_probe(2, {-4, 8}, 0, seconds), -4);          // of a tenth of a second: a sixteenth
  EXPECT_EQ(first_probe(0.1, {-4, 8}, 0, seconds), -4);        // there is none coarser
  EXPECT_EQ(next_probe(100, {-4, 8}, {1, 0, 1}, seconds), 1);  // one after the other
  EXPECT_EQ(next_probe(100, {-4, 8}, {2, 2, 5}, seconds), 3);
  EXPECT_FALSE(next_probe(100, {-4, 8}, {3, 4, 29}, seconds));  // 64 s are in reach
  EXPECT_EQ(next_probe(200, {-4, 8}, {3, 4, 29}, seconds), 5);  // and not enough here
  EXPECT_EQ(next_probe(60, {-4, 8}, {1, 4, 16}, seconds), std::nullopt);
  EXPECT_EQ(next_probe(100, {-4, 8}, {1, 3, 20}, seconds), 4);  // one alone says nothing of growth
  EXPECT_FALSE(next_probe(100, {-4, 3}, {1, 3, 8}, seconds));   // the scene allows none finer
}

TEST(Price, a_row_s_mesh_has_its_accuracy_and_none_coarser_has) {
  const auto list = price();
  ASSERT_FALSE(list.rows.empty());
  for (const auto& row : list.rows) {
    if (!row.refine || *row.refine == list.coarsest()) continue;
    EXPECT_LE(list.accuracy(*row.refine)->first, 0.01 * row.accuracy_percent);
    EXPECT_GT(list.accuracy(0.99 * *row.refine)->first, 0.01 * row.accuracy_percent);
    EXPECT_EQ(row.extrapolated, *row.refine > 1.41);
    EXPECT_EQ(row.decided_by, "smooth");
  }
}

TEST(Price, of_open_water_counts_what_the_tank_changes) {
  auto rungs = ladder();
  rungs.push_back(rung(1, 2, {10 + 0.1 - 0.05, 0}, Role::larger_tank));
  std::vector<std::string> notes;
  const auto open = price_of(rungs, {named("smooth"), named("wild", false)}, 2, notes).quantities[0];
  const auto closed = price().quantities[0];
  // The mean of the replicates and their rung is 10.1 but for the curvature of 0.1 / refine over 2 %: 3e-5.
  EXPECT_NEAR(*open.tank, 0.05 / (1 - 1 / 2.25), 1e-4);
  EXPECT_NEAR(*open.band(1), *closed.band(1) + *open.tank, 1e-12);
  EXPECT_FALSE(closed.tank);
}

TEST(Price, grows_a_tank_sideways_and_downwards_with_its_water) {
  const auto scene = read_scene_text(testing::wedge_drop, "scene.toml").scene;
  const auto larger = read_scene_text(testing::wedge_drop, "scene.toml", larger_tank_of(scene, "scene.toml")).scene;
  EXPECT_EQ(larger.tank->min, Point(-3, -1.5, 0));
  EXPECT_EQ(larger.tank->max, Point(3, 1, 0));
  const auto& water = std::get<BoxRegion>(larger.fluid->regions[0].shape);
  EXPECT_EQ(water.min, Point(-3, -1.5, 0));
  EXPECT_EQ(water.max, Point(3, 0, 0));
}

TEST(Price, time_and_mesh_are_inverse) {
  const auto list = price();
  for (const double seconds : {1., 5., 20.})
    EXPECT_NEAR(*list.seconds(*list.refine_in(seconds)) / seconds, 1, 1e-4);  // the bisection ends at 1e-6 in refine
}

TEST(Price, written_and_read_back_it_says_the_same) {
  const ScratchFolder folder;
  const auto again = read_price(folder.write(price_file, price_json(price())));
  EXPECT_EQ(price_json(again), price_json(price()));
  EXPECT_EQ(price_text(again), price_text(price()));
}

TEST(Price, of_a_file_that_is_none_is_refused) {
  const ScratchFolder folder;
  const auto file = folder.write(price_file, "{\"rows\": 3}");
  EXPECT_THROW(read_price(file), std::runtime_error);
}

TEST(PriceQuantity, is_read_with_its_table_and_condition) {
  const auto quantity = parsed_quantity("peak=max(fy) from bodies.csv:wedge where time > 0.1");
  EXPECT_EQ(quantity.name, "peak");
  EXPECT_EQ(quantity.measured.quantity, "max(fy)");
  EXPECT_EQ(quantity.measured.table, "bodies.csv:wedge");
  EXPECT_EQ(quantity.measured.where, "time > 0.1");
}

TEST(PriceQuantity, that_no_run_can_measure_is_refused_with_a_cure) {
  const auto scene = read_scene_text(testing::wedge_drop, "scene.toml").scene;
  for (const char* bad : {"max(fy)", "=3", "a-b=3", "a=max(", "a=max(fx) from bodies.csv:wegde",
                          "a=summary.bodies.wedge.peek", "a=max(value)"})
    EXPECT_THROW(check_price_quantities({parsed_quantity(bad)}, scene), SceneError) << bad;
  EXPECT_NO_THROW(check_price_quantities({parsed_quantity("a=max(fy) from bodies.csv:wedge")}, scene));
}

TEST(PriceQuantity, defaults_follow_bodies_and_records) {
  const auto scene = read_scene_text(testing::wedge_drop, "scene.toml").scene;
  std::vector<std::string> names;
  for (const auto& quantity : default_quantities(scene)) names.push_back(quantity.name);
  for (const char* name : {"wedge.peak_g_cfc60", "wedge.impulse", "wedge.velocity_change", "keel.peak_pressure"})
    EXPECT_NE(std::ranges::find(names, name), names.end()) << name;
}

TEST(Price, belongs_to_its_scene_whatever_its_refinement_and_title) {
  const ScratchFolder folder;
  const auto file = folder.write("scene.toml", testing::wedge_drop);
  const auto digest = [&](std::vector<std::string> set) { return digest_of_scene(file, std::move(set)); };
  EXPECT_EQ(digest({}), digest({"fluid.size.refine=2", "title=other", "output.frames=0.1"}));
  EXPECT_NE(digest({}), digest({"body.wedge.mass=240"}));
  EXPECT_NE(digest({}), digest({"fluid.size.surface=0.02"}));
}

}  // namespace
}  // namespace splashdown::apps
