// Laws of price lists: seconds, rows, what is written and read back.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "apps/price/cost.hpp"
#include "apps/price/probes.hpp"
#include "apps/price/write.hpp"
#include "apps/scene/read/read.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::price_test {
namespace {

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
  list_rows(price);
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

/// What a call of run --seconds takes, with a clock that is the cost of a scene: seconds in place of shares.
struct Taken {
  double probes = 0, run = 0;
  bool ended = false;    ///< there is a run that reached its end
  bool guessed = false;  ///< chosen by the guess alone
};

Taken taken_of(const KnownScene& scene, double asked, double guess_off, ProbeRange range = {-8, 8}) {
  const auto refine = [](int k) { return std::pow(2., 0.5 * k); };
  std::vector<Rung> rungs;
  const std::vector<std::pair<double, double>> expected = {{1. / 64, 1}, {64, std::pow(4096, scene.nodes_power)}};
  const auto predicted = [&](int k) { return RunCost(rungs, expected, 2).seconds(refine(k)); };
  ProbePlan plan(asked, {range, -4, [&](int k) { return guess_off * scene.seconds(refine(k)); }});
  Taken taken;
  ProbesMade made;
  std::map<int, double> done;  // of those that were stopped
  while (const auto probe = plan.next(made, predicted)) {
    const auto rung = scene.made_at(refine(probe->mesh));
    const double left = rung.seconds - done[probe->mesh], spent = std::min(left, probe->most);
    (probe->is_run ? taken.run : taken.probes) += spent;
    made.spent += spent;
    if (left > probe->most) {
      if (probe->is_run) return taken;  // refused: the time is too short
      done[probe->mesh] = spent;
      plan.stopped(spent, spent / rung.seconds);
      continue;
    }
    rungs.push_back(rung);
    made = {static_cast<int>(rungs.size()), probe->mesh, made.spent};
    taken.guessed = probe->is_run;
  }
  taken.ended = true;
  if (taken.guessed) return taken;
  std::vector<std::string> unused;
  auto price = price_of(rungs, {}, 2, unused);
  price.expected_nodes = expected;
  taken.run = scene.made_at(*price.refine_in(asked - made.spent)).seconds;
  return taken;
}

/// Exponents one deviation off, clocks that differ by a twentieth from run to run.
template <class See>
void each_scene(const See& see) {
  for (const double nodes_power : {0.6, 1., 2.})
    for (const double off : {-1., 0., 1.})
      see(KnownScene{.nodes_power = nodes_power,
                     .steps_power = 0.75 + 0.15 * off,
                     .step_power = 1.1 + 0.15 * off,
                     .around = 0.3,
                     .noise = 0.05});
}

TEST(Probes, a_run_that_is_told_its_seconds_takes_them) {
  double worst = 1;
  for (const double asked : {10., 60., 300.})
    for (const double guess : {1 / 6., 1., 6.})  // off either way
      each_scene([&](const KnownScene& scene) {
        const auto taken = taken_of(scene, asked, guess);
        EXPECT_TRUE(taken.ended);
        const double share = (taken.probes + taken.run) / asked;
        EXPECT_LT(share, 1.3) << asked << " s, nodes " << scene.nodes_power << ", steps " << scene.steps_power
                              << ", guess " << guess;
        worst = std::min(worst, share);
      });
  // With a third for probes, and twice as fine as the last of them for the run, where time hardly grows with refinement most of it
  // stays: never so much that probes alone would have spent more.
  EXPECT_GT(worst, most_share);
}

TEST(Probes, take_a_third_of_the_time_at_most_whatever_the_guess) {
  for (const double asked : {0.4, 2., 10., 60., 300.})
    for (const double guess : {1e-3, 0.05, 1 / 14., 0.3, 1., 3., 20., 1e3})
      for (const int coarsest : {-8, -4, 2})
        each_scene([&](const KnownScene& scene) {
          const auto taken = taken_of(scene, asked, guess, {coarsest, 8});
          EXPECT_LE(taken.probes, asked / 3 * (1 + 1e-12)) << asked << " s, guess " << guess << ", from " << coarsest;
        });
}

// One probe, fourteen times as dear as it was guessed, is stopped; it is what the time pays for, and goes on as the run.
TEST(Probes, one_that_is_stopped_is_not_lost) {
  const KnownScene scene{.nodes_power = 1};
  const double dear = scene.seconds(0.25), asked = 200. / 138 * dear;
  const auto taken = taken_of(scene, asked, 1 / 14.);
  EXPECT_TRUE(taken.ended);
  EXPECT_TRUE(taken.guessed);
  EXPECT_NEAR(taken.probes, asked / 3, 1e-9);
  EXPECT_NEAR(taken.probes + taken.run, dear, 1e-9);
}

TEST(Probes, none_is_made_where_the_coarsest_is_guessed_to_take_more_than_a_third) {
  ProbePlan plan(10, {{-4, 8}, -4, [](int) { return 4.; }});
  const auto only = plan.next({}, {});
  ASSERT_TRUE(only);
  EXPECT_TRUE(only->is_run);
  EXPECT_EQ(only->mesh, -4);
  EXPECT_EQ(only->most, 10);
  EXPECT_FALSE(plan.next({1, -4, 6}, [](int) { return 0.; }));
}

TEST(Probes, one_that_cannot_go_on_is_followed_by_a_finer_one) {
  ProbePlan plan(100, {{-4, -2}, -4, [](int) { return 1.; }});
  for (const int mesh : {-4, -3, -2}) {
    const auto probe = plan.next({}, {});
    ASSERT_TRUE(probe);
    EXPECT_EQ(probe->mesh, mesh);
    plan.failed();
  }
  EXPECT_FALSE(plan.next({}, {}));
}

TEST(Probes, that_are_too_dear_are_not_made) {
  const auto seconds = [](int k) { return std::pow(2., k); };
  EXPECT_EQ(first_probe(100, {-4, 8}, 0, seconds), 0);
  EXPECT_EQ(first_probe(2, {-4, 8}, 0, seconds), -4);          // of a tenth of a second: a sixteenth
  EXPECT_EQ(first_probe(0.1, {-4, 8}, 0, seconds), -4);        // there is none coarser
  EXPECT_EQ(next_probe(100, {-4, 8}, {1, 0, 1}, seconds), 1);  // one after the other
  EXPECT_EQ(next_probe(100, {-4, 8}, {2, 2, 5}, seconds), 3);
  EXPECT_EQ(next_probe(100, {-4, 8}, {2, 2, 8}, seconds), 4);   // 8 and 16 s together are too many: the finer one
  EXPECT_EQ(next_probe(100, {-4, 8}, {2, 2, 15}, seconds), 3);  // 16 s are too many
  EXPECT_FALSE(next_probe(100, {-4, 8}, {3, 4, 29}, seconds));
  EXPECT_FALSE(next_probe(200, {-4, 8}, {3, 4, 29}, seconds));  // 61 s are more than three tenths, whatever is in reach
  EXPECT_EQ(next_probe(60, {-4, 8}, {1, 4, 16}, seconds), std::nullopt);
  EXPECT_EQ(next_probe(100, {-4, 8}, {1, 3, 16}, seconds), 4);  // one alone says nothing of growth
  EXPECT_FALSE(next_probe(100, {-4, 8}, {1, 3, 20}, seconds));  // but together a third is all
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

TEST(Price, a_row_is_called_measured_only_where_a_run_was_made) {
  const auto list = price();
  int measured = 0;
  for (const auto& row : list.rows) {
    if (!row.refine) continue;
    const bool made = std::ranges::any_of(list.rungs, [&](const Rung& rung) {
      return rung.spec.role == Role::rung && std::abs(rung.spec.refine / *row.refine - 1) < 1e-3;
    });
    EXPECT_STREQ(source_of(row), *row.refine > list.finest() ? "extrapolated" : made ? "measured" : "interpolated");
    measured += made;
  }
  EXPECT_LT(measured, static_cast<int>(list.rows.size()));
}

TEST(Price, says_whether_what_was_asked_for_is_reached) {
  auto list = price();
  for (const double accuracy : {0.2, 1e-6}) {
    list.asked = accuracy;
    EXPECT_NE(price_json(list).find(accuracy > 0.1 ? "\"reached\": true" : "\"reached\": false"), std::string::npos);
  }
}

TEST(Price, of_each_quantity_is_the_list_s_at_most_and_of_one_of_them_the_list_s) {
  std::vector<std::string> notes;
  auto rungs = ladder();
  for (auto& made : rungs) made.values[1] = 20 + 0.1 * std::pow(made.spec.refine, -2);  // dearer at first, then cheaper
  auto list = price_of(rungs, {named("first_order"), named("second_order")}, 2, notes);
  list_rows(list);
  ASSERT_TRUE(row_for(list.rows, 1));
  for (const auto& row : list.rows) {
    if (!row.seconds) continue;
    double dearest = 0;
    for (const auto& quantity : list.quantities) {
      const auto* own = row_for(quantity.rows, row.accuracy_percent);
      ASSERT_TRUE(own) << quantity.what.name << " at " << row.accuracy_percent << " %";
      dearest = std::max(dearest, *own->seconds);
    }
    EXPECT_DOUBLE_EQ(dearest, *row.seconds) << row.accuracy_percent << " %, decided by " << row.decided_by;
  }
  EXPECT_FALSE(row_for(list.quantities[0].rows, 1e-9));
  EXPECT_TRUE(price().quantities[1].rows.empty()) << "it does not count";
}

TEST(Price, list_has_the_accuracy_that_is_asked_for) {
  EXPECT_EQ(listed_percent({}), (std::vector<double>{20, 10, 5, 2, 1, 0.5}));
  EXPECT_EQ(listed_percent(5), listed_percent({}));
  EXPECT_EQ(listed_percent(4), (std::vector<double>{20, 10, 5, 4, 2, 1, 0.5}));
  auto list = price();
  list.percent = listed_percent(0.7);
  list_rows(list);
  const auto row = std::ranges::find(list.rows, 0.7, &PriceRow::accuracy_percent);
  ASSERT_NE(row, list.rows.end());
  ASSERT_TRUE(row->seconds);
  EXPECT_NEAR(list.accuracy(*row->refine)->first, 0.007, 1e-6);
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

TEST(PriceQuantity, of_a_patch_has_no_value_on_a_mesh_that_does_not_resolve_it) {
  const auto text = std::string(testing::wedge_drop) +
                    "\n[[record]]\nkind = \"pressure_patch\"\nname = \"belly\"\nbody = \"wedge\"\n"
                    "centre = [0.0, 0.0]\nradius = 0.05\n";
  const auto quantities = default_quantities(read_scene_text(text, "scene.toml").scene);
  const auto patch = *std::ranges::find(quantities, "belly.peak_pressure", &PriceQuantity::name);
  const ScratchFolder folder;
  const auto measured = [&](double elements) {
    folder.write("summary.json",
                 fmt::format(R"({{"patches": {{"belly": {{"peak_pressure": {{"value": 7}}, )"
                             R"("grades": {{"peak_pressure": {{"evidence": {{"patch_elements": {}}}}}}}}}}}}})",
                             elements));
    std::string why;
    const double value = value_in(folder.path(), patch, why);
    EXPECT_EQ(std::isnan(value), why.find("patch_elements") != std::string::npos) << why;
    return value;
  };
  EXPECT_EQ(measured(2.1), 7);
  EXPECT_TRUE(std::isnan(measured(1.9)));
}

TEST(Price, of_a_run_that_was_made_is_the_band_about_its_value) {
  const auto list = price();
  const auto& smooth = list.quantities.front();
  const RungSpec run{1.41, Role::rung};
  EXPECT_EQ(list.reached(run)->first, *smooth.band_of_finest() / smooth.value);
  EXPECT_EQ(list.reached({3, Role::rung})->first, list.accuracy(3)->first);
  EXPECT_TRUE(list.without_band(run).empty());
}

TEST(Price, belongs_to_its_scene_whatever_its_refinement_and_title) {
  const ScratchFolder folder;
  const auto file = folder.write("scene.toml", testing::wedge_drop);
  const auto digest = [&](std::vector<std::string> set) { return digest_of_scene(file, std::move(set)); };
  EXPECT_EQ(digest({}), digest({"fluid.size.refine=2", "title=other", "output.frames=0.1"}));
  EXPECT_NE(digest({}), digest({"body.wedge.mass=240"}));
  EXPECT_NE(digest({}), digest({"fluid.size.surface=0.02"}));
}

/// Of a goal whose meshes tell these errors.
Price told_price(const std::vector<std::pair<double, double>>& told) {
  std::vector<Rung> rungs;
  for (const auto& [refine, error] : told) {
    rungs.push_back(rung(refine, 2 * refine * refine, {10 + error}));
    rungs.back().told = {error};
  }
  auto goal = named("goals.tip.uy");
  goal.told = "goals.tip.uy.error";
  std::vector<std::string> notes;
  auto price = price_of(rungs, {goal}, 2, notes);
  list_rows(price);
  price.scene = "scene.toml", price.scene_digest = "0";
  return price;
}

TEST(Price, of_a_goal_goes_by_the_errors_that_meshes_tell) {
  const auto list = told_price({{1, 0.7}, {2, -0.07}});  // falls by 10 where elements are halved
  const auto& goal = list.quantities.front();
  EXPECT_FALSE(goal.fit);
  EXPECT_NEAR(*goal.band(1), 1, 1e-12);
  EXPECT_NEAR(*goal.band(2), 0.1, 1e-12);
  EXPECT_NEAR(*goal.band(std::sqrt(2.)), std::sqrt(0.1), 1e-12);
  EXPECT_NEAR(*goal.band(4), 0.01, 1e-12);
  EXPECT_EQ(list.rows.front().decided_by, "goals.tip.uy");
  const auto* row = row_for(list.rows, 1.1);
  ASSERT_NE(row, nullptr);
  EXPECT_LE(*row->refine, 2.01);
  EXPECT_TRUE(list.without_band({2, Role::rung}).empty());
}

TEST(Price, of_a_goal_believes_no_mesh_that_is_better_than_a_finer_one) {
  const auto list = told_price({{1, 0.7}, {2, 1e-6}, {4, 0.035}});
  EXPECT_NEAR(*list.quantities.front().band(2), 0.05, 1e-12);
  EXPECT_NEAR(*list.quantities.front().band(4), 0.05, 1e-12);
}

TEST(Price, of_a_goal_is_known_from_one_mesh_on) {
  const auto list = told_price({{1, 0.07}});
  ASSERT_FALSE(list.rows.empty());
  EXPECT_NEAR(*list.quantities.front().band(1), 0.1, 1e-12);
  EXPECT_NEAR(*list.quantities.front().band(2), 0.05, 1e-12);  // first order: no less is sure
}

TEST(Price, of_a_goal_is_written_and_read_back) {
  const auto list = told_price({{1, 0.7}, {2, -0.07}});
  const ScratchFolder folder;
  const auto again = read_price(folder.write("price.json", price_json(list)));
  EXPECT_EQ(price_json(again), price_json(list));
  EXPECT_NEAR(*again.quantities.front().band(2), 0.1, 1e-12);
}

}  // namespace
}  // namespace splashdown::apps::price_test
