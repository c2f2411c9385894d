// The verdict in three lines: laws over drawn runs, and the words of bands.
#include "apps/statistics/verdict/statements.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>

#include "apps/statistics/verdict/next_step.hpp"
#include "apps/statistics/verdict/verdict.hpp"

namespace splashdown::apps::statements_test {
namespace {

/// A graded run of up to three bodies, fine or coarse, filtered or not, in water that is right or wrong.
class Drawn {
 public:
  explicit Drawn(unsigned seed) : random_(seed) {
    summary.dimension = chance(0.5) ? 2 : 3;
    summary.status = chance(0.1) ? "failed" : chance(0.1) ? "interrupted" : "done";
    summary.cause = "the pressure solve failed";
    summary.simulated_time = 0.2, summary.steps = 100, summary.wall_seconds = 60;
    if (chance(0.9)) add_water();
    auto& expected = summary.expected.emplace();
    const int bodies = 1 + static_cast<int>(between(0, 3));
    for (int b = 0; b < bodies; ++b) {
      const auto name = "hull" + std::to_string(b);
      expected.bodies[name] = {};
      add_body(name);
    }
    if (chance(0.5)) {
      auto& point = summary.equipment["payload"];
      point.body = "hull0";
      add_pulses(point, point.grades, 20);
    }
    if (chance(0.5)) {
      auto& patch = summary.patches["belly"];
      patch.body = "hull0";
      patch.pressure.offer(between(1e2, 1e5), 0.1);
      patch.evidence = evidence();
      patch.evidence.pressed = order(0.2, 50);
    }
    judge(summary);
  }
  Summary summary;

 private:
  double between(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }
  double order(double a, double b) { return std::exp(between(std::log(a), std::log(b))); }
  bool chance(double p) { return between(0, 1) < p; }

  Evidence evidence() {
    Evidence e;
    if (!chance(0.05)) e.elements = order(0.3, 300), e.growing = between(0, 1);
    e.repair = chance(0.1) ? between(0.5, 1) : between(0, 0.3);
    if (chance(0.7)) e.step = order(1e-3, 3);
    if (chance(0.3)) e.sideways = order(1e-3, 0.5);
    if (chance(0.5)) e.sampling = order(1e-3, 1);
    return e;
  }
  void add_water() {
    auto& ledger = summary.ledger.emplace();
    const auto error = [&] { return chance(0.8) ? 0 : order(0.01, 3); };
    ledger.energy_gain = error(), ledger.energy_gain_time = 0.1, ledger.energy_scale = 80;
    ledger.energy_gain_since = chance(0.5) ? 0 : 0.1;
    ledger.kinetic_deficit = error();
    ledger.volume_error_bodies = ledger.volume_error = error();
    ledger.returned_share = error();
  }
  void add_pulses(PulseSummary& pulses, PulseGrades& grades, double most) {
    pulses.raw.offer(between(0.1, most), 0.1);
    grades.raw.emplace().evidence = evidence();
    if (chance(0.3)) return;
    pulses.cfc[60].offer(between(0.1, most), 0.1);
    grades.cfc[60].evidence = evidence();
  }
  void add_body(const std::string& name) {
    auto& body = summary.bodies[name];
    if (chance(0.8)) body.landing.first_contact = 0.01;
    body.rising = chance(0.1);
    add_pulses(body.acceleration, body.acceleration_grades, 20);
    add_pulses(body.force, body.force_grades, 1e5);
  }

