#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "apps/effects/elastic/elastic.hpp"
#include "apps/files/run_files.hpp"
#include "apps/quantity/expression.hpp"
#include "apps/quantity/names.hpp"
#include "apps/record/passes.hpp"
#include "apps/record/sections/section_loads.hpp"
#include "apps/record/sections/velocity_lines.hpp"
#include "apps/record/tables/rows.hpp"
#include "apps/scene/read/echo.hpp"
#include "apps/statistics/attitude.hpp"
#include "apps/statistics/filters.hpp"
#include "apps/statistics/summary.hpp"
#include "apps/study/study.hpp"
#include "apps/study/table.hpp"

namespace splashdown::apps {
namespace {

using Names = std::vector<std::string>;

PulseSummary all_classes() {
  PulseSummary pulse;
  pulse.raw.time = 0;
  for (const int cfc : channel_frequency_classes) pulse.cfc[cfc].time = 0;
  return pulse;
}

PulseGrades all_grades() {
  PulseGrades grades;
  grades.raw.emplace().evidence = {0, 0, 0, 0, 0, 0};
  for (const int cfc : channel_frequency_classes) grades.cfc[cfc] = *grades.raw;
  return grades;
}

BodySummary whole_body(const Scene& scene, std::size_t index) {
  BodySummary body;
  const auto d = static_cast<std::size_t>(scene.dimension);
  body.acceleration = body.force = all_classes();
  body.acceleration_grades = body.force_grades = all_grades();
  body.impulse = body.impulse_repair = std::vector<double>(d, 1.);
  body.submergence.time = body.wetted.time = body.landing.maximum_tilt.time = 0;
  for (std::size_t k = 0; k < attitude_names.size(); ++k)
    if (d == 3 || k == 1) body.landing.attitude.emplace_back(attitude_names[k], AngleSummary{0, {0, 0}, {0, 0}});
  body.landing.first_contact = body.landing.capsized_since = body.landing.settled = 0;
  if (deforms(scene, index)) {
    body.stress = StressSummary{.peak = {0, 0}, .point = std::vector<double>(d), .evidence = {}, .grade = {}};
    body.stress->grade.emplace().evidence.stress = 0;
  }
  for (const auto& record : scene.records)
    if (const auto* highest = std::get_if<MaximumPressureEntry>(&record); highest && highest->body == index)
      body.maximum_pressure_grade.emplace(),
          body.maximum_pressure = MaximumPressure{.peak = {0, 0}, .point = std::vector<double>(d), .evidence = {}};
  return body;
}

/// summary.json of a run of this scene in which everything happens that can.
nlohmann::json fullest_summary(const Scene& scene) {
  Summary summary;
  summary.dimension = scene.dimension;
  if (scene.has_fluid()) {
    summary.nodes = summary.elements = RangeCount{};
    summary.ledger.emplace().volume_error_bodies = 0;
    summary.ledger->energy_gain_time = summary.ledger->energy_gain_since = 0;
    summary.fluid.emplace();
  }
  if (scene.coupling) summary.coupling.emplace();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) summary.bodies[scene.bodies[i].name] = whole_body(scene, i);
  for (const auto& record : scene.records) {
    if (const auto* point = std::get_if<AccelerationEntry>(&record))
      summary.equipment[point->name] = {all_classes(), {}, all_grades()};
    if (const auto* point = std::get_if<PressureEntry>(&record)) {
      summary.probes[point->name].pressure.time = 0;
      if (point->body) summary.probes[point->name].grade.emplace().evidence = {0, 0, 0, 0, 0, 0};
    }
    if (const auto* patch = std::get_if<PatchEntry>(&record)) {
      summary.patches[patch->name].pressure.time = 0;
      summary.patches[patch->name].grade.emplace().evidence = {0, 0, 0, 0, 0, 0};
    }
  }
  for (const auto& limit : scene.limits)
    summary.limits.push_back({.name = limit.name, .quantity = {}, .unit = {}, .answer = {}, .reason = {}});
  return nlohmann::json::parse(to_json(summary));
}

/// Entries that only the run can name.
bool only_the_run_knows(const std::string& path) {
  for (const char* start : {"phases.", "effects.", "rejected_causes.", "coupling.rejected_causes."})
    if (path.starts_with(start)) return true;
  return path.find(".dry_intervals.") != std::string::npos;
}

/// What is wrong with the path, with the nearest word where it goes astray; empty: nothing.
std::string astray(const nlohmann::json& root, const std::string& path) {
  const nlohmann::json* node = &root;
  std::istringstream words(path);
  std::string so_far = "summary";
  for (std::string word; std::getline(words, word, '.');) {
    Names valid;
    if (node->is_object())
      for (const auto& [name, value] : node->items()) valid.push_back(name);
    else if (node->is_array())
      for (std::size_t i = 0; i < node->size(); ++i) valid.push_back(fmt::format("{}", i));
    if (std::ranges::find(valid, word) == valid.end()) {
      const auto near = nearest(word, valid);
      return fmt::format("runs of this scene have no '{}.{}'. {}", so_far, word,
                         !near.empty()   ? "Did you mean '" + near + "'?"
                         : valid.empty() ? so_far + " is a single value."
                                         : "There is " + listing(valid) + ".");
    }
    node = node->is_object() ? &node->at(word) : &node->at(static_cast<std::size_t>(std::stoul(word)));
    so_far += "." + word;
  }
  if (node->is_object() || node->is_array()) {
    Names valid;
    if (node->is_object())
      for (const auto& [name, value] : node->items()) valid.push_back(name);
    return fmt::format("'{}' is no number. {}", so_far,
                       valid.empty() ? "Use one of its entries, e.g. " + so_far + ".0."
                                     : "Use one of its entries: " + listing(valid) + ".");
  }
  if (node->is_string()) return fmt::format("'{}' is a text. Use an entry that is a number.", so_far);
  return {};
}

Names split(const std::string& header) {
  Names names;
  std::istringstream words(header);
  for (std::string word; std::getline(words, word, ',');) names.push_back(word);
  return names;
}

/// Columns of a file of the run's folder; nothing if it may have others.
std::optional<Names> columns_of(const std::string& table, const Scene& scene) {
  const auto file = table.substr(0, table.find(':'));
  if (file == "bodies.csv") return split(bodies_header);
  if (file == "probes.csv") return split(probes_header);
  if (file == "surface_pressure.csv") return split(surface_pressure_header(scene.dimension));
  if (file == "added_mass.csv") return split(added_mass_header(scene.dimension));
  if (file == "section_loads.csv") return split(section_loads_header);
  if (file == "velocity_lines.csv") return split(velocity_lines_header);
  if (file == "passes.csv") return split(passes_header);
  if (file == "elastic.csv") return split(elastic_header);
  const bool effects = !scene.effects.empty();  // have columns of their own
  if (file == "fluid.csv" && !effects) return split(fluid_header({}));
  return {};
}

/// Where an expression stands.
struct Origin {
  const char* table;  ///< quantity or limit
  std::string name;
  Place place;
};

class Checker {
 public:
  Checker(const Study& study, const Scene& scene, Problems& problems)
      : study_(study), scene_(scene), problems_(problems), summary_(fullest_summary(scene)) {
    known_ = number_columns();
    for (const auto& axis : study.axes) known_.push_back(axis.name);
    for (const auto& [name, value] : study.constants) known_.push_back(name);
  }

