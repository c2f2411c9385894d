// Curves that a page holds: what reduction keeps, what is packed, what stands behind them; colours for dark screens.
#include "apps/report/curves/charts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "apps/report/curves/behind.hpp"
#include "apps/report/curves/reduction.hpp"
#include "apps/report/look/theme.hpp"
#include "apps/report/pairs/pairs.hpp"
#include "apps/report/study/maps.hpp"
#include "tests/scratch_folder.hpp"

namespace splashdown::apps::charts_test {
namespace {

struct Samples {
  std::vector<double> x, y;
};

/// Waves with noise and single peaks, at uneven steps.
Samples drawn_curve(std::mt19937& random, std::size_t n) {
  std::uniform_real_distribution<double> step(0.2, 1.8), phase(0, 6), noise(-1, 1);
  Samples curve;
  const double frequency = 0.001 * (1 + phase(random)), shake = noise(random) > 0 ? 0 : 0.05;
  double x = 0;
  for (std::size_t i = 0; i < n; ++i) {
    curve.x.push_back(x += step(random));
    curve.y.push_back(std::sin(frequency * x) + shake * noise(random));
  }
  for (int peak = 0; peak < 5; ++peak) curve.y[random() % n] = 3 + noise(random);
  return curve;
}

double between(const Samples& curve, double x) {
  const auto above = static_cast<std::size_t>(std::ranges::lower_bound(curve.x, x) - curve.x.begin());
  if (curve.x[above] == x) return curve.y[above];
  const double share = (x - curve.x[above - 1]) / (curve.x[above] - curve.x[above - 1]);
  return curve.y[above - 1] + share * (curve.y[above] - curve.y[above - 1]);
}

TEST(Reduction, stays_within_its_tolerance_and_keeps_lowest_highest_and_ends) {
  std::mt19937 random(55);
  for (int draw = 0; draw < 40; ++draw) {
    const auto whole = drawn_curve(random, 2000);
    const double tolerance = std::pow(10., -1 - draw % 4);
    auto few = whole;
    straighten(few.x, few.y, tolerance);
    EXPECT_LE(few.x.size(), whole.x.size());
    EXPECT_TRUE(std::ranges::is_sorted(few.x));
    EXPECT_EQ(std::ranges::max(few.y), std::ranges::max(whole.y));
    EXPECT_EQ(std::ranges::min(few.y), std::ranges::min(whole.y));
    EXPECT_EQ(few.x.front(), whole.x.front());
    EXPECT_EQ(few.x.back(), whole.x.back());
    for (std::size_t i = 0; i < whole.x.size(); ++i)
      ASSERT_LE(std::abs(between(few, whole.x[i]) - whole.y[i]), tolerance * (1 + 1e-9)) << i;
  }
}

TEST(Reduction, leaves_the_ends_of_a_straight_line_and_both_sides_of_a_gap) {
  Samples line{{0, 1, 2, 3, 4}, {0, 2, 4, 6, 8}};
  straighten(line.x, line.y, 1e-9);
  EXPECT_EQ(line.x, (std::vector<double>{0, 4}));
  Samples gap{{0, 1, 2, 3, 4, 5, 6}, {0, 1, 2, NAN, 4, 5, 6}};
  straighten(gap.x, gap.y, 1e-9);
  EXPECT_EQ(gap.x, (std::vector<double>{0, 2, 3, 4, 6}));
  EXPECT_TRUE(std::isnan(gap.y[2]));
}

/// In each of 400 pieces of a long record the page's curve has the same lowest and highest value, to the tolerance of straightening.
TEST(Charts, keep_the_peaks_of_each_piece_of_a_long_record_in_little_space) {
  std::mt19937 random(7);
  const auto whole = drawn_curve(random, 200000);
  Figure figure;
  figure.name = "f";
  figure.curves = {{"noise", whole.x, whole.y, "#0f2f4f"}};
  const auto text = charts_json({figure}, 1);
  EXPECT_LT(text.size(), 120000u) << "3000 points of two numbers and their commas";
  const auto curve = nlohmann::json::parse(text)["charts"][0]["curves"][0];
  EXPECT_EQ(curve["colour"], "--c-ink");
  const Samples few{curve["x"].get<std::vector<double>>(), curve["y"].get<std::vector<double>>()};
  constexpr std::size_t pieces = 400;
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    const std::size_t begin = piece * whole.x.size() / pieces, end = (piece + 1) * whole.x.size() / pieces;
    const double high = *std::max_element(whole.y.begin() + long(begin), whole.y.begin() + long(end));
    double found = -INFINITY;
    for (std::size_t i = 0; i < few.x.size(); ++i)
      if (few.x[i] >= whole.x[begin] * (1 - 1e-6) && few.x[i] <= whole.x[end - 1] * (1 + 1e-6))
        found = std::max(found, few.y[i]);
    // Seven digits, and a straightened stretch whose ends lie in the pieces beside it.
    if (high > 1.2) {
      EXPECT_NEAR(found, high, 1e-6 * high) << piece;
    }
  }
}

TEST(Charts, have_an_own_axis_for_each_side_and_the_links_of_points) {
  Figure figure;
  figure.name = "f";
  figure.curves = {{.label = "a", .x = {0, 1}, .y = {2, 3}, .colour = "#123456", .links = {"r/report.html", ""}},
                   {.label = "b", .x = {0, 1}, .y = {NAN, NAN}, .colour = "#123456"},
                   {.label = "c", .x = {0, 1}, .y = {20, 30}, .colour = "#123456", .right_axis = true}};
  const auto chart = nlohmann::json::parse(charts_json({figure, Figure{}}, 2))["charts"];
  ASSERT_EQ(chart.size(), 1u) << "a figure without a curve has no chart";
  ASSERT_EQ(chart[0]["curves"].size(), 2u) << "nor has a curve without a number";
  EXPECT_EQ(chart[0]["curves"][0]["links"][0], "r/report.html");
  EXPECT_EQ(chart[0]["curves"][0]["colour"], "#123456");
  EXPECT_LT(chart[0]["range"][1], 4);
  EXPECT_GT(chart[0]["range2"][1], 29);
}

TEST(Behind, limits_of_a_number_in_any_class_and_the_pulse_that_is_shown) {
  const auto summary = nlohmann::ordered_json::parse(R"({"limits": {
      "crew": {"above": 12, "quantity": "seat.peak_g", "unit": "g"}, "box": {"above": 30, "quantity": "seat.peak_g_raw", "unit": "g"},
      "other": {"above": 5, "quantity": "seat.peak_g - bow.peak_g", "unit": "g"}}})");
  const auto levels = levels_of(summary, "seat.peak_g");
  ASSERT_EQ(levels.size(), 2u);
  EXPECT_EQ(levels[0].y, 12);
  const auto peaks = nlohmann::ordered_json::parse(
      R"({"cfc60": {"begin": 9, "duration": 9}, "cfc180": {"begin": 0.1, "duration": 0.02, "delta_v": 2}})");
  const auto pulse = pulse_of_peaks(peaks, 1000);
  ASSERT_EQ(pulse.size(), 1u);
  EXPECT_DOUBLE_EQ(pulse[0].from, 100);
  EXPECT_DOUBLE_EQ(pulse[0].to, 120);
  EXPECT_TRUE(
      pulse_of_peaks(nlohmann::ordered_json::parse(R"({"cfc180": {"begin": 0.1, "duration": null}})"), 1).empty());
}