  std::mt19937 random_;
};

constexpr unsigned members = 400;

bool has(const std::string& text, const std::string& piece) { return text.find(piece) != std::string::npos; }

long number_with(const std::vector<std::string>& statements, const std::string& piece) {
  return std::ranges::count_if(statements, [&](const auto& statement) { return has(statement, piece); });
}

TEST(Statements, every_headline_is_either_trusted_or_doubted) {
  for (unsigned seed = 0; seed < members; ++seed) {
    const auto summary = Drawn(seed).summary;
    const auto& verdict = summary.verdict;
    std::size_t graded = 0;
    for (const auto& [name, body] : summary.bodies)
      for (const auto& headline : headlines(summary, name)) {
        ++graded;
        const auto one = statement_of(summary, name, headline, false);
        const bool resolved = headline.grade->grade == Grade::resolved;
        EXPECT_EQ(number_with(verdict.trusted, one) > 0, resolved) << seed << ": " << one;
        EXPECT_EQ(number_with(verdict.doubted, one) > 0, !resolved) << seed << ": " << one;
      }
    EXPECT_EQ(graded == 0,
              std::ranges::all_of(summary.bodies, [](const auto& b) { return b.second.verdict.about.empty(); }));
    const auto numbers = number_with(verdict.trusted, "peak ") + number_with(verdict.doubted, "peak ");
    EXPECT_EQ(numbers, static_cast<long>(graded)) << seed;
  }
}

TEST(Statements, the_water_is_either_trusted_or_doubted) {
  for (unsigned seed = 0; seed < members; ++seed) {
    const auto summary = Drawn(seed).summary;
    const auto& verdict = summary.verdict;
    for (const char* what : {"energy", "volume"}) {
      const auto names = [&](const std::string& statement) {
        return statement.starts_with("all of it") ||
               (statement.starts_with("the water's") && has(statement.substr(0, statement.find('(')), what));
      };
      const bool trusted = std::ranges::any_of(verdict.trusted, names),
                 doubted = std::ranges::any_of(verdict.doubted, names);
      EXPECT_FALSE(trusted && doubted) << seed << what;
      EXPECT_EQ(trusted || doubted, summary.ledger.has_value() || summary.status == "failed") << seed << what;
    }
  }
}

TEST(Statements, doubt_is_what_makes_a_grade_worse_than_resolved) {
  for (unsigned seed = 0; seed < members; ++seed) {
    const auto summary = Drawn(seed).summary;
    EXPECT_EQ(summary.verdict.doubted.empty(), summary.verdict.grade == Grade::resolved) << seed;
  }
}

TEST(Statements, the_advice_ends_with_the_next_step_and_is_never_empty) {
  int with_next = 0;
  for (unsigned seed = 0; seed < members; ++seed) {
    const auto summary = Drawn(seed).summary;
    const auto advice = advice_of(summary);
    ASSERT_FALSE(advice.empty());
    if (!summary.next) continue;
    ++with_next;
    EXPECT_EQ(advice.back(), text_of(*summary.next));
    if (summary.verdict.grade != Grade::unphysical) {
      EXPECT_EQ(advice.size(), 1u) << seed;
    }
  }
  EXPECT_GT(with_next, 50);
}

TEST(Statements, no_percentage_above_a_half_is_a_number_and_one_element_is_one) {
  const std::regex percentage("([0-9.]+) %"), plural("(^|[^0-9.])1 elements");
  for (unsigned seed = 0; seed < members; ++seed) {
    const auto summary = Drawn(seed).summary;
    auto all = summary.verdict.trusted;
    for (const auto& list : {summary.verdict.doubted, advice_of(summary)})
      all.insert(all.end(), list.begin(), list.end());
    for (const auto& text : all)
      for (std::sregex_iterator found(text.begin(), text.end(), percentage), end; found != end; ++found)
        EXPECT_LE(std::stod((*found)[1]), 50) << text;
    all.insert(all.end(), summary.verdict.reasons.begin(), summary.verdict.reasons.end());
    for (const auto& text : all) EXPECT_FALSE(std::regex_search(text, plural)) << text;
  }
}

TEST(Statements, summary_json_has_them) {
  const auto summary = Drawn(3).summary;
  const auto verdict = nlohmann::json::parse(to_json(summary))["verdict"];
  EXPECT_EQ(verdict["trusted"], nlohmann::json(summary.verdict.trusted));
  EXPECT_EQ(verdict["doubted"], nlohmann::json(summary.verdict.doubted));
  EXPECT_EQ(verdict["advice"], nlohmann::json(advice_of(summary)));
}

TEST(Statements, of_coarse_meshes_count_across_what_is_wet) {
  for (const auto& [half, pressed, words] : {std::tuple{0.2, NAN, "less than one element across its wet part"},
                                             {0.5, NAN, "only 1 element across its wet part"},
                                             {4.1, NAN, "only 8 elements across its wet part"},
                                             {11.5, NAN, "23 elements across its wet part"},
                                             {4.1, 0.7, "only 1 element across it"},
                                             {4.1, 6., "only 8 elements across its wet part"}}) {
    Summary summary;
    summary.status = "done";
    auto& body = summary.bodies["hull"];
    body.landing.first_contact = 0;
    auto& patch = summary.patches["belly"];
    patch.body = "hull";
    patch.pressure.offer(1000, 0.1);
    patch.evidence.elements = half, patch.evidence.pressed = pressed, patch.evidence.growing = 1;
    judge(summary);
    ASSERT_EQ(summary.verdict.doubted.size(), 1u);
    EXPECT_TRUE(summary.verdict.doubted[0].ends_with(std::string(": ") + words + ")")) << summary.verdict.doubted[0];
  }
}

TEST(Bands, in_words_never_promise_more_than_the_number) {
  EXPECT_EQ(band_words(0.0005), "within less than 0.1 %");
  EXPECT_EQ(band_words(0.041), "within 4.1 %");
  EXPECT_EQ(band_words(0.14), "may be off by 14 %");
  EXPECT_EQ(band_words(0.24), "may be off by a quarter");
  EXPECT_EQ(band_words(0.31), "may be off by a third");
  EXPECT_EQ(band_words(0.34), "may be off by half");
  EXPECT_EQ(band_words(0.51), "may be off by half and more");
  EXPECT_EQ(band_words(1.22), "tells no more than the order of magnitude");
  EXPECT_EQ(band_words(INFINITY), "has no band");
  EXPECT_EQ(band_mark(0.31), "+- 31 %");
  EXPECT_EQ(band_mark(0.61), "off by half and more");
  EXPECT_EQ(band_mark(1.22, "± "), "order of magnitude");
}

TEST(Bands, of_neighbours_are_said_once) {
  EXPECT_EQ(grouped({"a 1 g (within 4 %)", "b 2 N (within 4 %)", "c 3 N (within 5 %)", "the water"}),
            (std::vector<std::string>{"a 1 g, b 2 N (within 4 %)", "c 3 N (within 5 %)", "the water"}));
  EXPECT_EQ(grouped({"left: a 1 g (within 4 %)", "left: b 2 N (within 4 %)", "right: b 3 N (within 4 %)"}),
            (std::vector<std::string>{"left: a 1 g, b 2 N, right: b 3 N (within 4 %)"}));
  EXPECT_EQ(grouped({"the load (it rises: no peak)"}), (std::vector<std::string>{"the load (it rises: no peak)"}));
  EXPECT_TRUE(grouped({}).empty());
}

}  // namespace
}  // namespace splashdown::apps::statements_test
