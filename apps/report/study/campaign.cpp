#include "apps/report/study/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/report/data.hpp"
#include "apps/report/page.hpp"
#include "apps/report/study/distributions.hpp"
#include "apps/report/study/envelopes.hpp"
#include "apps/report/words.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {
namespace {

using Json = nlohmann::ordered_json;

/// A low and a high number; nan where there are none.
std::pair<double, double> band_at(const Json& row, const char* name) {
  if (!row.contains(name) || !row[name].is_array() || row[name].size() != 2 || !row[name][0].is_number() ||
      !row[name][1].is_number())
    return {NAN, NAN};
  return {row[name][0].get<double>(), row[name][1].get<double>()};
}

/// "all runs", "mass = 100"
std::string at_text(const Json& row) {
  std::string text;
  if (row.contains("at") && row["at"].is_object())
    for (const auto& [axis, value] : row["at"].items())
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", axis,
                          value.is_string() ? value.get<std::string>() : value.dump());
  return text.empty() ? "all runs" : html_escaped(text);
}

/// A line from low to high with a point at the estimate, on a scale from `from` to `to`; a tick at `zero` if it is in between.
std::string bar(double value, std::pair<double, double> band, double from, double to, double zero) {
  constexpr double width = 220, height = 18;
  const auto x = [&](double v) { return 4 + (width - 8) * std::clamp((v - from) / (to - from), 0., 1.); };
  std::string svg = fmt::format(
      "<svg class=\"band\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\">", width, height);
  const auto line = [&](double x1, double y1, double x2, double y2, const char* style) {
    svg += fmt::format("<line x1=\"{:.1f}\" y1=\"{}\" x2=\"{:.1f}\" y2=\"{}\" stroke=\"currentColor\" {}/>", x1, y1, x2,
                       y2, style);
  };
  line(4, height / 2, width - 4, height / 2, "stroke-opacity=\"0.15\"");
  if (from <= zero && zero <= to) line(x(zero), 2, x(zero), height - 2, "stroke-opacity=\"0.5\"");
  if (std::isfinite(band.first))
    line(x(band.first), height / 2, x(band.second), height / 2, "stroke-width=\"3\" stroke-opacity=\"0.55\"");
  svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{}\" r=\"4\" fill=\"currentColor\"/></svg>", x(value), height / 2);
  return svg;
}

std::string table(const char* heading, const std::string& head, const std::string& rows, const std::string& caption) {
  if (rows.empty()) return {};
  return fmt::format(
      "<h2>{}</h2>\n<div class=\"scroll\"><table><thead><tr>{}</tr></thead><tbody>\n{}</tbody></table></div>\n<p "
      "class=\"where\">{}</p>\n",
      heading, head, rows, caption);
}

std::string probabilities(const Json& campaign) {
  std::string rows;
  for (const auto& row : entries(campaign, "probabilities")) {
    const double p = number_at(row, {"probability"}), open = number_at(row, {"within_the_band"}),
                 without = number_at(row, {"without"});
    const auto band = band_at(row, "band");
    const double answered = number_at(row, {"yes"}) + number_at(row, {"no"}) + open;
    rows += fmt::format(
        "<tr><td><b>{}</b></td><td class=\"text\">{}</td><td>{} of {}</td><td>{}</td><td>{}</td><td><b>{:.1f} "
        "%</b></td><td>{:.1f} to {:.1f} "
        "%</td><td>{}</td></tr>\n",
        html_escaped(text_at(row, "limit")), at_text(row), count_text(number_at(row, {"yes"})), count_text(answered),
        count_text(open), count_text(without), 100 * p, 100 * band.first, 100 * band.second, bar(p, band, 0, 1, 0));
  }
  const bool chosen = campaign.contains("envelope");
  return table("How often a limit is passed",
               "<th>limit</th><th class=\"text\">runs</th><th>yes</th><th>open</th><th>no "
               "answer</th><th>probability</th><th>band "
               "of 95 %</th><th class=\"text\"></th>",
               rows,
               "The band (Wilson 1927) is that of chance: so many runs say no more. Runs whose own band leaves the "
               "answer open count as no at its "
               "lower end and as yes at its upper one. Runs without an answer broke down; they are in neither." +
                   std::string(chosen ? " Runs were chosen near the envelope's line: shares of all of them are not "
                                        "those of all cases."
                                      : ""));
}

