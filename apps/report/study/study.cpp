#include "apps/report/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "apps/files/csv.hpp"
#include "apps/report/curves/charts.hpp"
#include "apps/report/data.hpp"
#include "apps/report/gnuplot.hpp"
#include "apps/report/page.hpp"
#include "apps/report/pairs/pairs.hpp"
#include "apps/report/study/campaign.hpp"
#include "apps/report/study/maps.hpp"
#include "apps/report/words.hpp"
#include "apps/text/pattern.hpp"

namespace splashdown::apps {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct StatusWords {
  const char* status;
  Mood mood;
  const char* meaning;  ///< after a number of runs
};

/// In the order in which they are told. docs/study.md
constexpr std::array<StatusWords, 6> all_status = {{
    {"converged", Mood::good, "reached their end"},
    {"diverged", Mood::bad, "diverged: the coupling's residual grew, or an error exceeds its limit"},
    {"stalled", Mood::bad, "stalled: the coupling did not converge within its passes, or the budget was spent"},
    {"failed", Mood::bad, "failed for another reason"},
    {"interrupted", Mood::fair, "are interrupted; the same command continues them"},
    {"waiting", Mood::fair, "are waiting; the same command makes them"},
}};

struct StudyData {
  fs::path directory;
  Json root;

  const Json& runs() const { return entries(root, "runs"); }
  std::string title() const {
    const auto title = text_at(root, "title");
    return title.empty() ? folder_name(directory) : title;
  }
  std::size_t count(const std::string& status) const {
    std::size_t number = 0;
    for (const auto& run : runs()) number += text_at(run, "status") == status ? 1 : 0;
    return number;
  }
};

StudyData read_study_folder(const fs::path& directory) {
  StudyData study{directory, read_json(directory / "study.json")};
  if (!study.root.is_object() || study.runs().empty())
    throw std::runtime_error((directory / "study.json").string() + ": is not the table of a study");
  return study;
}

/// A run that reached its end is worth what its verdict says: the page is as good as the worst of them.
void add_verdicts(const StudyData& study, Banner& banner) {
  std::string text;
  for (const char* grade : {"unphysical", "unresolved", "doubtful", "resolved"}) {
    const auto number = std::ranges::count_if(study.runs(), [&](const Json& run) {
      return text_at(run, "status") == "converged" && text_at(run, "verdict") == grade;
    });
    if (number == 0) continue;
    banner.mood = std::max(banner.mood, mood_of_grade(grade));
    text += fmt::format("{}<b class=\"{}\">{} {}</b>", text.empty() ? "" : ", ", css_class(mood_of_grade(grade)),
                        number, grade);
  }
  if (!text.empty())
    banner.sentences.push_back("Their verdicts: " + text + ". The page of a run says why, and what to do.");
}

Banner banner_of(const StudyData& study) {
  const std::size_t all = study.runs().size();
  // An envelope makes the runs that tell most, and [stop] as many as tell enough: the others are left out.
  const auto& campaign = member(study.root, "campaign");
  const bool chooses = campaign.contains("envelope");
  const auto& stop = member(campaign, "stop");
  const bool is_enough = stop.value("reached", false);
  const bool leaves_out = chooses || is_enough;
  const std::size_t waiting = study.count("waiting"), failed = study.count("failed");
  const std::size_t open = study.count("interrupted") + (leaves_out ? 0 : waiting);
  Banner banner{failed > 0 ? Mood::bad : open > 0 ? Mood::fair : Mood::good, {}, {}};
  banner.headline =
      open > 0 ? fmt::format("{} of {} runs have ended", all - open, all) : fmt::format("All {} runs have ended", all);
  if (chooses) banner.headline = fmt::format("{} of {} runs are made, near the envelope's line", all - waiting, all);
  if (is_enough && waiting > 0)
    banner.headline =
        fmt::format("{} of {} runs are enough: the band of {} is {:.3g} wide, asked for were {:.3g}", all - waiting,
                    all, html_escaped(text_at(stop, "of")), number_at(stop, {"width"}), number_at(stop, {"asked"}));
  for (const auto& [status, mood, meaning] : all_status)
    if (const auto number = study.count(status); number > 0 && !(leaves_out && std::string_view(status) == "waiting"))
      banner.sentences.push_back(fmt::format("<b>{}</b> {}.", number, meaning));
  add_verdicts(study, banner);
  double sum = 0, longest = 0;
  std::string longest_run;
  for (const auto& run : study.runs()) {
    const double seconds = number_at(run, {"numbers", "wall_seconds"});
    if (!std::isfinite(seconds)) continue;
    sum += seconds;
    if (seconds >= longest) longest = seconds, longest_run = text_at(run, "run");
  }
  if (sum > 0)
    banner.sentences.push_back(fmt::format("The runs took <b>{}</b> of wall time together; the longest, {}, {}.",
                                           seconds_text(sum), html_escaped(longest_run), seconds_text(longest)));
  return banner;
}

/// No wider than it was drawn: a chart of one panel would fill the page.
std::string in_its_width(const std::string& svg) {
  const auto [width] = Pattern("<svg[^>]* width=\"([0-9]+)\"").in<1>(svg);
  if (width.empty()) return svg;
  return fmt::format("<div style=\"max-width:{}px;margin:0 auto\">{}</div>", width, svg);
}

/// The chart as an element of the page; nothing if the study asks for none.
std::string chart_of(const fs::path& directory, std::vector<std::string>& warnings) {
  // The script that lies there is not run: a report of somebody else's folder must not carry out what it says.
  if (!fs::exists(directory / "study.svg") && fs::exists(directory / "study.gnuplot"))
    warnings.emplace_back("the chart, study.svg, is missing: splashdown study STUDY.toml --collect draws it");
  if (!fs::exists(directory / "study.svg")) return {};
  return "<h2>Chart</h2>\n" +
         html_wide_figure(in_its_width(inline_svg(read_text(directory / "study.svg"), "study")),
                          "Runs that broke down stand as crosses in the red band, in the colour of their curve. Where "
                          "curves coincide their points stand a little beside each other.");
}

std::string lines_of(const std::vector<Figure>& figures, const Charts& charts) {
  std::string html;
  for (const auto& figure : figures)
    if (charts.drawn.contains(figure.name)) html += html_chart(figure.name, "", figure.caption);
  return html.empty() ? html : "<h2>Lines</h2>\n<div class=\"grid\">" + html + "</div>\n";
}

std::string axes_table(const StudyData& study) {
  const auto& axes = entries(study.root, "axes");
  if (axes.empty()) return {};
  std::string html =
      "<h2>Axes</h2>\n<div class=\"scroll\"><table><thead><tr><th>axis</th><th class=\"text\">what it "
      "is</th><th>values</th><th class=\"text\"></th></tr></thead><tbody>\n";
  for (const auto& axis : axes) {
    std::string values;
    const auto& all = entries(axis, "values");
    constexpr std::size_t most_named = 12;  // a random axis has as many values as there are runs
    for (std::size_t k = 0; k < std::min(all.size(), most_named); ++k)
      values += (values.empty() ? "" : ", ") + html_escaped(all[k].get<std::string>());
    if (all.size() > most_named) values += " …";
    html += fmt::format("<tr><td><b>{}</b></td><td class=\"text\">{}</td><td>{}</td><td class=\"text\">{}</td></tr>\n",
                        html_escaped(text_at(axis, "name")), html_escaped(text_at(axis, "label")),
                        entries(axis, "values").size(), values);
  }
  return html + "</tbody></table></div>\n";
}

std::string number_cell(double value) {
  if (!std::isfinite(value)) return "<td>–</td>";
  const bool whole = value == std::round(value) && std::abs(value) < 1e7;
  return "<td>" + (whole ? count_text(value) : digits(value, 4)) + "</td>";
}

/// In the colour of the worse of status and verdict.
std::string status_cell(const std::string& status, const std::string& verdict) {
  for (const auto& words : all_status)
    if (words.status == status)
      return fmt::format("<td class=\"{}\"><b>{}</b></td>", css_class(std::max(words.mood, mood_of_grade(verdict))),
                         status);
  return "<td>" + html_escaped(status) + "</td>";
}

/// Names of the limits that any run has answered.
std::set<std::string> limits_of(const StudyData& study) {
  std::set<std::string> names;
  for (const auto& run : study.runs())
    if (run.contains("limits") && run["limits"].is_object())
      for (const auto& [name, answer] : run["limits"].items()) names.insert(name);
  return names;
}

std::string limit_cell(const Json& run, const std::string& name) {
  const auto answer = run.contains("limits") ? text_at(run["limits"], name.c_str()) : "";
  return "<td>" + (answer.empty() ? "–" : html_escaped(answer)) + "</td>";
}

std::string verdict_cell(const std::string& verdict) {
  if (verdict.empty()) return "<td>–</td>";
  return fmt::format("<td class=\"{}\"><b>{}</b></td>", css_class(mood_of_grade(verdict)), html_escaped(verdict));
}

/// The study's own quantities before what every study has, so that they are in view.
std::string runs_table(const StudyData& study) {
  const auto columns = study_columns(study.root);
  const auto limits = limits_of(study);
  const auto numbers = [&](bool own, const auto& add) {
    for (const auto& column : columns)
      if (column.own == own) add(column);
  };
  std::string html = "<h2>Runs</h2>\n<div class=\"scroll\"><table><thead><tr><th>run</th>", rows;
  const auto head = [&](const StudyColumn& column) { html += "<th>" + html_escaped(column.label) + "</th>"; };
  for (const auto& axis : entries(study.root, "axes")) html += "<th>" + html_escaped(text_at(axis, "name")) + "</th>";
  numbers(true, head);
  html += "<th>status</th><th>verdict</th>";
  for (const auto& name : limits) html += "<th>limit " + html_escaped(name) + "</th>";
  numbers(false, head);
  html += "</tr></thead><tbody>\n";
  bool linked = false;
  for (const auto& run : study.runs()) {
    const auto name = html_escaped(text_at(run, "run"));
    const bool has_page = fs::exists(study.directory / text_at(run, "run") / "report.html");
    linked |= has_page;
    rows += has_page ? fmt::format("<tr><td>{1}<a href=\"{0}/report.html\">{0}</a></td>", name,
                                   pick_cell(text_at(run, "run")))
                     : "<tr><td>" + pick_cell(text_at(run, "run")) + name + "</td>";
    for (const auto& axis : entries(study.root, "axes")) {
      const auto& value = run.at("axes").at(text_at(axis, "name"));
      rows += "<td>" +
              (value.is_number() ? fmt::format("{:g}", value.get<double>()) : html_escaped(value.get<std::string>())) +
              "</td>";
    }
    const auto verdict = text_at(run, "verdict");
    const auto number = [&](const StudyColumn& column) {
      rows += number_cell(number_at(run, {"numbers", column.name.c_str()}));
    };
    numbers(true, number);
    rows += status_cell(text_at(run, "status"), verdict) + verdict_cell(verdict);
    for (const auto& limit : limits) rows += limit_cell(run, limit);
    numbers(false, number);
    rows += "</tr>\n";
  }
  html += rows + "</tbody></table></div>\n";
  if (linked) html += "<p class=\"where\">A run's name leads to its own report.</p>\n";
  return html;
}

std::string causes_table(const StudyData& study) {
  std::string rows;
  for (const auto& run : study.runs())
    if (const auto cause = text_at(run, "cause"); !cause.empty())
      rows += fmt::format("<tr><td>{}</td>{}<td class=\"text\">{}</td></tr>\n", html_escaped(text_at(run, "run")),
                          status_cell(text_at(run, "status"), {}), html_escaped(cause));
  if (rows.empty()) return rows;
  return "<h2>Why runs stopped</h2>\n<div class=\"scroll\"><table><thead><tr><th>run</th><th>status</th><th "
         "class=\"text\">cause</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>\n";
}

}  // namespace