  void check(const StudyQuantity& quantity) {
    const Origin origin{"quantity", quantity.name, quantity.place};
    check_file(quantity, origin);
    check_body(quantity, origin);
    std::optional<Names> columns = Names{};
    if (!quantity.table.empty()) columns = columns_of(quantity.table, scene_);
    check_names(origin, "where", quantity.where, columns);
    check_names(origin, "quantity", quantity.quantity, columns);
    known_.push_back(quantity.name);
    check_names(origin, "exact", quantity.exact.value_or(""), columns);
    check_names(origin, "scale", quantity.scale, columns);
    if (quantity.has_error()) known_.push_back(quantity.error_name());
  }

  void check(const StudyLimit& limit) {
    if (std::ranges::find(scene_.limits, limit.name, &Limit::name) != scene_.limits.end())
      problems_.add_at(limit.place,
                       fmt::format("limit.{}: the scene has a limit of this name. Use another name.", limit.name));
    check_names({"limit", limit.name, limit.place}, "quantity", limit.quantity, Names{});
  }

 private:
  void tell(const Origin& origin, const char* key, const std::string& value, const std::string& what) {
    problems_.add_at(origin.place,
                     fmt::format("{}.{}.{} = {}: {}", origin.table, origin.name, key, toml_text(value), what));
  }

  /// A file of the run's folder itself that no run writes.
  void check_file(const StudyQuantity& quantity, const Origin& origin) {
    const auto file = quantity.table.substr(0, quantity.table.find(':'));
    if (file.empty() || file.find('/') != std::string::npos || is_table(file)) return;
    const Names valid(run_tables().begin(), run_tables().end());
    const auto near = nearest(file, valid);
    tell(origin, "table", quantity.table,
         fmt::format("no run writes '{}'. {}", file,
                     near.empty() ? "There is " + listing(valid) + "." : "Did you mean '" + near + "'?"));
  }

  void check_body(const StudyQuantity& quantity, const Origin& origin) {
    const std::string start = "bodies.csv:";
    if (!quantity.table.starts_with(start)) return;
    const auto name = quantity.table.substr(start.size());
    Names bodies;
    for (const auto& body : scene_.bodies) bodies.push_back(body.name);
    if (std::ranges::find(bodies, name) != bodies.end()) return;
    const auto near = nearest(name, bodies);
    tell(origin, "table", quantity.table,
         fmt::format("no body is called '{}'. {}", name,
                     near.empty() ? "There is " + listing(bodies) + "." : "Did you mean '" + near + "'?"));
  }

  void check_names(const Origin& origin, const char* key, const std::string& expression,
                   const std::optional<Names>& columns) {
    if (expression.empty()) return;
    Names names;
    try {
      names = quantity::names_in(expression);
    } catch (const std::runtime_error&) {
      return;  // told when it was read
    }
    for (const auto& name : names) {
      if (const auto path = quantity::after("summary", name)) {
        if (only_the_run_knows(*path)) continue;
        if (const auto what = astray(summary_, *path); !what.empty()) tell(origin, key, expression, what);
        continue;
      }
      if (!columns || std::ranges::find(known_, name) != known_.end() ||
          std::ranges::find(*columns, name) != columns->end())
        continue;
      Names valid = known_;
      valid.insert(valid.end(), columns->begin(), columns->end());
      const auto near = nearest(name, valid);
      tell(origin, key, expression,
           fmt::format("unknown name '{}'. {}", name,
                       near.empty() ? "Valid here: " + listing(valid) + ", and summary.PATH, a number of the run's " +
                                          "summary.json."
                                    : "Did you mean '" + near + "'?"));
    }
  }

  const Study& study_;
  const Scene& scene_;
  Problems& problems_;
  nlohmann::json summary_;
  Names known_;
};

}  // namespace

void check_quantities(const Study& study, const Scene& scene, Problems& problems) {
  Checker checker(study, scene, problems);
  for (const auto& quantity : study.quantities) checker.check(quantity);
  for (const auto& limit : study.limits) checker.check(limit);
}

}  // namespace splashdown::apps
