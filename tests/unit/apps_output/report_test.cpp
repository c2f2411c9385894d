#include "apps/report/report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "apps/report/curves/charts.hpp"
#include "apps/report/curves/filtered_curves.hpp"
#include "apps/report/curves/reduction.hpp"
#include "apps/report/figures.hpp"
#include "apps/report/gnuplot.hpp"
#include "apps/report/words.hpp"
#include "apps/statistics/verdict/verdict.hpp"
#include "apps/text/plain_text.hpp"
#include "stand_ins.hpp"
#include "tests/scratch_folder.hpp"

namespace splashdown::apps::report_test {
namespace {

void make_run(const std::filesystem::path& directory, const std::string& status = "done", double energy_gain = 0) {
  RecorderSettings<2> settings;
  settings.directory = directory;
  settings.frames = 0.01;
  Recorder<2> recorder(settings);
  StandInDrop drop;
  for (int n = 0; n <= 60; ++n) {
    RecordInput<2> input = drop.at(n * drop_end / 60, drop_end / 60);
    input.last = n == 60;
    recorder.record(input);
    if (input.last) recorder.snapshot("end", input);
  }
  recorder.finish();
  Summary summary;
  summary.scene = "A <wedge> drop";
  summary.status = status;
  summary.simulated_time = drop_end;
  summary.steps = 61;
  summary.wall_seconds = 12;
  summary.phases = {{"remesh", 5}, {"pressure", 6}};
  summary.coupling = CouplingSummary{};
  recorder.summarise(summary);
  for (auto& [name, body] : summary.bodies)
    body.acceleration_grades = body.force_grades = {};  // a mesh of a few facets
  if (energy_gain > 0) summary.ledger->energy_gain = energy_gain;
  judge(summary);
  write_summary(directory, summary);
}

/// Sets PATH for the life of a test, so that gnuplot is found or not.
class PathVariable {
 public:
  explicit PathVariable(const std::string& value) : old_(std::getenv("PATH")) { setenv("PATH", value.c_str(), 1); }
  ~PathVariable() { setenv("PATH", old_.c_str(), 1); }
  PathVariable(const PathVariable&) = delete;
  PathVariable& operator=(const PathVariable&) = delete;

