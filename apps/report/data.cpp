#include "apps/report/data.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace splashdown::apps {

namespace {

/// Splits a line at its commas; quotes as in RFC 4180, without line breaks inside.
void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  std::size_t begin = 0;
  bool quoted = false;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i < line.size() && (quoted || line[i] != ',')) continue;
    fields.push_back(line.substr(begin, i - begin));
    begin = i + 1;
  }
}

std::string unquoted(std::string_view field) {
  if (field.size() < 2 || field.front() != '"') return std::string(field);
  std::string text;
  for (std::size_t i = 1; i + 1 < field.size(); ++i) {
    text += field[i];
    if (field[i] == '"') ++i;
  }
  return text;
}

double number(std::string_view field) {
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  return error == std::errc() && end == field.data() + field.size() ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

nlohmann::ordered_json read_json(const std::filesystem::path& path) {
  auto json = nlohmann::ordered_json::parse(read_text(path), nullptr, false);
  if (json.is_discarded()) throw std::runtime_error(path.string() + ": is not JSON");
  return json;
}

const std::vector<double>& Table::operator[](const std::string& name) const {
  static const std::vector<double> none;
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? none : columns[static_cast<std::size_t>(found - names.begin())];
}

NamedTables read_csv(const std::filesystem::path& path, const std::string& group_column) {
  const std::string text = read_text(path);
  NamedTables tables;
  std::vector<std::string_view> fields;
  std::vector<std::string> names;
  std::size_t group = std::numeric_limits<std::size_t>::max();
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;  // a row that is still being written
    split(std::string_view(text).substr(begin, end - begin), fields);
    begin = end + 1;
    if (names.empty()) {
      names.assign(fields.begin(), fields.end());
      group = static_cast<std::size_t>(std::ranges::find(names, group_column) - names.begin());
      continue;
    }
    if (fields.size() != names.size()) continue;
    const std::string key = group < fields.size() ? unquoted(fields[group]) : std::string();
    auto table = std::ranges::find(tables, key, &NamedTables::value_type::first);
    if (table == tables.end())
      table = tables.insert(tables.end(), {key, Table{names, std::vector<std::vector<double>>(names.size())}});
    for (std::size_t k = 0; k < fields.size(); ++k) table->second.columns[k].push_back(number(fields[k]));
  }
  return tables;
}

int RunData::dimension() const { return summary.is_object() ? summary.value("dimension", 2) : 2; }

double RunData::end_time() const {
  double end = 0;
  for (const auto& [name, table] : bodies)
    if (!table.empty()) end = std::max(end, table["time"].back());
  if (!fluid.empty()) end = std::max(end, fluid["time"].back());
  return end;
}

namespace {

/// What stands behind `key = ` in a line of a resolved scene, without quotes.
std::string value_in(const std::string& line, const std::string& key) {
  const auto start = key + " = ";
  return line.starts_with(start) ? unquoted(line.substr(start.size())) : std::string();
}

/// Name and kind of the records: scene.resolved.toml is written by this program, a key a line.
std::map<std::string, std::string> read_record_kinds(const std::filesystem::path& scene) {
  std::map<std::string, std::string> kinds;
  std::ifstream in(scene);
  std::string name, kind;
  bool record = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("[")) {
      record = line == "[[record]]";
      name = kind = "";
    }
    if (!record) continue;
    if (auto value = value_in(line, "name"); !value.empty()) name = value;
    if (auto value = value_in(line, "kind"); !value.empty()) kind = value;
    if (!name.empty() && !kind.empty()) kinds[name] = kind;
  }
  return kinds;
}

}  // namespace

std::optional<MirrorPlane> mirror_plane(const std::filesystem::path& run) {
  std::ifstream in(run / "scene.resolved.toml");
  std::optional<MirrorPlane> plane;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("[")) inside = line == "[symmetry]";
    if (!inside) continue;
    if (!plane) plane.emplace();
    if (value_in(line, "normal") == "y") plane->axis = 1;
    if (const auto at = value_in(line, "at"); !at.empty()) plane->at = std::strtod(at.c_str(), nullptr);
  }
  return plane;
}

std::string RunData::unit_of_probe(const std::string& name) const {
  const auto kind = [&](const std::string& of) {
    const auto found = record_kinds.find(of);
    return found == record_kinds.end() ? std::string() : found->second;
  };
  if (kind(name).starts_with("pressure")) return " / Pa";
  if (kind(name) == "surface_elevation") return " / m";
  if (const auto dot = name.rfind('.'); dot != std::string::npos && kind(name.substr(0, dot)) == "acceleration")
    return " / (m/s²)";
  return {};
}

RunData read_run(const std::filesystem::path& directory) {
  RunData run;
  run.directory = directory;
  if (std::filesystem::exists(directory / "summary.json")) run.summary = read_json(directory / "summary.json");
  run.bodies = read_csv(directory / "bodies.csv", "body");
  run.probes = read_csv(directory / "probes.csv", "probe");
  run.record_kinds = read_record_kinds(directory / "scene.resolved.toml");
  run.section_loads = read_csv(directory / "section_loads.csv", "record");
  run.surface_pressure = read_csv(directory / "surface_pressure.csv", "body");
  for (const auto& [name, table] : {std::pair{"fluid.csv", &run.fluid}, {"passes.csv", &run.passes}})
    if (auto rows = read_csv(directory / name); !rows.empty()) *table = std::move(rows.front().second);
  if (run.summary.is_null() && run.bodies.empty() && run.fluid.empty())
    throw std::runtime_error(directory.string() +
                             ": holds neither a run (summary.json, bodies.csv or fluid.csv) nor a study (study.json)");
  return run;
}

}  // namespace splashdown::apps
