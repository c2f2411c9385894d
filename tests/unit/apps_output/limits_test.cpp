// What runs say to limits: random runs, values, bands and limits against what yes and no mean.
#include "apps/statistics/verdict/limits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

namespace splashdown::apps::limits_test {
namespace {

constexpr double end = 0.5;
const std::vector<NamedNumber> numbers = {
    {.name = "hull.peak_force",
     .unit = "N",
     .paths = {"bodies.hull.peak_force_filtered.cfc60.value", "bodies.hull.peak_force.value"},
     .body = "hull"},
    {.name = "hull.impulse", .unit = "N s", .paths = {"bodies.hull.impulse.1"}, .body = "hull", .peak = false},
    {.name = "belly.peak_pressure", .unit = "Pa", .paths = {"patches.belly.peak_pressure.value"}, .body = "hull"},
    {.name = "seat.peak_g",
     .unit = "g",
     .paths = {"equipment.seat.cfc60.value", "equipment.seat.raw.value"},
     .body = "hull"},
    {.name = "sea-bed.peak_pressure", .unit = "Pa", .paths = {"probes.sea-bed.peak_pressure.value"}, .body = ""},
};

NumberGrade graded(double band, Grade grade = Grade::resolved) {
  NumberGrade number;
  number.grade = grade;
  number.band = band;
  return number;
}

/// A hull that hit the water at 0.1 s; all its numbers were largest at 0.2 s.
struct Landing {
  double force = 100, pressure = 2000, g = 8, bed = 500, band = 0.1;
  Summary summary() const {
    Summary s;
    s.status = "done";
    s.simulated_time = end;
    auto& hull = s.bodies["hull"];
    hull.landing.first_contact = 0.1;
    hull.force.raw.value = force, hull.force.raw.time = 0.2;
    hull.force_grades.raw = graded(band);
    hull.impulse = {0, 7};
    s.patches["belly"] = {.pressure = {pressure, 0.2}, .body = "hull", .evidence = {}, .grade = graded(band)};
    s.equipment["seat"].raw.value = g, s.equipment["seat"].raw.time = 0.2;
    s.equipment["seat"].grades.raw = graded(band);
    s.probes["sea-bed"] = {.pressure = {bed, 0.2}, .body = "", .evidence = {}, .grade = {}};
    return s;
  }
};

LimitAnswer ask(const Summary& summary, const std::string& quantity, bool above, double value) {
  const Limit limit{.name = "limit", .quantity = quantity, .unit = "N", .above = above, .value = value};
  return answered({&limit, 1}, numbers, summary, end).at(0);
}

TEST(Limits, are_exceeded_or_kept_where_the_band_says_so_and_within_it_else) {
  std::mt19937 random(1);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  for (int n = 0; n < 300; ++n) {
    const Landing landing{.force = between(-3, 3) * 100, .band = between(0, 0.5)};
    const double limit = between(-3, 3) * 100, low = landing.force - landing.band * std::abs(landing.force),
                 high = landing.force + landing.band * std::abs(landing.force);
    const bool above = n % 2 == 0;
    const auto answer = ask(landing.summary(), "hull.peak_force", above, limit);
    const bool yes = above ? low > limit : high < limit, no = above ? high < limit : low > limit;
    EXPECT_EQ(answer.answer, yes ? "yes" : no ? "no" : "within the band") << landing.force << " " << limit;
    EXPECT_EQ(answer.value, landing.force);
    EXPECT_NEAR(answer.band, (high - low) / 2, 1e-9);
    EXPECT_EQ(answer.reason, "");
  }
}

TEST(Limits, of_a_run_that_ended_early_settle_what_was_exceeded_and_nothing_else) {
  const Landing landing;
  for (const char* status : {"done", "interrupted"}) {
    auto summary = landing.summary();
    summary.status = status;
    summary.simulated_time = 0.4;
    EXPECT_EQ(ask(summary, "hull.peak_force", true, 50).answer, "yes");
    EXPECT_EQ(ask(summary, "hull.peak_force", false, 50).answer, "no");
    for (const bool above : {true, false}) {
      const auto open = ask(summary, "hull.peak_force", above, 200);
      EXPECT_EQ(open.answer, "within the band");
      EXPECT_EQ(open.reason, "the run ended at 0.4 s of 0.5 s");
    }
  }
}

TEST(Limits, of_a_peak_at_the_end_of_the_run_are_open) {
  auto summary = Landing().summary();
  summary.bodies["hull"].force.raw.time = end;
  EXPECT_EQ(ask(summary, "hull.peak_force", true, 200).reason, "it was still rising when the run ended");
  EXPECT_EQ(ask(summary, "hull.peak_force", true, 50).answer, "yes");
}

TEST(Limits, of_what_stayed_dry_are_open) {
  auto summary = Landing{.pressure = 0, .g = 0.1, .bed = 0}.summary();
  summary.bodies["hull"].landing.first_contact = -1;
  for (const char* quantity : {"hull.peak_force", "belly.peak_pressure", "seat.peak_g"}) {
    const auto answer = ask(summary, quantity, true, 1e6);
    EXPECT_EQ(answer.answer, "within the band") << quantity;
    EXPECT_EQ(answer.reason, "hull stayed dry") << quantity;
  }
  EXPECT_EQ(ask(summary, "sea-bed.peak_pressure", true, 1e6).reason, "sea-bed stayed dry");
}

TEST(Limits, without_a_band_are_open) {
  EXPECT_EQ(ask(Landing().summary(), "sea-bed.peak_pressure", true, 1e6).reason, "it has no band");
  EXPECT_EQ(ask(Landing().summary(), "hull.impulse", true, 1e6).reason, "it has no band");
  const auto infinite = ask(Landing{.band = HUGE_VAL}.summary(), "hull.peak_force", true, 1e6);
  EXPECT_EQ(infinite.answer, "within the band");
  EXPECT_EQ(infinite.reason, "it has no band");
}

TEST(Limits, of_unphysical_water_are_open) {
  auto summary = Landing().summary();
  summary.bodies["hull"].force_grades.raw = graded(0.01, Grade::unphysical);
  EXPECT_EQ(ask(summary, "hull.peak_force", true, 50).answer, "within the band");
  EXPECT_EQ(ask(summary, "hull.peak_force", true, 50).reason, "the run is unphysical, see the verdict");
}

TEST(Limits, of_numbers_that_a_run_lacks_are_open) {
  Summary empty;
  empty.status = "failed";
  empty.bodies["hull"].landing.first_contact = 0.1;
  for (const auto& number : numbers) {
    const auto answer = ask(empty, number.name, true, 0);
    EXPECT_EQ(answer.answer, "within the band") << number.name;
    EXPECT_NE(answer.reason, "") << number.name;
  }
}

TEST(Limits, take_the_filtered_peak_where_there_is_one) {
  auto summary = Landing().summary();
  summary.bodies["hull"].force.cfc[60].value = 80, summary.bodies["hull"].force.cfc[60].time = 0.2;
  summary.bodies["hull"].force_grades.cfc[60] = graded(0.05);
  const auto answer = ask(summary, "hull.peak_force", true, 90);
  EXPECT_EQ(answer.value, 80);
  EXPECT_NEAR(answer.band, 4, 1e-12);
  EXPECT_EQ(answer.answer, "no");
}

TEST(Limits, of_an_expression_have_the_bands_of_its_numbers_together) {
  const Landing landing{.force = 100, .pressure = 2000, .band = 0.1};
  const auto sum = ask(landing.summary(), "belly.peak_pressure + 3*hull.peak_force", true, 0);
  EXPECT_EQ(sum.value, 2300);
  EXPECT_NEAR(sum.band, 200 + 30, 1e-9);
  EXPECT_EQ(sum.answer, "yes");
  const auto ratio = ask(landing.summary(), "belly.peak_pressure/hull.peak_force", true, 24);
  EXPECT_NEAR(ratio.band, 20 * 0.1 + 20 * (1 / 0.9 - 1), 1e-9);
  EXPECT_EQ(ratio.answer, "within the band");
  EXPECT_EQ(ask(landing.summary(), "hull.peak_force - hull.impulse", true, 0).reason, "it has no band");
}

// The mean of several runs has a value and a band of its own; what else is asked of the run stays.
TEST(Limits, go_by_the_mean_of_runs_where_there_is_one) {
  const Limit limit{.name = "limit", .quantity = "belly.peak_pressure", .unit = "Pa", .above = true, .value = 2100};
  const auto ask_with = [&](const Summary& summary, const MeanNumbers& means) {
    return answered({&limit, 1}, numbers, nlohmann::json::parse(to_json(summary)), end, means).at(0);
  };
  Landing landing;
  const MeanNumbers below = {{"patches.belly.peak_pressure.value", {1950, 40, 8}}},
                    above = {{"patches.belly.peak_pressure.value", {2300, 60, 8}}};
  EXPECT_EQ(ask_with(landing.summary(), {}).answer, "within the band") << "2000 +- 200";
  EXPECT_EQ(ask_with(landing.summary(), {}).runs, 0);
  const auto kept = ask_with(landing.summary(), below);
  EXPECT_EQ(kept.answer, "no");
  EXPECT_EQ(kept.runs, 8);
  EXPECT_EQ(kept.band, 40);
  EXPECT_EQ(text_of(kept), "limit: above 2.1 kPa? no, 1.95 kPa +- 40 Pa, mean of 8 runs");
  EXPECT_EQ(ask_with(landing.summary(), above).answer, "yes");
  auto stopped = landing.summary();
  stopped.simulated_time = 0.4;
  EXPECT_EQ(ask_with(stopped, below).answer, "within the band") << "larger may come yet";
  EXPECT_EQ(ask_with(stopped, above).answer, "yes") << "a peak never falls";
}

TEST(Limits, are_one_line_with_value_band_and_unit) {
  auto answer = ask(Landing{.force = 13200, .band = 0.08}.summary(), "hull.peak_force", true, 20000);
  EXPECT_EQ(text_of(answer), "limit: above 20 kN? no, 13.2 kN +- 1.06 kN");
  answer.unit = "g";
  EXPECT_EQ(value_text(1234, "g"), "1.23e+03 g");  // not 1.23 kg
  EXPECT_EQ(value_text(0.5, "-"), "0.5");
}

}  // namespace
}  // namespace splashdown::apps::limits_test
