// Ablations change one thing at a time, take changes between runs on the same mesh, and judge them by their bands.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "apps/ablate/changes.hpp"
#include "apps/scene/kinds/effect_kind.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/study/table.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/unit/apps/scenes.hpp"

namespace splashdown::apps::ablation_test {
namespace {

class AblationTest : public ::testing::Test, protected ScratchFolder {
 protected:
  AblationPlan plan(AblationOrder order = {}) const {
    order.scene = write("scene.toml", testing::wedge_drop);
    return plan_ablation(order);
  }

  /// What the runs of a plan would leave behind, by variant and mesh: y, seconds.
  template <class Y>
  Ablation ablated(const AblationPlan& plan, const Y& y, double least = 0.01) const {
    for (std::size_t v = 0; v < plan.variants.size(); ++v)
      for (std::size_t r = 0; r < plan.replicates(); ++r) {
        const auto& run = plan.runs[plan.run_of(v, r)];
        write(std::filesystem::path(run.name) / "scene.resolved.toml", run.resolved + "\n[provenance]\n");
        write(std::filesystem::path(run.name) / "summary.json",
              R"({"status": "done", "simulated_time": )" + std::to_string(run.stop) +
                  R"(, "wall_seconds": 100, "processor_seconds": )" + std::to_string(1. + double(v)) +
                  R"(, "steps": )" + std::to_string(y(v, r)) + "}");
      }
    const auto outcomes = outcomes_in(plan.study, plan.runs, path());
    return ablation_of(plan, outcomes, path(), least);
  }
  static AblationOrder of_steps(const char* only) { return {.quantities = {"y=summary.steps"}, .only = {only}}; }
  static const Change& y_of(const Ablation& ablation, std::size_t v) { return ablation.variants[v].changes.front(); }
};

TEST_F(AblationTest, takes_each_effect_away_and_toggles_each_choice) {
  std::vector<std::string> names;
  for (const auto& variant : plan().variants) names.push_back(variant.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"scene", "without_gravity", "no_slip", "all_free", "larger_tank", "half"}));
}

TEST_F(AblationTest, what_is_taken_away_is_absent_and_what_is_added_is_present) {
  const auto of = plan({.all = true});
  int added = 0;
  for (const auto& variant : of.variants) {
    if (variant.kind != VariantKind::without && variant.kind != VariantKind::with) continue;
    const auto scene = read_scene(of.study.scene, variant.set).scene;
    for (const auto* kind : effect_kinds())
      if (kind->name() == variant.what) {
        EXPECT_EQ(kind->present(scene), variant.kind == VariantKind::with) << variant.name;
      }
    added += variant.kind == VariantKind::with;
  }
  EXPECT_GE(added, 2) << "viscosity and an absorber can be added";
}

TEST_F(AblationTest, runs_are_three_meshes_of_nearly_the_same_size) {
  const auto of = plan();
  ASSERT_EQ(of.replicates(), 3u);
  for (const auto& mesh : of.study.axes.back().values) EXPECT_NEAR(*mesh.number, 1, 0.021);
  EXPECT_EQ(of.runs[of.run_of(1, 2)].value, (std::vector<std::size_t>{1, 2}));
}

TEST_F(AblationTest, scatter_that_both_runs_share_is_no_scatter_of_the_change) {
  const auto of = plan(of_steps("gravity"));
  const auto ablation =
      ablated(of, [](std::size_t v, std::size_t r) { return (v == 0 ? 100. : 90.) + 5. * double(r); });
  // Means of 105 and 95: what gravity adds is 10 of 105.
  EXPECT_NEAR(y_of(ablation, 1).relative, 10. / 105, 1e-6);
  EXPECT_NEAR(*y_of(ablation, 1).band, 0, 1e-6);
  EXPECT_EQ(ablation.variants[1].verdict, "keep");
  EXPECT_NEAR(*ablation.variants[1].time_change, 1. / 2 - 1, 1e-12) << "with it a run takes half as long";
}

TEST_F(AblationTest, the_band_is_students_of_the_changes) {
  const auto of = plan(of_steps("gravity"));
  const double with[] = {100, 101, 102}, without[] = {90, 92, 91};  // changes 10, 9, 11
  const auto ablation = ablated(of, [&](std::size_t v, std::size_t r) { return v == 0 ? with[r] : without[r]; });
  EXPECT_NEAR(y_of(ablation, 1).relative, 10. / 101, 1e-6);
  EXPECT_NEAR(*y_of(ablation, 1).band, 4.303 / std::sqrt(3.) / 101, 1e-5);  // t of 2 degrees of freedom; s = 1
}

TEST_F(AblationTest, a_verdict_needs_the_whole_band_on_one_side) {
  const auto of = plan(of_steps("gravity"));
  const double with[] = {100, 101, 102}, without[] = {90, 92, 91};  // 9.9 % +- 2.5 %
  const auto verdict = [&](double least) {
    return ablated(
               of, [&](std::size_t v, std::size_t r) { return v == 0 ? with[r] : without[r]; }, least)
        .variants[1]
        .verdict;
  };
  EXPECT_EQ(verdict(0.05), "keep");
  EXPECT_EQ(verdict(0.10), "undecided");
  EXPECT_EQ(verdict(0.15), "leave out");
}

TEST_F(AblationTest, what_is_added_has_the_sign_of_what_it_does) {
  const auto of = plan(of_steps("viscosity"));
  ASSERT_EQ(of.variants[1].kind, VariantKind::with);
  const auto ablation = ablated(of, [](std::size_t v, std::size_t) { return v == 0 ? 100. : 90.; });
  EXPECT_NEAR(y_of(ablation, 1).relative, -0.1, 1e-6);
  EXPECT_EQ(ablation.variants[1].verdict, "add");
  ASSERT_TRUE(ablation.variants[1].agrees);
  EXPECT_FALSE(*ablation.variants[1].agrees) << "theory says off";
  EXPECT_NE(verdict_line(of, ablation, 1).find("disagrees"), std::string::npos);
}

TEST_F(AblationTest, a_variant_without_a_run_has_its_cause) {
  const auto of = plan(of_steps("gravity"));
  const auto outcomes = outcomes_in(of.study, of.runs, path());
  const auto ablation = ablation_of(of, outcomes, path(), 0.01);
  EXPECT_EQ(ablation.variants[1].cause, "waiting");
  EXPECT_TRUE(ablation.variants[1].verdict.empty());
}

TEST_F(AblationTest, an_unknown_effect_is_refused_with_its_cure) {
  const auto messages = testing::refusal_of([&] { plan({.only = {"gravty"}}); });
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].find("Did you mean 'gravity'?"), std::string::npos) << messages[0];
}

TEST_F(AblationTest, a_scene_without_a_tank_has_none_to_grow) {
  const auto none = plan({.set = {"tank="}});
  for (const auto& variant : none.variants) EXPECT_NE(variant.name, "larger_tank");
}

}  // namespace
}  // namespace splashdown::apps::ablation_test
