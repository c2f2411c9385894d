#include "apps/report/price.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "apps/files/csv.hpp"
#include "apps/report/data.hpp"
#include "apps/report/page.hpp"
#include "apps/statistics/verdict/share.hpp"
#include "apps/statistics/verdict/statements.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string cell(double value, int count = 4) {
  return "<td>" + (std::isfinite(value) ? digits(value, count) : std::string("–")) + "</td>";
}

std::string seconds_cell(double seconds) {
  return "<td>" + (std::isfinite(seconds) ? seconds_text(seconds) : std::string("–")) + "</td>";
}

std::string escaped_at(const Json& json, const char* key) { return html_escaped(json.value(key, "")); }

std::string table(const std::string& title, const std::vector<std::string>& heads, const std::string& rows) {
  std::string html = "<h2>" + title + "</h2>\n<div class=\"scroll\"><table><thead><tr>";
  for (const auto& head : heads) html += "<th>" + head + "</th>";
  return html + "</tr></thead><tbody>\n" + rows + "</tbody></table></div>\n";
}

/// Of a row with a price; lists of earlier versions know of what is beyond the finest mesh alone.
std::string source_of(const Json& row) {
  return row.contains("from") ? escaped_at(row, "from") : row.at("extrapolated").get<bool>() ? "extrapolated" : "";
}

/// How many runs a row takes, where it is the mean of several.
std::string runs_of(const Json& row) {
  const int runs = row.value("runs", 1);
  if (runs < 2) return {};
  auto text = fmt::format("mean of {} runs", runs);
  for (const auto& other : row.value("beside", Json::array()))
    text += fmt::format(", {} more at {}", other.at("runs").get<int>(), digits(number_at(other, {"refine"}), 3));
  return text + "; ";
}

std::string rows_table(const Json& price) {
  std::string rows;
  for (const auto& row : price.at("rows"))
    rows += fmt::format("<tr><td><b>{:g} %</b></td>{}{}<td>{}</td><td class=\"text\">{}</td></tr>\n",
                        number_at(row, {"accuracy_percent"}), seconds_cell(number_at(row, {"seconds"})),
                        cell(number_at(row, {"refine"}), 3), escaped_at(row, "decided_by"),
                        row.at("seconds").is_null() ? "not by refinement alone" : runs_of(row) + source_of(row));
  return table("What accuracy costs", {"accuracy", "wall time", "refine", "decided by", ""}, rows);
}

std::string quantities_table(const Json& price) {
  std::string rows;
  for (const auto& [name, q] : price.at("quantities").items()) {
    const double value = number_at(q, {"value"}), band = number_at(q, {"band"});
    const auto ratio = ratio_of(band, value);
    rows += fmt::format("<tr><td><b>{}</b></td>{}<td>{}</td>{}<td>{}</td>{}{}{}<td class=\"text\">{}{}</td></tr>\n",
                        html_escaped(name), cell(value), escaped_at(q, "unit"), cell(band, 2),
                        ratio ? band_mark(*ratio, "") : "–", cell(number_at(q, {"order"}), 2),
                        cell(number_at(q, {"richardson"})), cell(number_at(q, {"scatter"}), 2),
                        q.at("counts").get<bool>() ? "" : "not counted; ", escaped_at(q, "refused"));
  }
  return table("Quantities",
               {"quantity", "finest mesh", "unit", "band ±", "of the value", "order", "Richardson", "scatter", ""},
               rows);
}

/// What each accuracy takes for each quantity by itself: the first of its rows that is as good.
std::string prices_table(const Json& price) {
  std::set<double, std::greater<>> listed;
  for (const auto& q : price.at("quantities"))
    for (const auto& row : q.value("rows", Json::array())) listed.insert(number_at(row, {"accuracy_percent"}));
  std::vector<std::string> heads = {"quantity"};
  for (const double percent : listed) heads.push_back(fmt::format("{:g} %", percent));
  std::string rows;
  for (const auto& [name, q] : price.at("quantities").items()) {
    const auto& own = q.value("rows", Json::array());
    if (own.empty()) continue;
    rows += fmt::format("<tr><td><b>{}</b></td>", html_escaped(name));
    for (const double percent : listed) {
      const auto row = std::ranges::find_if(own, [&](const Json& other) {
        return number_at(other, {"accuracy_percent"}) <= percent && !other.at("seconds").is_null();
      });
      rows += row == own.end() ? cell(NAN)
                               : fmt::format("<td>{}{}</td>", seconds_text(number_at(*row, {"seconds"})),
                                             row->at("extrapolated").get<bool>() ? "*"
                                             : row->value("runs", 1) > 1         ? "+"
                                                                                 : "");
    }
    rows += "</tr>\n";
  }
  if (rows.empty()) return {};
  return table("What each quantity costs by itself", heads, rows) +
         "<p>* extrapolated beyond the finest mesh; + mean of several runs</p>\n";
}

