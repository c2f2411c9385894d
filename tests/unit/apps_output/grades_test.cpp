// What steps say about peaks, and what bands and grades come of it.
#include "apps/statistics/verdict/grades.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "apps/statistics/evidence.hpp"
#include "apps/statistics/verdict/next_step.hpp"
#include "apps/statistics/verdict/verdict.hpp"

namespace splashdown::apps::grades_test {
namespace {

constexpr double end = 0.1, dt = 1e-3, touch = 0.02;
using OfTime = std::function<double(double)>;

/// A hull that touches water at `touch` and is wetted over w(t - touch) by facets of one size.
struct Entry {
  OfTime force = [](double t) { return 100 * t; };
  OfTime wetted = [](double t) { return t; };
  double facet = 1e-3, repair_share = 0, sideways = 0, speed = 1;
  std::vector<char> symmetric = {1};

  EvidenceStatistics steps;
  IntervalHistory channel;

  Entry& run() {
    channel.channels = 2;
    for (int n = 0; (n + 1) * dt <= end; ++n) {
      const double since = (n + 0.5) * dt - touch, w = since > 0 ? wetted(since) : 0;
      const std::vector<double> f = {since > 0 ? sideways * force(since) : 0, since > 0 ? force(since) : 0};
      steps.add(n * dt, (n + 1) * dt, {f, {0, repair_share * f[1]}, w / facet, w, speed, symmetric});
      channel.append((n + 1) * dt, f);
    }
    return *this;
  }
  Evidence at(double time) const {
    Pulse peak;
    peak.offer(1, time);
    return steps.about(peak, channel, {});
  }
};

TEST(Evidence, counts_the_elements_on_half_of_the_wetted_width) {
  EXPECT_NEAR(Entry().run().at(0.0805).elements, 30.25, 1e-9);  // 60.5 mm of 1 mm each
}

TEST(Evidence, in_space_counts_along_the_radius_of_the_wetted_disc) {
  EvidenceStatistics steps;
  const double h = 0.01, radius = 0.2, facets = std::numbers::pi * radius * radius / (std::numbers::sqrt3 / 4 * h * h);
  for (int n = 0; n < 10; ++n)
    steps.add(n * dt, (n + 1) * dt, {{0, 0, 1}, {0, 0, 0}, facets, std::numbers::pi * radius * radius, 1, {}});
  EXPECT_NEAR(steps.at_pressure(5.5 * dt).elements, radius / h, 1e-9);
  EXPECT_NEAR(steps.facet_size(5.5 * dt), h, 1e-12);
}

TEST(Evidence, of_a_wedge_grows_of_a_round_bottom_less_of_a_hull_afloat_not) {
  EXPECT_NEAR(Entry().run().at(0.0805).growing, 1, 0.02);
  Entry round;
  round.wetted = [](double t) { return std::sqrt(t); };
  EXPECT_NEAR(round.run().at(0.0805).growing, 2 - std::sqrt(2), 0.02);
  Entry afloat;
  afloat.wetted = [](double) { return 0.1; };
  EXPECT_NEAR(afloat.run().at(0.0805).growing, 0, 1e-12);
}

TEST(Evidence, a_single_step_stands_out_and_a_ramp_does_not) {
  EXPECT_NEAR(Entry().run().at(0.0805).step, 0, 1e-9);
  EXPECT_NEAR(Entry().run().at(end - dt / 2).step, 0, 1e-9) << "the last step of a load that grows";
  Entry spike;
  spike.force = [](double t) { return std::abs(t - 0.0605) < dt / 4 ? 1.42 * 6.05 : 100 * t; };
  EXPECT_NEAR(spike.run().at(0.0805).step, 0.42, 1e-9);
}

TEST(Evidence, knows_the_repair_part_and_what_symmetry_forbids) {
  Entry entry;
  entry.repair_share = 0.3, entry.sideways = 0.04;
  EXPECT_NEAR(entry.run().at(0.0805).repair, 0.3 / (1 + 0.04 * 0.04), 1e-12);
  EXPECT_NEAR(entry.at(0.0805).sideways, 0.04 / std::hypot(1, 0.04), 1e-12);
  Entry free_to_drift;
  free_to_drift.sideways = 0.04, free_to_drift.symmetric = {0};
  EXPECT_TRUE(std::isnan(free_to_drift.run().at(0.0805).sideways));
}

Summary landing(const Evidence& evidence, int dimension = 2) {
  Summary summary;
  summary.status = "done";
  summary.wall_seconds = 100;
  summary.dimension = dimension;
  auto& body = summary.bodies["hull"];
  body.landing.first_contact = 0;
  body.acceleration.raw.offer(5, 0.1);
  body.force.raw.offer(1000, 0.1);
  body.acceleration_grades.raw.emplace().evidence = body.force_grades.raw.emplace().evidence = evidence;
  judge(summary);
  return summary;
}

Evidence slam(double elements, double step = 0) {
  Evidence evidence;
  evidence.elements = elements, evidence.growing = 1, evidence.repair = 0, evidence.step = step;
  return evidence;
}

TEST(Grades, follow_the_elements_on_the_wetted_width) {
  EXPECT_EQ(landing(slam(50)).verdict.grade, Grade::resolved);
  EXPECT_EQ(landing(slam(15)).verdict.grade, Grade::doubtful);
  EXPECT_EQ(landing(slam(8)).verdict.grade, Grade::unresolved);
  const auto of = [](double n, int d) { return landing(slam(n), d).bodies.at("hull").force_grades.raw->band; };
  EXPECT_NEAR(of(25, 2), 2 * of(50, 2), 1e-12) << "first order";
  EXPECT_NEAR(of(17, 3), 0.13, 1e-12);
}

TEST(Grades, a_peak_of_a_single_step_is_unresolved_however_fine_the_mesh) {
  const auto summary = landing(slam(200, 0.42));
  EXPECT_EQ(summary.bodies.at("hull").verdict.grade, Grade::unresolved);
  ASSERT_FALSE(summary.verdict.reasons.empty());
  EXPECT_NE(summary.verdict.reasons[0].find("stands 42 % off the steps around it"), std::string::npos)
      << summary.verdict.reasons[0];
}

TEST(Grades, filtered_peaks_of_class_60_stand_for_the_body_if_the_run_has_them) {
  auto summary = landing(slam(200, 0.42));
  auto& body = summary.bodies.at("hull");
  body.acceleration.cfc[60].offer(4.8, 0.1), body.force.cfc[60].offer(950, 0.1);
  body.acceleration_grades.cfc[60].evidence = body.force_grades.cfc[60].evidence = slam(200);
  judge(summary);
  EXPECT_EQ(summary.verdict.grade, Grade::resolved);
  EXPECT_EQ(body.force_grades.raw->grade, Grade::unresolved) << "the raw peak keeps its own grade";
}

TEST(Grades, a_load_that_carries_weight_does_not_depend_on_the_mesh) {
  auto summary = landing(slam(8));
  summary.bodies.at("hull").inertial = 0;
  judge(summary);
  EXPECT_EQ(summary.bodies.at("hull").force_grades.raw->grade, Grade::resolved);
}

TEST(Verdict, says_what_it_is_about) {
  const auto& about = landing(slam(50)).verdict.about;
  ASSERT_EQ(about.size(), 2u);
  EXPECT_EQ(about[0], "hull: peak acceleration, raw 5 g within 2.5 %");
}

TEST(Grades, are_no_better_than_the_water_that_they_come_from) {
  auto summary = landing(slam(200));
  auto& ledger = summary.ledger.emplace();
  ledger.energy_gain = 0.03, ledger.energy_gain_time = 0.1;
  judge(summary);
  EXPECT_EQ(summary.bodies.at("hull").force_grades.raw->grade, Grade::doubtful);
  ledger.energy_gain = 0.3;
  judge(summary);
  EXPECT_EQ(summary.bodies.at("hull").force_grades.raw->grade, Grade::unphysical);
}

TEST(NextStep, is_the_coarsest_mesh_that_makes_the_grade_better_and_says_what_it_costs) {
  EXPECT_FALSE(landing(slam(50)).next);
  for (const auto& [elements, refine] : {std::pair{20., 1.4}, {15., 2.}, {11., 1.4}, {8., 2.}, {4., 4.}}) {
    const auto summary = landing(slam(elements));
    ASSERT_TRUE(summary.next) << elements;
    EXPECT_EQ(summary.next->refine, refine) << elements;
    EXPECT_TRUE(summary.next->promises) << elements;
    EXPECT_LT(landing(slam(refine * elements)).verdict.grade, summary.verdict.grade) << "as promised";
    EXPECT_NEAR(summary.next->seconds, 100 * std::pow(refine, cost_exponent(2)), 1e-9);
  }
}

TEST(NextStep, that_may_not_help_says_so) {
  auto lost = slam(60);
  lost.sideways = 0.3;
  const auto alone = landing(slam(200, 0.42)), sideways = landing(lost), few = landing(slam(1));
  for (const auto* summary : {&alone, &sideways, &few}) {
    ASSERT_TRUE(summary->next);
    EXPECT_FALSE(summary->next->promises);
    EXPECT_NE(text_of(*summary->next).find("may not"), std::string::npos) << text_of(*summary->next);
  }
}

TEST(NextStep, of_long_steps_is_shorter_ones) {
  auto coarse = slam(100);
  coarse.sampling = 0.3;
  auto summary = landing(coarse);
  ASSERT_TRUE(summary.next);
  EXPECT_EQ(summary.next->refine, 0);
  EXPECT_NEAR(summary.next->dt_max, 1 / 600., 1e-9) << "as J211 asks for";
  EXPECT_TRUE(summary.next->promises);
  coarse.elements = 8;
  summary = landing(coarse);
  EXPECT_GT(summary.next->refine, 1) << "and finer elements where they are coarse, too";
  EXPECT_GT(summary.next->dt_max, 0);
}

TEST(Grades, no_mesh_gives_the_peak_of_an_impulse_a_value) {
  auto impact = slam(200, 5000);
  impact.repair = 1;
  const auto summary = landing(impact);
  EXPECT_FALSE(summary.next) << "a finer one has a higher peak";
  EXPECT_FALSE(std::isfinite(summary.bodies.at("hull").force_grades.raw->band)) << "ten times the value is no band";
  EXPECT_EQ(summary.verdict.grade, Grade::unresolved);
  ASSERT_FALSE(summary.verdict.reasons.empty());
  const auto& reason = summary.verdict.reasons[0];
  EXPECT_NE(reason.find("without a band: it stands over 1000 % off"), std::string::npos) << reason;
  EXPECT_NE(reason.find("the impulse has a value"), std::string::npos) << reason;
}

}  // namespace
}  // namespace splashdown::apps::grades_test
