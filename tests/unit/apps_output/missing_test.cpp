// What a scene asks for and did not happen: said first, and not resolved where nothing is left to judge.
#include "apps/statistics/verdict/missing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/statistics/rise.hpp"
#include "apps/statistics/verdict/next_step.hpp"
#include "apps/statistics/verdict/verdict.hpp"

namespace splashdown::apps::missing_test {
namespace {

/// A scene of water and bodies of which nothing is known but their names.
Summary run_of(const std::vector<std::string>& bodies) {
  Summary summary;
  summary.status = "done";
  summary.simulated_time = 0.5;
  summary.wall_seconds = 10;
  auto& ledger = summary.ledger.emplace();
  ledger.volume_initial = ledger.volume_final = 60;
  ledger.energy_scale = 80;
  auto& asked = summary.expected.emplace();
  asked.end = 0.5, asked.gravity = 9.81;
  for (const auto& name : bodies) summary.bodies[name], asked.bodies[name];
  return summary;
}

struct Case {
  const char* what;
  std::vector<std::string> bodies;
  void (*change)(Summary&);
  Grade grade;
  const char* first;  ///< in the first reason; empty: there is none
};

void wet(Summary& summary, const char* name) { summary.bodies[name].landing.first_contact = 0.1; }

const Case cases[] = {
    {"a body that met the water", {"hull"}, [](Summary& s) { wet(s, "hull"); }, Grade::resolved, ""},
    {"one that stayed dry", {"hull"}, [](Summary&) {}, Grade::unresolved, "hull stayed dry until the run ended"},
    {"one of two", {"a", "b"}, [](Summary& s) { wet(s, "a"); }, Grade::unresolved, "b stayed dry"},
    {"one that is held",
     {"deck"},
     [](Summary& s) { s.expected->bodies["deck"].moves = false; },
     Grade::resolved,
     "deck stayed dry"},
    {"one that a joint ties to a wet one",
     {"hull", "mast"},
     [](Summary& s) { wet(s, "hull"), s.expected->bodies["mast"].tied = {"hull"}; },
     Grade::resolved,
     "mast stayed dry"},
    {"one that a wet one may carry",
     {"hull", "load"},
     [](Summary& s) { wet(s, "hull"), s.expected->contact = true; },
     Grade::resolved,
     "load stayed dry"},
    {"one that nothing wet may carry",
     {"hull", "load"},
     [](Summary& s) { s.expected->contact = true; },
     Grade::unresolved,
     "hull stayed dry"},
    {"a scene without water", {"ball"}, [](Summary& s) { s.ledger.reset(); }, Grade::resolved, ""},
    {"a load that still rises",
     {"hull"},
     [](Summary& s) { wet(s, "hull"), s.bodies["hull"].rising = true; },
     Grade::unresolved,
     "its peak comes later"},
    {"the same of prescribed motion",
     {"hull"},
     [](Summary& s) { wet(s, "hull"), s.bodies["hull"].rising = true, s.expected->bodies["hull"].free = false; },
     Grade::resolved,
     "no peak"},
    {"records that met no water beside a wet body",
     {"hull"},
     [](Summary& s) { wet(s, "hull"), s.dry_records = {"patch belly"}, s.wettable_records = 1; },
     Grade::resolved,
     "No water met patch belly"},
    {"records that are all that is asked for",
     {},
     [](Summary& s) {
       s.dry_records = {"gauge a", "probe b"}, s.wettable_records = 2;
     },
     Grade::unresolved,
     "No water met gauge a, probe b"},
    {"one of two such records",
     {},
     [](Summary& s) { s.dry_records = {"gauge a"}, s.wettable_records = 2; },
     Grade::resolved,
     "No water met gauge a"},
    {"a run that was stopped",
     {"hull"},
     [](Summary& s) { wet(s, "hull"), s.status = "interrupted", s.simulated_time = 0.3; },
     Grade::resolved,
     "stopped at t = 0.3 s of 0.5 s"},
    {"a dive without form drag",
     {"buoy"},
     [](Summary& s) {
       wet(s, "buoy"), s.inactive_effects = {{"form_drag", ""}};
       s.expected->bodies["buoy"].length = 0.2, s.bodies["buoy"].submergence = {0.5, 0.3};
     },
     Grade::resolved,
     "buoy went 2.5 of its lengths under water"},
    {"a dive with it",
     {"buoy"},
     [](Summary& s) {
       wet(s, "buoy"), s.expected->bodies["buoy"].length = 0.2, s.bodies["buoy"].submergence = {0.5, 0.3};
     },
     Grade::resolved,
     ""},
    {"rolling for long without form drag",
     {"buoy"},
     [](Summary& s) {
       wet(s, "buoy"), s.inactive_effects = {{"form_drag", ""}}, s.simulated_time = s.expected->end = 5;
       s.expected->bodies["buoy"].length = 0.2, s.bodies["buoy"].landing.maximum_tilt = {20, 0.3};
     },
     Grade::resolved,
     "buoy swung afloat for 4.9 s"},
    {"a path that goes on",
     {"hull"},
     [](Summary& s) { wet(s, "hull"), s.expected->path_ends_at = 0.7; },
     Grade::resolved,
     "path goes on until t = 0.7 s"},
};

TEST(Missing, what_did_not_happen_is_said_first_and_graded) {
  for (const auto& [what, bodies, change, grade, first] : cases) {
    auto summary = run_of(bodies);
    change(summary);
    judge(summary);
    EXPECT_EQ(summary.verdict.grade, grade) << what;
    if (*first == 0) {
      EXPECT_TRUE(summary.verdict.reasons.empty()) << what;
      continue;
    }
    ASSERT_FALSE(summary.verdict.reasons.empty()) << what;
    EXPECT_NE(summary.verdict.reasons[0].find(first), std::string::npos) << what << ": " << summary.verdict.reasons[0];
  }
}

TEST(Missing, stands_before_what_happened) {
  auto summary = run_of({"hull", "bird"});
  wet(summary, "hull");
  summary.ledger->energy_gain = 0.3;
  judge(summary);
  EXPECT_EQ(summary.verdict.grade, Grade::unphysical);
  EXPECT_NE(summary.verdict.reasons.at(0).find("bird stayed dry"), std::string::npos);
  EXPECT_EQ(summary.bodies["bird"].verdict.grade, Grade::unresolved);
}

TEST(Missing, asks_for_a_run_that_reaches_the_contact_of_free_fall) {
  auto summary = run_of({"hull"});
  auto& landing = summary.bodies["hull"].landing;
  landing.height = 0.2, landing.sinking = 1;
  const double wait = (std::sqrt(1 + 2 * 9.81 * 0.2) - 1) / 9.81;
  judge(summary);
  ASSERT_TRUE(summary.next);
  EXPECT_EQ(summary.next->refine, 0);
  EXPECT_NEAR(summary.next->end, 1.5 * (0.5 + wait), 1e-12);
  EXPECT_NE(summary.next->effect.find("may"), std::string::npos) << "nobody knows what comes then";
  summary.expected->gravity = 0, landing.sinking = -1;
  judge(summary);
  EXPECT_FALSE(summary.next) << "it flies away";
  EXPECT_NE(summary.verdict.reasons.at(0).find("does not come nearer"), std::string::npos);
}

/// A load over time in steps of 1 ms, with or without noise.
template <class OfTime>
bool rises(const OfTime& load, double end = 0.1, double noise = 0) {
  IntervalHistory history{1, 0, {}, {}};
  for (int n = 1; n * 1e-3 <= end + 1e-9; ++n) {
    const double value = load((n - 0.5) * 1e-3) * (1 + noise * std::sin(37. * n * n));
    history.append(n * 1e-3, {&value, 1});
  }
  return rises_at_end(history, 0.01, end);
}

TEST(Rise, is_that_of_loads_whose_peak_is_to_come) {
  for (const double power : {0.5, 1., 2., 3.}) {
    const auto grows = [=](double t) { return std::pow(std::max(0., t - 0.01), power); };
    EXPECT_TRUE(rises(grows)) << power;
    EXPECT_TRUE(rises(grows, 0.1, 0.02)) << power << " with noise";
    EXPECT_TRUE(rises(grows, 0.014)) << power << ": a few steps";
  }
  EXPECT_TRUE(rises([](double t) { return std::sin(t * 10); })) << "of a half period of 314 ms";
}

TEST(Rise, is_none_of_loads_that_have_had_it_or_have_none) {
  EXPECT_FALSE(rises([](double) { return 1960.; }));
  EXPECT_FALSE(rises([](double t) { return 1960 + 1e-10 * t; })) << "rounding is no rise";
  EXPECT_FALSE(rises([](double) { return 1960.; }, 0.1, 0.003)) << "nor is noise";
  EXPECT_FALSE(rises([](double t) { return std::sin(t * 31.4); })) << "a whole half period";
  EXPECT_FALSE(rises([](double t) { return std::sin(t * 16.5); })) << "just beyond its peak";
  EXPECT_FALSE(rises([](double t) { return (t < 0.02 ? 20 : 1) + 10 * t; })) << "lower than an impact before";
  EXPECT_FALSE(rises([](double t) { return std::abs(std::sin(t * 157)); })) << "to and fro";
  EXPECT_FALSE(rises([](double) { return 0.; }));
}

TEST(Missing, meshes_that_could_not_be_had_are_told) {
  auto summary = run_of({"hull"});
  wet(summary, "hull");
  summary.fluid.emplace().remeshings_missed = 0;
  EXPECT_TRUE(missing(summary).empty());
  summary.fluid->remeshings_missed = 2;
  ASSERT_EQ(missing(summary).size(), 1u);
  EXPECT_EQ(missing(summary)[0].grade, Grade::resolved);
  EXPECT_NE(missing(summary)[0].reason.find("wanted 2 times"), std::string::npos);
}

}  // namespace
}  // namespace splashdown::apps::missing_test