std::string means_table(const Json& price) {
  std::string rows;
  for (const auto& [name, q] : price.at("quantities").items())
    for (const auto& mean : q.value("means", Json::array())) {
      const double value = number_at(mean, {"value"}), band = number_at(mean, {"band"});
      const auto ratio = ratio_of(band, value);
      rows += fmt::format("<tr><td><b>{}</b></td>{}<td>{}</td>{}<td>{}</td>{}<td>{}</td>{}</tr>\n", html_escaped(name),
                          cell(value), escaped_at(q, "unit"), cell(band, 2), ratio ? band_mark(*ratio, "") : "–",
                          cell(number_at(mean, {"deviation"}), 2), count_text(number_at(mean, {"runs"})),
                          cell(number_at(mean, {"refine"}), 3));
    }
  if (rows.empty()) return {};
  return table("Means of runs on meshes of one size",
               {"quantity", "mean", "unit", "band ±", "of the mean", "scatter of one run", "runs", "refine"}, rows);
}

std::string runs_table(const fs::path& directory, const Json& price) {
  std::string rows;
  for (const auto& run : price.at("runs")) {
    const auto folder = escaped_at(run, "folder");
    const bool page = fs::exists(directory / run.value("folder", "") / "report.html");
    rows += fmt::format("<tr><td>{}</td>{}{}{}{}<td class=\"text\">{}</td></tr>\n",
                        page ? fmt::format("<a href=\"{0}/report.html\">{0}</a>", folder) : folder,
                        cell(number_at(run, {"refine"})), seconds_cell(number_at(run, {"seconds"})),
                        cell(number_at(run, {"node_steps"}), 3), cell(number_at(run, {"memory_mb"}), 3),
                        escaped_at(run, "role"));
  }
  return table("Runs", {"run", "refine", "wall time", "node-steps", "memory (MB)", ""}, rows);
}

Banner banner_of(const Json& price) {
  Banner banner{Mood::good, "What accuracy costs", {}};
  std::string line;
  for (const auto& row : price.at("rows"))
    if (row.at("seconds").is_number())
      line += fmt::format("{}<b>{:g} %</b>: {}{}", line.empty() ? "" : "; ", number_at(row, {"accuracy_percent"}),
                          seconds_text(number_at(row, {"seconds"})),
                          row.value("runs", 1) > 1             ? fmt::format(", {} runs", row.at("runs").get<int>())
                          : row.at("extrapolated").get<bool>() ? ", extrapolated"
                                                               : "");
  if (price.at("rows").empty())
    banner = {Mood::fair, "Too few meshes for a price", {"Three meshes are needed at least."}};
  else if (line.empty())
    banner = {Mood::fair,
              "No accuracy of all quantities together is in reach",
              {fmt::format("<b>{}</b> asks for more than elements four times smaller. What each quantity costs by "
                           "itself stands below.",
                           escaped_at(price.at("rows").front(), "decided_by"))}};
  else
    banner.sentences.push_back(line + ".");
  const double asked = number_at(price, {"asked_percent"});
  if (std::isfinite(asked) && !price.value("reached", false)) {
    banner.mood = std::max(banner.mood, Mood::fair);
    banner.sentences.push_back(fmt::format(
        "No mesh that was made has <b>{:g} %</b> in all that counts: what is said of it is extrapolated.", asked));
  }
  return banner;
}

}  // namespace

bool holds_price(const fs::path& directory) { return fs::exists(directory / "price.json"); }

ReportResult write_price_report(const fs::path& directory) {
  const auto price = read_json(directory / "price.json");
  ReportResult result{directory / "report.html", {}};
  try {
    const auto named = price.value("title", "");
    const auto title = named.empty() ? folder_name(directory) : named;
    std::string chart;
    if (fs::exists(directory / "price.svg"))
      chart = html_wide_figure(
          inline_svg(read_text(directory / "price.svg"), "price"),
          "Band of the quantities that count against the wall time of the run: thin lines one by one, thick the "
          "widest of them. Circles: meshes that no other one beats in both.");
    write_file_atomically(
        result.page,
        html_page(title, html_header(title, directory, banner_of(price), {}) + rows_table(price) + chart +
                             prices_table(price) + quantities_table(price) + means_table(price) +
                             runs_table(directory, price) +
                             "<footer>Made by Splashdown from <code>price.json</code> in this folder.</footer>\n"));
  } catch (const Json::exception& error) {
    throw std::runtime_error(
        fmt::format("{}: is not a price list ({})", (directory / "price.json").string(), error.what()));
  }
  return result;
}

}  // namespace splashdown::apps
