#include "apps/statistics/verdict/verdict.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace splashdown::apps::verdict_test {
namespace {

/// A run with a body that touched the water and one that stayed dry.
Summary run_with(double energy_gain, double volume_error_bodies = 0) {
  Summary summary;
  summary.status = "done";
  auto& ledger = summary.ledger.emplace();
  ledger.volume_initial = 60;
  ledger.volume_final = 60 + 0.25 * volume_error_bodies;
  ledger.volume_error = 0.25 * volume_error_bodies / 60;
  ledger.volume_error_bodies = volume_error_bodies;
  ledger.energy_gain = energy_gain;
  ledger.energy_gain_joule = 80 * energy_gain;
  ledger.energy_gain_time = 0.125;
  ledger.energy_gain_since = 0.0625;
  ledger.energy_scale = 80;
  ledger.energy_scale_from = "kinetic energy of arriving bodies";
  summary.bodies["hull"].landing.first_contact = 0.1;
  summary.bodies["bird"] = {};
  judge(summary);
  return summary;
}

TEST(Verdict, follows_the_gain_of_energy) {
  EXPECT_EQ(run_with(0).verdict.grade, Grade::resolved);
  EXPECT_TRUE(run_with(0).verdict.reasons.empty());
  EXPECT_EQ(run_with(doubtful_above).verdict.grade, Grade::resolved);
  EXPECT_EQ(run_with(0.021).verdict.grade, Grade::doubtful);
  EXPECT_EQ(run_with(unphysical_above).verdict.grade, Grade::doubtful);
  EXPECT_EQ(run_with(0.051).verdict.grade, Grade::unphysical);
}

TEST(Verdict, of_numbers_that_are_none_is_the_worst) {
  EXPECT_EQ(run_with(std::numeric_limits<double>::infinity()).verdict.grade, Grade::unphysical);
  EXPECT_EQ(run_with(std::numeric_limits<double>::quiet_NaN()).verdict.grade, Grade::unphysical);
}

TEST(Verdict, reasons_have_numbers_units_and_what_to_do) {
  const auto reasons = run_with(1.5).verdict.reasons;
  ASSERT_EQ(reasons.size(), 1u);
  for (const auto* piece : {"120 J/m", "150 %", "80.0 J/m", "until t = 0.125 s", "after t = 0.0625 s",
                            "kinetic energy of arriving bodies", "above 5 %", "fluid.size.surface", "time.cfl"})
    EXPECT_NE(reasons[0].find(piece), std::string::npos) << piece << " is not in: " << reasons[0];
}

TEST(Verdict, counts_the_change_of_volume_by_the_hulls_whatever_the_tank_holds) {
  for (const double sign : {-1., 1.}) {
    EXPECT_EQ(run_with(0, sign * 0.019).verdict.grade, Grade::resolved);
    EXPECT_EQ(run_with(0, sign * 0.03).verdict.grade, Grade::doubtful);
    EXPECT_EQ(run_with(0, sign * 0.06).verdict.grade, Grade::unphysical);
  }
  const auto reason = run_with(0, -0.06).verdict.reasons.at(0);
  for (const auto* piece : {"-0.015 m^2", "-6 %", "hulls"})
    EXPECT_NE(reason.find(piece), std::string::npos) << piece << " is not in: " << reason;
}

TEST(Verdict, counts_the_change_of_volume_by_all_water_where_that_is_less_than_the_hulls) {
  auto summary = run_with(0);
  summary.bodies.clear();
  summary.ledger->volume_error_bodies.reset();
  summary.ledger->volume_error = 0.06;
  judge(summary);
  EXPECT_EQ(summary.verdict.grade, Grade::unphysical);
  summary.ledger->volume_error_bodies = 0.01;  // a jet on a plate that is larger than all water
  judge(summary);
  EXPECT_EQ(summary.verdict.grade, Grade::unphysical);
}

TEST(Verdict, kinetic_energy_below_zero_is_unphysical) {
  auto summary = run_with(0);
  summary.ledger->kinetic_deficit = 0.1;
  judge(summary);
  EXPECT_EQ(summary.verdict.grade, Grade::unphysical);
}

TEST(Verdict, much_water_that_was_lost_meanwhile_is_doubtful) {
  auto summary = run_with(0);
  for (const auto& [share, grade] :
       {std::pair{0.04, Grade::resolved}, {0.06, Grade::doubtful}, {-0.06, Grade::doubtful}}) {
    summary.ledger->returned_share = share;
    judge(summary);
    EXPECT_EQ(summary.verdict.grade, grade) << share;
  }
}

TEST(Verdict, of_a_body_has_the_reasons_that_concern_it) {
  auto summary = run_with(0.5);
  EXPECT_EQ(summary.bodies["hull"].verdict.grade, Grade::unphysical);
  EXPECT_EQ(summary.bodies["hull"].verdict.reasons, summary.verdict.reasons);
  EXPECT_EQ(summary.bodies["bird"].verdict.grade, Grade::resolved) << "it never met the water";
}

TEST(Verdict, of_a_failed_run_is_unphysical_with_the_cause) {
  auto summary = run_with(0);
  summary.status = "failed";
  summary.cause = "the pressure solve failed";
  judge(summary);
  EXPECT_EQ(summary.verdict.grade, Grade::unphysical);
  EXPECT_NE(summary.verdict.reasons.at(0).find("the pressure solve failed"), std::string::npos);
  EXPECT_EQ(summary.bodies["bird"].verdict.grade, Grade::unphysical) << "all end with the run";
}

TEST(Verdict, of_the_worst_reason_stands_and_all_are_told) {
  auto summary = run_with(0.03, 0.2);
  EXPECT_EQ(summary.verdict.grade, Grade::unphysical);
  EXPECT_EQ(summary.verdict.reasons.size(), 2u);
  judge(summary);
  EXPECT_EQ(summary.verdict.reasons.size(), 2u) << "judged twice is judged once";
}

TEST(Verdict, a_scene_without_water_is_resolved) {
  Summary summary;
  summary.status = "done";
  summary.bodies["ball"] = {};
  judge(summary);
  EXPECT_EQ(summary.verdict.grade, Grade::resolved);
}

}  // namespace
}  // namespace splashdown::apps::verdict_test
