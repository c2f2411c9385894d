// Comma separated tables: what a run leaves behind and the references it is compared with.
//
// Lines that start with '#' are comments, the first other line names the columns. A cell that is not a
// number reads as nan, so columns of names may stand beside columns of values.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace splashdown::quantity {

struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  ///< one vector a name, all of the same length

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  const std::vector<double>* find(const std::string& name) const;
};

/// Reads `file`, or with "file:key" only the rows in which one cell is exactly `key` (a body, a probe, a
/// series). Throws std::runtime_error that names file and line.
Table read_table(const std::filesystem::path& folder, const std::string& file_and_key);

/// The rows for which `mask` is not zero.
Table select_rows(const Table& table, const std::vector<double>& mask);

}  // namespace splashdown::quantity