TEST(Theme, gives_names_to_colours_of_axes_and_leaves_those_of_a_picture_within) {
  const auto page = themed(
      "<svg stroke='rgb( 15,  47,  79)' fill=\"#FFF\" id='#abc'><rect fill=\"#fff\"/><svg stroke=\"#0f2f4f\"/></svg>"
      "<g fill=\"rgb(81,96,110)\"/></svg>");
  EXPECT_NE(page.find("stroke='var(--c-ink)'"), std::string::npos);
  EXPECT_NE(page.find("<rect fill=\"var(--paper)\""), std::string::npos);
  EXPECT_NE(page.find("<svg stroke=\"#0f2f4f\""), std::string::npos);
  EXPECT_NE(page.find("<g fill=\"var(--soft)\""), std::string::npos);
  EXPECT_NE(page.find("id='#abc'"), std::string::npos);
}

nlohmann::ordered_json study_of(const std::vector<std::string>& axes, const std::vector<std::vector<double>>& values) {
  nlohmann::ordered_json study = {
      {"units", {{"peak", "N"}}},
      {"columns", {{{"name", "steps"}, {"label", "steps"}}, {{"name", "peak"}, {"label", "peak <N>"}}}}};
  for (const auto& axis : axes) study["axes"].push_back({{"name", axis}, {"label", axis}, {"values", {"1", "2"}}});
  for (const auto& row : values) {
    nlohmann::ordered_json run = {{"run", "r" + std::to_string(study["runs"].size())}, {"status", "converged"}};
    double sum = 0;
    for (std::size_t a = 0; a < axes.size(); ++a) run["axes"][axes[a]] = row[a], sum += row[a];
    run["numbers"] = {{"steps", 10}, {"peak", sum}};
    study["runs"].push_back(run);
  }
  return study;
}

TEST(StudyMaps, two_axes_of_numbers_make_a_map_whose_cells_lead_to_runs_and_one_makes_lines) {
  ScratchFolder folder;
  folder.write("r3/report.html", "");
  const auto two = study_of({"a", "b"}, {{1, 10}, {1, 20}, {2, 10}, {2, 20}}), one = study_of({"a"}, {{1}, {2}});
  const auto map = heat_maps(folder.path(), two);
  EXPECT_NE(map.find("peak &lt;N&gt;"), std::string::npos);
  EXPECT_NE(map.find("<a href=\"./r3/report.html\">22.0</a>"), std::string::npos);
  EXPECT_EQ(map.find("r0/report.html"), std::string::npos) << "it has no page";
  EXPECT_EQ(map.find("steps"), std::string::npos) << "not a quantity of the study's own";
  EXPECT_TRUE(study_lines(folder.path(), two).empty());
  EXPECT_TRUE(heat_maps(folder.path(), one).empty());
  const auto lines = study_lines(folder.path(), one);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].curves[0].y, (std::vector<double>{1, 2}));
  EXPECT_EQ(study_columns(two).front().name, "peak") << "own quantities come first";
}