std::string statistics(const Json& campaign) {
  std::string rows;
  std::vector<std::string> quantities;  // each with all its groups
  for (const auto& row : entries(campaign, "statistics"))
    if (const auto name = text_at(row, "quantity"); std::ranges::find(quantities, name) == quantities.end())
      quantities.push_back(name);
  std::vector<const Json*> sorted;
  for (const auto& name : quantities)
    for (const auto& row : entries(campaign, "statistics"))
      if (text_at(row, "quantity") == name) sorted.push_back(&row);
  for (const auto* entry : sorted) {
    const auto& row = *entry;
    const auto mean_band = band_at(row, "mean_band"), median_band = band_at(row, "median_band");
    const auto number = [&](const char* name) { return digits(number_at(row, {name})); };
    const auto half = [](std::pair<double, double> band) {
      return std::isfinite(band.first) ? " ± " + digits((band.second - band.first) / 2, 2) : std::string();
    };
    const double split = number_at(row, {"split"});
    rows += fmt::format(
        "<tr><td><b>{}</b></td><td "
        "class=\"text\">{}</td><td>{}</td><td>{}</td><td>{}{}</td><td>{}</td><td>{}{}</td><td>{} to {}</td><td>{} to "
        "{}</td><td class=\"text\">{}</td></tr>\n",
        html_escaped(text_at(row, "quantity")), at_text(row), count_text(number_at(row, {"runs"})),
        count_text(number_at(row, {"without"})), number("mean"), half(mean_band), number("deviation"), number("median"),
        std::isfinite(median_band.first)
            ? fmt::format(" ({} to {})", digits(median_band.first, 3), digits(median_band.second, 3))
            : "",
        number("share_5"), number("share_95"), number("least"), number("most"),
        std::isfinite(split) ? "two modes, apart at " + digits(split, 3) : "");
  }
  return table(
      "Statistics",
      "<th>quantity</th><th "
      "class=\"text\">runs</th><th>number</th><th>without</th><th>mean</th><th>deviation</th><th>median</th><th>90 "
      "% of runs</th><th>all</th><th class=\"text\"></th>",
      rows,
      "Bands of 95 %: of the mean by Student's t, of the median between two of the runs. A quantity of two modes has "
      "no mean worth telling: "
      "look at what the runs of each have in common.");
}

std::string effects(const Json& campaign) {
  std::string html;
  std::vector<std::string> quantities;
  for (const auto& row : entries(campaign, "effects"))
    if (const auto name = text_at(row, "quantity"); std::ranges::find(quantities, name) == quantities.end())
      quantities.push_back(name);
  for (const auto& quantity : quantities) {
    std::string rows;
    double most = 0;
    for (const auto& row : entries(campaign, "effects")) {
      if (text_at(row, "quantity") != quantity) continue;
      const auto band = band_at(row, "band");
      for (const double end : {number_at(row, {"value"}), band.first, band.second})
        if (std::isfinite(end)) most = std::max(most, std::abs(end));
    }
    for (const auto& row : entries(campaign, "effects")) {
      if (text_at(row, "quantity") != quantity) continue;
      const auto band = band_at(row, "band");
      const double value = number_at(row, {"value"});
      const bool clear = std::isfinite(band.first) && band.first * band.second > 0;
      rows +=
          fmt::format("<tr><td>{0}{1}{2}</td><td>{3}</td><td>{4}</td><td>{5}</td><td class=\"text\">{6}</td></tr>\n",
                      clear ? "<b>" : "", html_escaped(text_at(row, "effect")), clear ? "</b>" : "", digits(value, 3),
                      std::isfinite(band.first) ? digits(band.first, 3) + " to " + digits(band.second, 3) : "–",
                      bar(value, band, -most, most, 0), html_escaped(text_at(row, "aliases")));
    }
    html += table(("Effects on " + html_escaped(quantity)).c_str(),
                  "<th>effect</th><th>change</th><th>band of 95 %</th><th class=\"text\"></th><th class=\"text\">not "
                  "told apart from</th>",
                  rows,
                  "Mean at the second value less mean at the first; of a pair, half of what one changes of the other's "
                  "effect. Bold: other than zero.");
  }
  return html;
}

std::string indices(const Json& campaign) {
  std::string rows;
  for (const auto& row : entries(campaign, "sobol_indices")) {
    const auto first = band_at(row, "first_band"), total = band_at(row, "total_band");
    rows += fmt::format(
        "<tr><td><b>{}</b></td><td class=\"text\">{}</td><td>{}</td><td>{:.2f} ({:.2f} to "
        "{:.2f})</td><td>{}</td><td>{:.2f} ({:.2f} to "
        "{:.2f})</td><td>{}</td></tr>\n",
        html_escaped(text_at(row, "quantity")), at_text(row), html_escaped(text_at(row, "axis")),
        number_at(row, {"first"}), first.first, first.second, bar(number_at(row, {"first"}), first, 0, 1, 0),
        number_at(row, {"total"}), total.first, total.second, bar(number_at(row, {"total"}), total, 0, 1, 0));
  }
  return table(
      "Where the scatter comes from",
      "<th>quantity</th><th class=\"text\">runs</th><th>axis</th><th>first</th><th></th><th>total</th><th></th>", rows,
      "Sobol indices, shares of the variance. First: what would go if this axis alone were known. Total: what would "
      "stay if it alone were not. "
      "Bands of 95 % by resampling.");
}

std::string fraction(const Json& campaign) {
  if (!campaign.contains("fraction")) return {};
  std::string words;
  for (const auto& word : entries(campaign["fraction"], "words"))
    words += " = " + html_escaped(word.get<std::string>());
  return fmt::format("<p>A fraction of all combinations, of resolution {}: 1{}.</p>\n",
                     html_escaped(text_at(campaign["fraction"], "resolution")), words);
}

}  // namespace

std::string campaign_section(const Json& study) {
  if (!study.contains("campaign") || !study["campaign"].is_object()) return {};
  const auto& campaign = study["campaign"];
  return probabilities(campaign) + envelopes(campaign) + statistics(campaign) + distributions(study) +
         fraction(campaign) + effects(campaign) + indices(campaign);
}

}  // namespace splashdown::apps