bool holds_study(const fs::path& directory) { return fs::exists(directory / "study.json"); }

ReportResult write_study_report(const fs::path& directory) {
  const StudyData study = read_study_folder(directory);
  ReportResult result{directory / "report.html", {}};
  const auto chart = chart_of(directory, result.warnings);
  const auto lines = chart.empty() ? study_lines(directory, study.root) : std::vector<Figure>();
  const auto charts = charts_of(lines, 1, entries(study.root, "runs").size() > 1);
  result.warnings.insert(result.warnings.end(), charts.warnings.begin(), charts.warnings.end());
  const auto pairs = pairs_of(directory, study.root, !charts.html.empty());
  std::vector<std::string> notes;
  for (const auto& warning : result.warnings) notes.push_back(html_escaped(warning));
  write_file_atomically(
      result.page,
      html_page(study.title(), html_header(study.title(), directory, banner_of(study), notes) + chart +
                                   lines_of(lines, charts) + study_bars(directory, study.root) +
                                   heat_maps(directory, study.root) + campaign_section(study.root) + runs_table(study) +
                                   pairs + causes_table(study) + axes_table(study) +
                                   "<footer>Made by Splashdown from <code>study.json</code> in this folder; the same "
                                   "as a table: <code>study.csv</code>.</footer>\n" +
                                   charts.html));
  return result;
}

}  // namespace splashdown::apps
