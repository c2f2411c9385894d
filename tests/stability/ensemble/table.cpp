#include "tests/stability/ensemble/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "tests/stability/ensemble/classes.hpp"

namespace splashdown::ensemble {

namespace {

constexpr std::size_t fewest_for_a_percentile = 20;  // of fewer not one may exceed what 95 of 100 keep

struct Row {
  std::string kind, seed, what, law, measured, bound, verdict, wall_seconds, note;
};

/// Rows are split at commas and lines when they are read back.
std::string as_cell(std::string text) {
  std::replace(text.begin(), text.end(), ',', ';');
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::replace(text.begin(), text.end(), '|', '/');
  return text;
}

std::vector<Row> read_rows(const std::filesystem::path& csv) {
  std::ifstream in(csv);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot be read", csv.string()));
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> place;
  std::vector<Row> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    Row row;
    for (std::string* cell : {&row.kind, &row.seed, &row.what, &row.law, &row.measured, &row.bound, &row.verdict,
                              &row.wall_seconds, &row.note})
      std::getline(cells, *cell, ',');
    const auto [slot, is_new] = place.try_emplace({row.kind, row.seed, row.law}, rows.size());
    if (is_new)
      rows.push_back(row);
    else
      rows[slot->second] = row;
  }
  return rows;
}

double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

std::uint64_t seed_of(const Row& row) { return std::strtoull(row.seed.c_str(), nullptr, 10); }

struct Group {
  std::string kind, law, bound;
  std::uint64_t seed = 0;  ///< of its first member
  std::vector<double> measured;
  std::size_t held = 0, fell = 0;
};

/// In the order of the classes, and of the laws as they are judged.
std::vector<Group> groups_of(const std::vector<Row>& rows) {
  std::vector<Group> groups;
  for (const Class& each : classes())
    for (const Row& row : rows) {
      if (row.kind != each.name) continue;
      auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
        return g.kind == row.kind && g.law == row.law && g.bound == row.bound;
      });
      if (group == groups.end())
        group = groups.insert(groups.end(), Group{row.kind, row.law, row.bound, seed_of(row), {}, 0, 0});
      group->measured.push_back(number(row.measured));
      (row.verdict == "fell" ? group->fell : group->held) += 1;
    }
  return groups;
}

/// The row of a bound that holds in 95 of 100 members, if the law has one.
std::string ninety_five(const Group& group) {
  if (group.law != "energy") return "";
  const auto law = generate(group.kind, group.seed).laws.energy;
  if (!law || law->in_most <= 0) return "";
  const double found = percentile_95(group.measured);
  return fmt::format("| {} | energy, 95 of 100 | {:g} | {} | | {:.3g} | {} | |\n", group.kind, law->in_most,
                     group.measured.size(), found, found <= law->in_most ? "yes" : "no");
}

std::string tables(const std::filesystem::path& csv) {
  const auto rows = read_rows(csv);
  std::string text = "| class | law | bound | members | worst | 95th percentile | held | fell |\n";
  text += "|---|---|---|---|---|---|---|---|\n";
  for (const Group& group : groups_of(rows)) {
    const double worst = *std::max_element(group.measured.begin(), group.measured.end(),
                                           [](double a, double b) { return std::isnan(b) ? !std::isnan(a) : a < b; });
    text += fmt::format("| {} | {} | {} | {} | {:.3g} | {:.3g} | {} | {} |\n", group.kind, group.law, group.bound,
                        group.measured.size(), worst, percentile_95(group.measured), group.held, group.fell);
    text += ninety_five(group);
  }
  std::map<std::pair<std::size_t, std::uint64_t>, std::vector<const Row*>> fallen;  // by class and seed
  for (const Row& row : rows)
    for (std::size_t i = 0; i < classes().size(); ++i)
      if (row.verdict == "fell" && row.kind == classes()[i].name) fallen[{i, seed_of(row)}].push_back(&row);
  text += fmt::format("\n### Members that fell: {}\n", fallen.size());
  if (fallen.empty()) return text + "\nNone.\n";
  text += "\n| class | seed | scene | laws broken | again with |\n|---|---|---|---|---|\n";
  for (const auto& [member, broken] : fallen) {
    std::string laws;
    for (const Row* row : broken)
      laws += fmt::format("{}{} {} (bound {})", laws.empty() ? "" : ", ", row->law, row->measured, row->bound);
    text += fmt::format("| {0} | {1} | {2} | {3} | `--class {0} --seeds {1}:{1}` |\n", broken.front()->kind,
                        member.second, broken.front()->what, laws);
  }
  return text;
}

}  // namespace

double percentile_95(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end(), [](double a, double b) { return std::isnan(b) ? !std::isnan(a) : a < b; });
  if (values.size() < fewest_for_a_percentile) return values.back();
  return values[static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(values.size()))) - 1];
}

void append_rows(const std::filesystem::path& csv, const Member& member, const Run& run, const Verdict& verdict) {
  std::ofstream out(csv, std::ios::app);
  if (out.tellp() == 0) out << "class,seed,what,law,measured,bound,verdict,wall_seconds,note\n";
  const auto row = [&](const Finding& f, const char* word) {
    out << fmt::format("{},{},{},{},{:.6g},{:g},{},{:.3g},{}\n", member.kind, member.seed, as_cell(member.what), f.law,
                       f.measured, f.bound, word, run.wall_seconds, as_cell(f.note));
  };
  if (verdict.refused) row({"refused with a cause", 0, 0, verdict.cause}, "held");
  for (const Finding& f : verdict.findings) row(f, f.held() ? "held" : "fell");
  if (!out) throw std::runtime_error(fmt::format("{}: cannot be written", csv.string()));
}

void write_page(const std::filesystem::path& csv, const std::filesystem::path& page) {
  static const std::string begin = "<!-- stability table: begin -->\n";
  static const std::string end = "<!-- stability table: end -->";
  std::ostringstream content;
  content << std::ifstream(page).rdbuf();
  std::string text = content.str();
  const auto from = text.find(begin), to = text.find(end);
  if (from == std::string::npos || to == std::string::npos)
    throw std::runtime_error(fmt::format("{}: the markers of the stability table are missing", page.string()));
  text.replace(from + begin.size(), to - from - begin.size(), tables(csv));
  std::ofstream(page) << text;
}

}  // namespace splashdown::ensemble