/// Two axes of words, of which the second has one value or two.
nlohmann::ordered_json study_of_words(const std::vector<std::string>& schemes, const std::vector<std::string>& terms) {
  nlohmann::ordered_json study = {{"units", {{"error", "-"}}},
                                  {"columns",
                                   {{{"name", "passes_mean"}, {"label", "passes"}},
                                    {{"name", "steps"}, {"label", "steps"}},
                                    {{"name", "error"}, {"label", "error"}}}}};
  study["axes"] = {{{"name", "scheme"}, {"label", "scheme"}, {"values", schemes}},
                   {{"name", "term"}, {"label", "term"}, {"values", terms}}};
  double number = 1;
  for (const auto& scheme : schemes)
    for (const auto& term : terms) {
      study["runs"].push_back(
          {{"run", "r" + std::to_string(study["runs"].size())},
           {"status", "converged"},
           {"axes", {{"scheme", scheme}, {"term", term}}},
           {"numbers", {{"passes_mean", number}, {"steps", 10}, {"error", std::pow(10., number)}}}});
      ++number;
    }
  return study;
}

TEST(StudyBars, of_schemes_are_as_long_as_their_numbers_and_lead_to_the_runs) {
  ScratchFolder folder;
  folder.write("r1/report.html", "");
  const auto study = study_of_words({"aitken", "probe<", "none", "broyden"}, {"rigid"});
  const auto bars = study_bars(folder.path(), study);
  EXPECT_NE(bars.find("<a href=\"./r1/report.html\">probe&lt;</a>"), std::string::npos) << bars;
  EXPECT_NE(bars.find("class=\"length\" style=\"--s:50.0%\"><span>2.00</span>"), std::string::npos)
      << "two of four passes";
  EXPECT_NE(bars.find("error, log scale"), std::string::npos) << "three decades";
  EXPECT_NE(bars.find("class=\"spot\" style=\"--s:34.0%\"><span>100</span>"), std::string::npos) << bars;
  EXPECT_EQ(bars.find("steps"), std::string::npos) << "neither the study's own nor a cost";
  EXPECT_TRUE(heat_maps(folder.path(), study).empty());
  EXPECT_TRUE(study_lines(folder.path(), study).empty());
}

TEST(StudyMaps, two_axes_of_words_make_a_map_in_their_order) {
  const ScratchFolder folder;
  const auto study = study_of_words({"zeta", "alpha"}, {"rigid", "none"});
  EXPECT_TRUE(study_bars(folder.path(), study).empty());
  const auto map = heat_maps(folder.path(), study);
  const auto zeta = map.find("<th>zeta</th>"), alpha = map.find("<th>alpha</th>");
  ASSERT_NE(zeta, std::string::npos) << map;
  EXPECT_LT(zeta, alpha) << "not by the alphabet";
  EXPECT_NE(map.find("passes"), std::string::npos) << "what schemes cost";
}

TEST(Pairs, have_the_numbers_and_curves_of_all_runs_and_one_run_has_none) {
  ScratchFolder folder;
  const auto study = study_of_words({"aitken", "probe"}, {"rigid"});
  std::string rows = "time,body,x,y,z,vy,ay,fy,submergence\n";
  for (int i = 0; i <= 2000; ++i)
    rows += std::to_string(0.001 * i) + ",hull,0,0,0,-1,2," + std::to_string(i == 700 ? 50 : 1) + ",0.1\n";
  folder.write("r0/bodies.csv", rows);
  folder.write("r0/report.html", "");
  const auto json = nlohmann::json::parse(pairs_json(folder.path(), study));
  ASSERT_EQ(json["runs"].size(), 2u);
  EXPECT_EQ(json["runs"][0]["link"], "./r0/report.html");
  EXPECT_EQ(json["runs"][1]["link"], "");
  EXPECT_EQ(json["runs"][1]["numbers"]["error"], 100);
  EXPECT_EQ(json["curves"].size(), 4u);
  const auto load = json["runs"][0]["curves"]["0"];
  EXPECT_LT(load[0].size(), 20u) << "straight stretches have two ends";
  const auto y = load[1].get<std::vector<double>>();
  EXPECT_EQ(std::ranges::max(y), 50) << "a peak stays";
  EXPECT_TRUE(json["runs"][1]["curves"].empty());
  const auto html = pairs_of(folder.path(), study, true);
  EXPECT_NE(html.find("<section id=\"pairs\" hidden>"), std::string::npos);
  EXPECT_EQ(html.find("http"), std::string::npos) << "nothing is fetched";
  EXPECT_TRUE(pairs_of(folder.path(), study_of_words({"aitken"}, {"rigid"}), true).empty());
  EXPECT_EQ(pick_cell("a\"b").find("a\"b"), std::string::npos);
}

}  // namespace
}  // namespace splashdown::apps::charts_test
