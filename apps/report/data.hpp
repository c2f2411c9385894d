// A run's files, read back for its report.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace splashdown::apps {

/// Columns of numbers; text reads as nan.
struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;

  bool empty() const { return columns.empty() || columns.front().empty(); }
  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  /// Empty if there is no such column.
  const std::vector<double>& operator[](const std::string& name) const;
};

using NamedTables = std::vector<std::pair<std::string, Table>>;  ///< in order of first appearance

/// Reads a csv file, split by the text in `group_column` (empty: one table named ""). No file: no tables.
NamedTables read_csv(const std::filesystem::path& path, const std::string& group_column = {});

std::string read_text(const std::filesystem::path& path);             ///< all bytes; nothing if there is no file
nlohmann::ordered_json read_json(const std::filesystem::path& path);  ///< throws if it is not JSON

struct RunData {
  std::filesystem::path directory;
  nlohmann::ordered_json summary;  ///< null if the run left none
  NamedTables bodies, probes, surface_pressure, section_loads;
  Table fluid, passes;

  /// " / Pa", " / m" ...; nothing if the scene does not say what the probe is.
  std::string unit_of_probe(const std::string& name) const;
  std::map<std::string, std::string> record_kinds;  ///< of the scene, by name

  int dimension() const;
  double end_time() const;
};

/// The plane x_axis = at [m] of a scene of which one half was simulated, that of larger coordinates.
struct MirrorPlane {
  int axis = 0;  ///< 0: x, 1: y
  double at = 0;
};
/// From scene.resolved.toml; nothing if the whole was simulated.
std::optional<MirrorPlane> mirror_plane(const std::filesystem::path& run);

RunData read_run(const std::filesystem::path& directory);

}  // namespace splashdown::apps
