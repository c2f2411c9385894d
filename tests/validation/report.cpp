#include "tests/validation/report.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace splashdown::validation {

namespace {

constexpr const char* header = "example,check,run,measured,expected,allowed,unit,verdict,why\n";
constexpr std::size_t fields = 9;

std::string word_of(const Verdict& verdict) {
  if (!verdict.error.empty()) return "error";
  if (!verdict.judged) return "reported";
  return verdict.passed ? "pass" : "FAIL";
}

/// Rows are split at commas and lines when they are read back.
std::string as_cell(std::string text) {
  std::replace(text.begin(), text.end(), ',', ';');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::vector<std::vector<std::string>> read_rows(const std::filesystem::path& csv) {
  std::ifstream in(csv);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot be read", csv.string()));
  std::vector<std::vector<std::string>> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::vector<std::string> row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    row.resize(fields);
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Of the rows in the file, and of the old table's for examples that have none there.
std::string page_table(const std::filesystem::path& csv, const std::string& old_table) {
  std::map<std::string, std::map<std::string, std::vector<std::string>>> newest;  // example, check
  std::map<std::string, std::vector<std::string>> order;                          // checks of an example
  for (auto& row : read_rows(csv)) {
    auto& slot = newest[row[0]][row[1]];
    if (slot.empty()) order[row[0]].push_back(row[1]);
    slot = row;
  }
  std::map<std::string, std::string> rows;  // of an example
  for (const auto& [example, checks] : order)
    for (const auto& check : checks) {
      const auto& row = newest[example][check];
      rows[example] += fmt::format("| [{0}](../examples/{0}/README.md) | {1} | {2} | {3} | {4} | {5} | {6} | {7} |\n",
                                   row[0], row[1], row[3], row[4], row[5], row[6], row[7], row[8]);
    }
  static const std::string before = "| [";
  std::istringstream old(old_table);
  for (std::string line; std::getline(old, line);) {
    const auto end = line.find(']');
    if (!line.starts_with(before) || end == std::string::npos) continue;
    const auto example = line.substr(before.size(), end - before.size());
    if (!order.contains(example)) rows[example] += line + "\n";
  }
  std::string text = "| example | check | measured | expected | allowed | unit | verdict | why |\n";
  text += "|---|---|---|---|---|---|---|---|\n";
  for (const auto& [example, lines] : rows) text += lines;
  return text;
}

}  // namespace

std::string line_of(const Verdict& verdict) {
  std::string line = fmt::format("{:<34} measured {:>12.6g}  expected {:>12}  allowed {:>8}  [{}]  {}", verdict.check,
                                 verdict.measured, verdict.expected, verdict.allowed, verdict.unit, word_of(verdict));
  if (!verdict.error.empty()) line += "\n  " + verdict.error;
  return line;
}

void append_row(const std::filesystem::path& csv, const Verdict& verdict) {
  const int file = ::open(csv.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  if (file < 0) throw std::runtime_error(fmt::format("{}: cannot be written", csv.string()));
  ::flock(file, LOCK_EX);
  std::string text = ::lseek(file, 0, SEEK_END) == 0 ? header : "";
  text += fmt::format("{},{},{},{:.6g},{},{},{},{},{}\n", verdict.example, verdict.check, verdict.run, verdict.measured,
                      as_cell(verdict.expected), as_cell(verdict.allowed), as_cell(verdict.unit), word_of(verdict),
                      as_cell(verdict.why));
  const auto written = ::write(file, text.data(), text.size());
  ::close(file);  // releases the lock
  if (written != static_cast<ssize_t>(text.size()))
    throw std::runtime_error(fmt::format("{}: cannot be written", csv.string()));
}

void write_page(const std::filesystem::path& csv, const std::filesystem::path& page) {
  static const std::string begin = "<!-- validation table: begin -->\n";
  static const std::string end = "<!-- validation table: end -->";
  std::ostringstream content;
  content << std::ifstream(page).rdbuf();
  std::string text = content.str();
  const auto from = text.find(begin), to = text.find(end);
  if (from == std::string::npos || to == std::string::npos)
    throw std::runtime_error(fmt::format("{}: the markers of the validation table are missing", page.string()));
  const auto first = from + begin.size();
  text.replace(first, to - first, page_table(csv, text.substr(first, to - first)));
  std::ofstream(page) << text;
}

}  // namespace splashdown::validation