 private:
  std::string old_;
};

TEST(Report, is_one_page_without_links_to_elsewhere) {
  ScratchFolder folder;
  make_run(folder.path());
  const ReportResult result = write_report(folder.path());
  const std::string page = folder.text("report.html");
  EXPECT_EQ(result.page, folder.path() / "report.html");
  EXPECT_NE(page.find("The run finished"), std::string::npos);
  EXPECT_NE(page.find("A &lt;wedge&gt; drop"), std::string::npos);
  for (const char* outside : {"src=\"http", "href=\"http", "<script src", "@import", "src=\"//"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  for (const auto& warning : result.warnings)
    EXPECT_TRUE(warning.find("gnuplot") != std::string::npos || warning.find("libjs-") != std::string::npos) << warning;
}

TEST(Report, shows_curves_and_fields_where_gnuplot_is_installed) {
  ScratchFolder folder;
  make_run(folder.path());
  const ReportResult result = write_report(folder.path());
  if (!result.warnings.empty() && result.warnings[0].find("not installed") != std::string::npos)
    GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_TRUE(result.warnings.empty()) << result.warnings[0];
  const std::string page = folder.text("report.html");
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_NE(page.find("data:image/png;base64,"), std::string::npos);
  EXPECT_NE(page.find("Largest load"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "report/energy_gain.svg"));
}

TEST(Report, without_gnuplot_it_has_its_words_and_says_what_to_install) {
  ScratchFolder folder;
  make_run(folder.path());
  const PathVariable nowhere("/nonexistent");
  const ReportResult result = write_report(folder.path());
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("sudo apt install gnuplot-nox"), std::string::npos);
  const std::string page = folder.text("report.html");
  EXPECT_NE(page.find("sudo apt install gnuplot-nox"), std::string::npos);
  EXPECT_NE(page.find("peak load, resultant"), std::string::npos);
  EXPECT_EQ(page.find("gnuplot_"), std::string::npos) << "what gnuplot draws; hulls are drawn without it";
}

TEST(Report, a_run_without_summary_is_reported_from_its_files) {
  ScratchFolder folder;
  make_run(folder.path());
  std::filesystem::remove(folder.path() / "summary.json");
  const PathVariable nowhere("/nonexistent");
  write_report(folder.path());
  EXPECT_NE(folder.text("report.html").find("No summary yet"), std::string::npos);
}

TEST(Report, a_failed_run_says_so) {
  ScratchFolder folder;
  make_run(folder.path(), "failed");
  const PathVariable nowhere("/nonexistent");
  write_report(folder.path());
  EXPECT_NE(folder.text("report.html").find("The run could not go on"), std::string::npos);
}

TEST(Report, shows_the_verdict_in_its_colour_with_its_reason_above_all) {
  const auto page_of = [](double energy_gain) {
    ScratchFolder folder;
    make_run(folder.path(), "done", energy_gain);
    const PathVariable nowhere("/nonexistent");
    write_report(folder.path());
    return folder.text("report.html");
  };
  const auto red = page_of(0.4), amber = page_of(0.03), green = page_of(0);
  EXPECT_NE(red.find("class=\"verdict bad\"><strong>The run finished: unphysical"), std::string::npos);
  EXPECT_NE(amber.find("class=\"verdict fair\"><strong>The run finished: doubtful"), std::string::npos);
  EXPECT_NE(green.find("class=\"verdict good\"><strong>The run finished: resolved"), std::string::npos);
  const auto reason = red.find("from nowhere");
  ASSERT_NE(reason, std::string::npos);
  EXPECT_LT(reason, red.find("were simulated in"));
  EXPECT_GT(green.find("from nowhere"), green.find("were simulated in")) << "but for the words below its curve";
  for (const auto& page : {red, amber, green}) EXPECT_NE(page.find("energy gain of the water"), std::string::npos);
}

TEST(Report, says_the_verdict_in_three_lines_then_answers_then_the_numerics) {
  ScratchFolder folder;
  make_run(folder.path(), "done", 0.03);
  const PathVariable nowhere("/nonexistent");
  write_report(folder.path());
  const auto page = folder.text("report.html");
  std::size_t last = 0;
  for (const char* piece :
       {">trust</span>", ">doubt</span>", "the water&#39;s energy (3 % of what was exchanged", ">do</span>",
        "why, with the numbers", "class=\"tile\"", "peak acceleration of the centre of mass",
        "peak load, all directions together", "class=\"quiet\"", "<h2>Bodies</h2>", "<h2>Where the time went</h2>"}) {
    const auto at = page.find(piece, last);
    EXPECT_NE(at, std::string::npos) << piece << " does not follow what should stand before it";
    if (at != std::string::npos) last = at;
  }
}

TEST(Report, of_an_earlier_version_without_the_lines_has_its_reasons) {
  ScratchFolder folder;
  folder.write("summary.json", R"({"status": "done", "verdict": {"grade": "doubtful", "reasons": ["It looks odd."]}})");
  const PathVariable nowhere("/nonexistent");
  write_report(folder.path());
  EXPECT_NE(folder.text("report.html").find("It looks odd."), std::string::npos);
}

TEST(Report, has_a_number_for_each_patch_limit_and_instrument) {
  ScratchFolder folder;
  folder.write("summary.json", R"({"status": "done", "dimension": 3,
    "limits": {"belly": {"answer": "no", "above": 20000, "value": 13200, "band": 1100, "unit": "Pa"}},
    "bodies": {"uav": {"first_contact_time": 0.01, "settled_time": 2.5, "capsized_time": null, "skips": 0,
      "attitude_deg": {"roll": {"end": -1.02}, "pitch": {"end": 3.4}},
      "peak_acceleration_g": {"raw": {"value": 9.1, "time": 0.1}}, "grades": {"peak_acceleration_g": {}}}},
    "equipment": {"payload": {"raw": {"value": 14, "time": 0.1}, "cfc60": {"value": 12.3, "time": 0.1, "rise_time": 0.004, "delta_v": 2.5},
      "grades": {"cfc60": {"grade": "unresolved", "band_percent": 61}}}},
    "patches": {"belly": {"peak_pressure": {"value": 13200, "time": 0.1}, "impulse": 12, "grades": {"peak_pressure": {"grade": "resolved", "band_percent": 4}}},
      "tail": {"peak_pressure": {"value": 1100, "time": 0.1}, "impulse": 1}}})");
  const PathVariable nowhere("/nonexistent");
  write_report(folder.path());
  const auto page = folder.text("report.html");
  for (const char* piece :
       {"<b>no</b>", "belly above 20 kPa? 13.2 kPa ± 1.1 kPa", "<b>12.3 g</b>", "peak acceleration at payload, CFC 60",
        "may be off by half and more", "Δv 2.50 m/s, rises in 4.00 ms", "<b>13.2 kPa</b>",
        "highest of 2 patches: mean over belly", "within 4 %", "<b>at rest</b>", "trim 3.4°, heel −1.0°",
        "<h2>Pressures</h2>", "<td>tail</td><td>1.10 kPa</td>"})
    EXPECT_NE(page.find(piece), std::string::npos) << piece;
  EXPECT_EQ(page.find("61 %"), std::string::npos);
}

// J211's filter leaves what is far below its class as it is, also over steps of different lengths, and takes what is far above.
TEST(FilteredCurves, keep_slow_motion_and_take_fast_one) {
  Table rows{{"time", "ax", "ay"}, {{}, {}, {}}};
  for (double t = 0; t < 1; t += rows.rows() % 2 == 0 ? 0.7e-3 : 1.3e-3) {
    rows.columns[0].push_back(t);
    rows.columns[1].push_back(10 * std::sin(2 * M_PI * 3 * t));
    rows.columns[2].push_back(10 * std::sin(2 * M_PI * 350 * t));
  }
  const auto curves = filtered_curves(rows, {"ax", "ay"}, 60);
  ASSERT_TRUE(curves);
  double slow = 0, fast = 0;
  for (std::size_t i = 0; i < curves->t.size(); ++i) {
    if (curves->t[i] < 0.1 || curves->t[i] > 0.9) continue;
    slow = std::max(slow, std::abs(curves->values[0][i] - 10 * std::sin(2 * M_PI * 3 * curves->t[i])));
    fast = std::max(fast, std::abs(curves->values[1][i]));
  }
  // |H|^2 = 1 / (1 + (f / 2.0775 CFC)^4); a step's mean stands for its middle: half a step of a slope of 2 pi f.
  EXPECT_LT(slow, 10 * (std::pow(3 / (2.0775 * 60), 4) + 2 * M_PI * 3 * 1.3e-3));
  EXPECT_LT(fast, 10 * std::pow(2.0775 * 60 / 350, 2));
  EXPECT_FALSE(filtered_curves(rows, {"ax", "az"}, 60)) << "there is no such column";
  EXPECT_FALSE(filtered_curves({{"time", "ax"}, {{0, 1e-3, 1e-3}, {1, 2, 3}}}, {"ax"}, 60)) << "time stands still";
}

TEST(Report, shows_instruments_in_g_with_their_components_in_one_figure) {
  ScratchFolder folder;
  folder.write(
      "probes.csv",
      "time,probe,value\n0,seat.ax,1\n0,seat.ay,-9.80665\n0,keel,5\n0.1,seat.ax,1\n0.1,seat.ay,9.80665\n0.1,keel,6\n");
  folder.write(
      "scene.resolved.toml",
      "[[record]]\nkind = \"pressure\"\nname = \"keel\"\n\n[[record]]\nkind = \"acceleration\"\nname = \"seat\"\n");
  folder.write("summary.json", "{}");
  const auto groups = figures_of(read_run(folder.path()));
  ASSERT_EQ(groups.size(), 1u);
  ASSERT_EQ(groups[0].figures.size(), 2u);
  const auto& seat = groups[0].figures[0];
  EXPECT_EQ(seat.y_label, "acceleration / g");
  ASSERT_EQ(seat.curves.size(), 2u);
  EXPECT_EQ(seat.curves[1].label, "a_y");
  EXPECT_DOUBLE_EQ(seat.curves[1].y[1], 1);
  EXPECT_EQ(groups[0].figures[1].y_label, "keel / Pa");
}

TEST(Report, a_folder_without_a_run_is_an_error_and_stays_as_it_is) {
  ScratchFolder folder;
  EXPECT_THROW(write_report(folder.path()), std::runtime_error);
  EXPECT_THROW(write_report(folder.path() / "absent"), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Thinning, keeps_the_extremes_and_the_ends) {
  std::vector<double> x, y;
  for (int i = 0; i < 100000; ++i) {
    x.push_back(i);
    y.push_back(std::sin(1e-4 * i));
  }
  y[54321] = 7;
  y[65432] = -7;
  const double first = x.front(), last = x.back();
  thin(x, y, 1000);
  EXPECT_LE(x.size(), 1001u);
  EXPECT_TRUE(std::ranges::is_sorted(x));
  EXPECT_EQ(std::ranges::count(y, 7), 1);
  EXPECT_EQ(std::ranges::count(y, -7), 1);
  EXPECT_EQ(x.front(), first);
  EXPECT_EQ(x.back(), last);
}

TEST(Words, of_others_are_one_line_that_no_terminal_obeys) {
  EXPECT_EQ(one_line("plain, µ ½ é 水 🌊"), "plain, µ ½ é 水 🌊");
  EXPECT_EQ(one_line("a\nb\tc\r\x1b[31m\x7f"), "a b c  [31m ");
  EXPECT_EQ(one_line("\xc2\x9b 31m"), "  31m") << "the control sequence introducer in one character";
  EXPECT_EQ(one_line("\xc2"), "\xc2") << "cut in the middle";
}

TEST(Words, stand_between_single_quotes_for_gnuplot) {
  EXPECT_EQ(gnuplot_text("`touch x` $(y) @z \"q\" \\"), "'`touch x` $(y) @z \"q\" \\'");
  EXPECT_EQ(gnuplot_text("don't\n! touch x"), "'don''t ! touch x'");
}

TEST(Words, numbers_have_the_digits_asked_for) {
  EXPECT_EQ(digits(26.7349, 4), "26.73");
  EXPECT_EQ(digits(9.9999, 3), "10.0");
  EXPECT_EQ(digits(-0.0123456, 3), "−0.0123");
  EXPECT_EQ(digits(123456, 3), "123456");
  EXPECT_EQ(digits(-2e-6, 3), "−2.00·10⁻⁶");
  EXPECT_EQ(digits(0), "0");
  EXPECT_EQ(digits(std::nan("")), "–");
  EXPECT_EQ(digits_with_unit(26734.9, "N/m"), "26.73 kN/m");
  EXPECT_EQ(seconds_text(0.0149), "14.9 ms");
  EXPECT_EQ(seconds_text(7500), "2 h 05 min");
}

TEST(Report, probes_have_the_units_of_their_records) {
  ScratchFolder folder;
  folder.write("probes.csv", "time,probe,value\n0,keel,1\n0,gauge,2\n0,seat.ay,3\n0,other,4\n");
  folder.write("scene.resolved.toml",
               "[[body]]\nname = \"keel\"\n\n[[record]]\nkind = \"pressure\"\nname = \"keel\"\n\n[[record]]\n"
               "kind = \"surface_elevation\"\nname = \"gauge\"\n\n[[record]]\nname = \"seat\"\nkind = "
               "\"acceleration\"\n\n[provenance]\nkind = \"pressure\"\n");
  folder.write("summary.json", "{}");
  const auto run = read_run(folder.path());
  EXPECT_EQ(run.unit_of_probe("keel"), " / Pa");
  EXPECT_EQ(run.unit_of_probe("gauge"), " / m");
  EXPECT_EQ(run.unit_of_probe("seat.ay"), " / (m/s²)");
  EXPECT_EQ(run.unit_of_probe("other"), "");
  for (const auto& group : figures_of(run)) {
    if (!group.title.starts_with("Probes")) continue;
    EXPECT_EQ(group.figures[0].y_label, "keel / Pa");
  }
}

}  // namespace
}  // namespace splashdown::apps::report_test
