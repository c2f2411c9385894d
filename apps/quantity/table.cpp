#include "apps/quantity/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace splashdown::quantity {

namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t start = 0;;) {
    const auto comma = line.find(',', start);
    cells.push_back(trimmed(line.substr(start, comma - start)));
    if (comma == std::string_view::npos) return cells;
    start = comma + 1;
  }
}

double number_or_nan(std::string_view cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool whole = error == std::errc() && end == cell.data() + cell.size();
  return whole ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

const std::vector<double>* Table::find(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? nullptr : &columns[static_cast<std::size_t>(found - names.begin())];
}

Table read_table(const std::filesystem::path& folder, const std::string& file_and_key) {
  const auto colon = file_and_key.find(':');
  const auto path = folder / file_and_key.substr(0, colon);
  const std::string key = colon == std::string::npos ? "" : file_and_key.substr(colon + 1);

  std::ifstream in(path);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot be read", path.string()));
  Table table;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (trimmed(line).empty() || line.front() == '#') continue;
    const auto cells = cells_of(line);
    if (table.names.empty()) {
      table.names.assign(cells.begin(), cells.end());
      table.columns.resize(cells.size());
      continue;
    }
    if (cells.size() != table.names.size())
      throw std::runtime_error(fmt::format("{}:{}: {} cells under {} column names", path.string(), number, cells.size(),
                                           table.names.size()));
    if (!key.empty() && std::find(cells.begin(), cells.end(), key) == cells.end()) continue;
    for (std::size_t i = 0; i < cells.size(); ++i) table.columns[i].push_back(number_or_nan(cells[i]));
  }
  if (table.names.empty()) throw std::runtime_error(fmt::format("{}: holds no table", path.string()));
  if (!key.empty() && table.rows() == 0)
    throw std::runtime_error(fmt::format("{}: no row has a cell '{}'", path.string(), key));
  return table;
}

Table select_rows(const Table& table, const std::vector<double>& mask) {
  Table selected{table.names, std::vector<std::vector<double>>(table.columns.size())};
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (mask[row] == 0) continue;
    for (std::size_t i = 0; i < table.columns.size(); ++i) selected.columns[i].push_back(table.columns[i][row]);
  }
  return selected;
}

}  // namespace splashdown::quantity
