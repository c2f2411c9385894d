#include "apps/report/ablation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/files/csv.hpp"
#include "apps/report/data.hpp"
#include "apps/report/page.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string change_cell(const Json& change) {
  const double relative = number_at(change, {"change"}), band = number_at(change, {"band"});
  if (!std::isfinite(relative)) return "<td>–</td>";
  const bool strong = change.value("meaning", "") == "matters";
  return fmt::format("<td>{}{:+.3g} % ± {}{}</td>", strong ? "<b>" : "", 100 * relative,
                     std::isfinite(band) ? fmt::format("{:.2g} %", 100 * band) : "?", strong ? "</b>" : "");
}

std::string verdicts_table(const Json& variants) {
  std::string rows;
  for (const auto& variant : variants) {
    if (variant.value("kind", "") == "scene") continue;
    std::string set;
    for (const auto& argument : variant.at("set"))
      set += (set.empty() ? "" : " ") + html_escaped(argument.get<std::string>());
    const auto& agrees = variant.at("agrees");
    rows += fmt::format(
        "<tr><td><b>{}</b></td><td class=\"text\">{}</td><td class=\"text\">{}</td><td "
        "class=\"text\"><code>{}</code></td></tr>\n",
        html_escaped(text_at(variant, "variant")), html_escaped(text_at(variant, "line")),
        agrees.is_null()     ? ""
        : agrees.get<bool>() ? "yes"
                             : "no",
        set);
  }
  return "<h2>What each effect and choice does</h2>\n<div class=\"scroll\"><table><thead><tr><th>variant</th><th "
         "class=\"text\">what it does</th><th class=\"text\">as advised</th><th class=\"text\">made "
         "by</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>\n";
}

std::string changes_table(const Json& variants) {
  std::string head, body;
  for (const auto& variant : variants) head += "<th>" + html_escaped(text_at(variant, "variant")) + "</th>";
  const auto& scene = variants.at(0).at("changes");
  for (std::size_t q = 0; q < scene.size(); ++q) {
    const double own = number_at(scene[q], {"value"});
    body += fmt::format("<tr><td><b>{}</b>{}</td><td>{}</td>", html_escaped(text_at(scene[q], "quantity")),
                        scene[q].value("counts", false) ? "" : " (not counted)",
                        std::isfinite(own) ? digits_with_unit(own, text_at(scene[q], "unit")) : "–");
    for (std::size_t v = 1; v < variants.size(); ++v) body += change_cell(variants[v].at("changes").at(q));
    body += "</tr>\n";
  }
  body += "<tr><td><b>seconds</b></td>";
  for (const auto& variant : variants) {
    const double seconds = number_at(variant, {"seconds"});
    body += "<td>" + (std::isfinite(seconds) ? seconds_text(seconds) : std::string("–")) + "</td>";
  }
  return "<h2>Changes side by side</h2>\n<div class=\"scroll\"><table><thead><tr><th>quantity</th>" + head +
         "</tr></thead><tbody>\n" + body + "</tr>\n</tbody></table></div>\n";
}

Banner ablation_banner(const Json& variants) {
  Banner banner{Mood::good, "What each effect does to the numbers", {}};
  for (const auto& variant : variants) {
    if (const auto cause = text_at(variant, "cause"); !cause.empty())
      banner.mood = Mood::fair,
      banner.sentences.push_back(
          fmt::format("<b>{}</b> has no result: {}.", html_escaped(text_at(variant, "variant")), html_escaped(cause)));
    const auto& agrees = variant.at("agrees");
    if (agrees.is_boolean() && !agrees.get<bool>())
      banner.mood = Mood::fair, banner.sentences.push_back(fmt::format("<b>{}</b>: not what theory advised.",
                                                                       html_escaped(text_at(variant, "what"))));
  }
  if (banner.sentences.empty())
    banner.sentences.emplace_back("What theory advised and what the runs say agree, as far as both say something.");
  return banner;
}

}  // namespace

bool holds_ablation(const fs::path& directory) { return fs::exists(directory / "ablation.json"); }

ReportResult write_ablation_report(const fs::path& directory) {
  const auto ablation = read_json(directory / "ablation.json");
  ReportResult result{directory / "report.html", {}};
  try {
    const auto& variants = ablation.at("variants");
    const auto named = text_at(ablation, "title");
    const auto title = named.empty() ? folder_name(directory) : named;
    std::string chart;
    if (fs::exists(directory / "ablation.svg"))
      chart =
          html_wide_figure(inline_svg(read_text(directory / "ablation.svg"), "ablation"),
                           "Change of the numbers that count, with its band from three meshes of nearly the same size. "
                           "Effects: with against without. Changes in the shaded strip do not matter.");
    write_file_atomically(
        result.page,
        html_page(title, html_header(title, directory, ablation_banner(variants), {}) + verdicts_table(variants) +
                             chart + changes_table(variants) +
                             "<footer>Made by Splashdown from <code>ablation.json</code> in this folder.</footer>\n"));
  } catch (const Json::exception& error) {
    throw std::runtime_error(
        fmt::format("{}: is not an ablation ({})", (directory / "ablation.json").string(), error.what()));
  }
  return result;
}

}  // namespace splashdown::apps
