#include "apps/study/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>

#include "apps/files/csv.hpp"
#include "apps/quantity/expression.hpp"
#include "apps/quantity/names.hpp"
#include "apps/study/campaign/results.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;

/// Of a run's verdict, the worse the later.
constexpr std::array<std::string_view, 4> grade_names = {"resolved", "doubtful", "unresolved", "unphysical"};

/// Columns from summary.json.
const std::vector<std::pair<std::string, std::string>> from_summary = {
    {"passes_mean", "coupling.passes_mean"}, {"passes_max", "coupling.passes_max"},
    {"rejected_steps", "rejected_steps"},    {"steps", "steps"},
    {"simulated_time", "simulated_time"},    {"wall_seconds", "wall_seconds"}};

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Outcome::Status status_of(const std::string& status, const std::string& cause) {
  using enum Outcome::Status;
  if (status == "done") return converged;
  if (status != "failed") return interrupted;
  if (cause.starts_with("the coupling diverged")) return diverged;
  if (cause.starts_with("the coupling did not converge")) return stalled;
  return failed;
}

/// The grade; empty in summaries of earlier versions.
std::string verdict_of(const nlohmann::json& summary) {
  const auto found = summary.find("verdict");
  return found != summary.end() && found->is_object() ? found->value("grade", "") : "";
}

/// Why an entry that summaries have is missing in one.
std::string why_absent(const std::string& name) {
  if (name.find(".cfc") != std::string::npos)
    return name +
           ": the run has no such pulse: its steps are too long, or the run too short, for the filter. Use a smaller "
           "time.dt_max, or a class of a lower frequency";
  return name + ": has no value in this run: what it tells of did not happen";
}

/// Names in the expressions of one run.
quantity::Lookup names_of(const Study& study, const StudyRun& run, const Outcome& outcome,
                          const nlohmann::json& summary, const quantity::Table& table) {
  using quantity::Value;
  return [&](const std::string& name) -> std::optional<Value> {
    if (const auto path = quantity::after("summary", name)) {
      auto entry = quantity::find_entry(summary, *path);
      // It was checked before the runs that such an entry can be: this run has none.
      if (!entry) throw std::runtime_error(why_absent(name));
      return entry;
    }
    if (auto column = quantity::find_column(table, name)) return column;
    for (std::size_t a = 0; a < study.axes.size(); ++a)
      if (const auto& value = study.axes[a].values[run.value[a]]; study.axes[a].name == name && value.number)
        return Value::number(*value.number);
    if (const auto found = outcome.numbers.find(name); found != outcome.numbers.end())
      return Value::number(found->second);
    const auto found = study.constants.find(name);
    if (found == study.constants.end()) return std::nullopt;
    return Value::number(found->second);
  };
}

/// Deviation of one measured value from what it is held against.
double error_of(const StudyQuantity& quantity, double value, double reference, const quantity::Lookup& names) {
  const double scale = quantity.scale.empty() ? std::abs(reference) : quantity::evaluate_number(quantity.scale, names);
  if (!(std::abs(scale) > 0))
    throw std::runtime_error("has no error: what it is held against is zero. Give the quantity a scale");
  return std::abs(value - reference) / scale;
}

void measure_one(const Study& study, const StudyQuantity& quantity, const StudyRun& run, const fs::path& folder,
                 Outcome& outcome) {
  const auto summary = quantity::read_summary(folder);
  quantity::Table table;
  const auto names = names_of(study, run, outcome, summary, table);
  if (!quantity.table.empty()) table = quantity::read_table(folder, quantity.table);
  if (!quantity.where.empty()) table = quantity::rows_where(table, quantity.where, names);
  const double value = quantity::evaluate_number(quantity.quantity, names);
  outcome.numbers[quantity.name] = value;
  if (!quantity.exact) return;
  const double exact = quantity::evaluate_number(*quantity.exact, names);
  outcome.numbers[quantity.error_name()] = error_of(quantity, value, exact, names);
}

/// The error that refers to another run; nothing unless both have a value.
void compare_one(const Study& study, const StudyQuantity& quantity, const StudyRun& run, const Outcome& there,
                 Outcome& outcome) {
  const auto mine = std::as_const(outcome.numbers).find(quantity.name), other = there.numbers.find(quantity.name);
  if (mine == outcome.numbers.end() || other == there.numbers.end()) return;
  const nlohmann::json no_summary = nlohmann::json::object();
  const quantity::Table no_table;
  const auto names = names_of(study, run, outcome, no_summary, no_table);
  outcome.numbers[quantity.error_name()] = error_of(quantity, mine->second, other->second, names);
}

/// Answers the study's own question; throws where its number has no value.
void answer_one(const Study& study, const StudyLimit& limit, const StudyRun& run, const fs::path& folder,
                Outcome& outcome) {
  const auto summary = quantity::read_summary(folder);
  const quantity::Table no_table;
  const double value = quantity::evaluate_number(limit.quantity, names_of(study, run, outcome, summary, no_table));
  if (std::isnan(value)) throw std::runtime_error("has no value");
  outcome.limits[limit.name] = (limit.above ? value > limit.value : value < limit.value) ? "yes" : "no";
}

/// Coupling passes can agree on velocities that have nothing to do with the motion.
void judge(const StudyQuantity& quantity, Outcome& outcome) {
  const auto error = outcome.numbers.find(quantity.error_name());
  if (outcome.status != Outcome::Status::converged || !quantity.limit || error == outcome.numbers.end()) return;
  if (error->second <= *quantity.limit) return;  // nan is not
  outcome.status = Outcome::Status::diverged;
  outcome.cause = fmt::format("{} = {:.3g} exceeds {:g}", quantity.error_name(), error->second, *quantity.limit);
}

/// Those of numbers, in the order of study.csv.
std::vector<std::string> all_number_columns(const Study& study) {
  auto columns = number_columns();
  for (const auto& quantity : study.quantities) {
    columns.push_back(quantity.name);
    if (quantity.has_error()) columns.push_back(quantity.error_name());
  }
  return columns;
}

std::string csv_of(const Study& study, const std::vector<StudyRun>& runs, const std::vector<Outcome>& outcomes) {
  const auto numbers = all_number_columns(study), limits = limit_names(outcomes);
  std::string text = "run";
  const auto add = [&](const std::string& entry) { text.append(1, ',').append(csv_cell(entry)); };
  for (const auto& axis : study.axes) add(axis.name);
  add("status");
  add("verdict");
  for (const auto& name : numbers) add(name);
  for (const auto& name : limits) add("limit." + name);
  add("cause");
  text += '\n';
  for (std::size_t i = 0; i < runs.size(); ++i) {
    text += csv_cell(runs[i].name);
    for (std::size_t a = 0; a < study.axes.size(); ++a) add(study.axes[a].values[runs[i].value[a]].text);
    add(word(outcomes[i].status));
    add(outcomes[i].verdict);
    for (const auto& name : numbers) {
      const auto found = outcomes[i].numbers.find(name);
      add(found == outcomes[i].numbers.end() ? std::string() : fmt::format("{}", found->second));
    }
    for (const auto& name : limits) {
      const auto found = outcomes[i].limits.find(name);
      add(found == outcomes[i].limits.end() ? std::string() : found->second);
    }
    add(outcomes[i].cause);
    text += '\n';
  }
  return text;
}

nlohmann::ordered_json json_of(const Study& study, const std::vector<StudyRun>& runs,
                               const std::vector<Outcome>& outcomes) {
  nlohmann::ordered_json root;
  root["title"] = study.title;
  root["study"] = study.file.string();
  root["scene"] = study.scene.string();
  std::map<std::string, int> counts;
  for (const auto& outcome : outcomes) ++counts[word(outcome.status)];
  root["status"] = counts;
  for (const auto& quantity : study.quantities) root["units"][quantity.name] = quantity.unit;
  for (const auto& axis : study.axes) {
    auto& entry = root["axes"].emplace_back();
    entry["name"] = axis.name;
    entry["label"] = axis.label;
    if (axis.sampled) entry["random"] = true;
    if (axis.replicates) entry["replicates"] = true;
    for (const auto& value : axis.values) entry["values"].push_back(value.text);
  }
  for (const auto& name : all_number_columns(study))
    root["columns"].push_back({{"name", name}, {"label", column_label(study, name)}});
  for (std::size_t i = 0; i < runs.size(); ++i) {
    auto& entry = root["runs"].emplace_back();
    entry["run"] = runs[i].name;
    for (std::size_t a = 0; a < study.axes.size(); ++a) {
      const auto& value = study.axes[a].values[runs[i].value[a]];
      if (value.number)
        entry["axes"][study.axes[a].name] = *value.number;
      else
        entry["axes"][study.axes[a].name] = value.text;
    }
    entry["set"] = runs[i].set;
    entry["status"] = word(outcomes[i].status);
    if (!outcomes[i].verdict.empty()) entry["verdict"] = outcomes[i].verdict;
    if (!outcomes[i].cause.empty()) entry["cause"] = outcomes[i].cause;
    for (const auto& [name, number] : outcomes[i].numbers) entry["numbers"][name] = number;  // nan becomes null
    for (const auto& [name, answer] : outcomes[i].limits) entry["limits"][name] = answer;
  }
  return root;
}

}  // namespace

std::vector<std::string> limit_names(const std::vector<Outcome>& outcomes) {
  std::set<std::string> names;
  for (const auto& outcome : outcomes)
    for (const auto& [name, answer] : outcome.limits) names.insert(name);
  return {names.begin(), names.end()};
}

const char* word(Outcome::Status status) {
  switch (status) {
    case Outcome::Status::waiting:
      return "waiting";
    case Outcome::Status::interrupted:
      return "interrupted";
    case Outcome::Status::converged:
      return "converged";
    case Outcome::Status::diverged:
      return "diverged";
    case Outcome::Status::stalled:
      return "stalled";
    case Outcome::Status::failed:
      break;
  }
  return "failed";
}

std::string counts_text(const std::vector<Outcome>& outcomes) {
  const auto list = [](const auto& counts, const auto& name) {
    std::string text;
    for (const auto& [key, count] : counts) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name(key));
    return text;
  };
  std::map<Outcome::Status, std::map<std::size_t, int>> all;
  for (const auto& outcome : outcomes) {
    const auto grade = std::ranges::find(grade_names, outcome.verdict);
    ++all[outcome.status][static_cast<std::size_t>(grade - grade_names.begin())];
  }
  std::string text;
  for (auto& [status, by_grade] : all) {
    int count = 0;
    for (const auto& [grade, number] : by_grade) count += number;
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", count, word(status));
    by_grade.erase(grade_names.size());  // not known
    if (status == Outcome::Status::converged && !by_grade.empty())
      text += ": " + list(by_grade, [](std::size_t grade) { return grade_names[grade]; });
  }
  return text;
}

std::vector<std::string> number_columns() {
  std::vector<std::string> names;
  for (const auto& [name, path] : from_summary) names.push_back(name);
  return names;
}

std::string column_label(const Study& study, const std::string& column) {
  static const std::map<std::string, std::string> known = {
      {"passes_mean", "passes a step, mean"},   {"passes_max", "passes a step, most"},
      {"rejected_steps", "refused steps"},      {"steps", "steps"},
      {"simulated_time", "simulated time (s)"}, {"wall_seconds", "wall time (s)"}};
  if (const auto found = known.find(column); found != known.end()) return found->second;
  for (const auto& quantity : study.quantities) {
    if (quantity.name == column) return quantity.label + (quantity.unit == "-" ? "" : " (" + quantity.unit + ")");
    if (quantity.error_name() == column) return "error of " + quantity.label;
  }
  return column;
}

std::vector<std::string> outcome_columns() {
  auto names = number_columns();
  names.insert(names.end(), {"run", "status", "verdict", "cause", "summary", "ref"});
  return names;
}

bool begun_with(const StudyRun& run, const fs::path& folder) {
  return text_of(folder / "scene.resolved.toml").starts_with(run.resolved + "\n");
}

Outcome outcome_of(const Study& study, const StudyRun& run, const fs::path& folder) {
  Outcome outcome;
  if (!begun_with(run, folder)) return outcome;
  outcome.status = Outcome::Status::interrupted;
  const auto summary = quantity::read_summary(folder);
  if (!summary.contains("status")) return outcome;
  outcome.cause = summary.value("cause", "");
  outcome.verdict = verdict_of(summary);
  outcome.status = status_of(summary.value("status", ""), outcome.cause);
  for (const auto& [name, path] : from_summary)
    if (const auto value = quantity::find_entry(summary, path)) outcome.numbers[name] = value->numbers.front();
  if (const auto limits = summary.find("limits"); limits != summary.end() && limits->is_object())
    for (const auto& [name, limit] : limits->items()) outcome.limits[name] = limit.value("answer", "");
  // With a later `until`, or without one, it goes on.
  const double a_step_of_roundoff = 1e-9;
  if (outcome.status == Outcome::Status::converged &&
      summary.value("simulated_time", run.stop) < (1 - a_step_of_roundoff) * run.stop)
    outcome.status = Outcome::Status::interrupted;
  // With a larger budget it goes on.
  if (outcome.status == Outcome::Status::interrupted && study.budget && outcome.cause.starts_with("the budget") &&
      summary.value("wall_seconds", 0.) >= *study.budget)
    outcome.status = Outcome::Status::stalled;
  return outcome;
}

std::vector<Outcome> outcomes_in(const Study& study, const std::vector<StudyRun>& runs, const fs::path& folder) {
  std::vector<Outcome> outcomes;
  for (const auto& run : runs) outcomes.push_back(outcome_of(study, run, folder / run.name));
  return outcomes;
}

std::vector<std::string> measure(const Study& study, const std::vector<StudyRun>& runs, const fs::path& folder,
                                 std::vector<Outcome>& outcomes) {
  std::vector<std::string> notes;
  const auto each = [&](const std::string& name, const auto& work) {
    bool told = false;  // one note a quantity: what fails once usually fails everywhere
    for (std::size_t i = 0; i < runs.size(); ++i) {
      // A run that broke down has no final state: it counts in passes and seconds only.
      if (outcomes[i].status != Outcome::Status::converged) continue;
      try {
        work(i);
      } catch (const std::exception& error) {
        if (!told) notes.push_back(fmt::format("{} of {}: {}", name, runs[i].name, error.what()));
        told = true;
      }
    }
  };
  for (const auto& quantity : study.quantities) {
    each(quantity.name,
         [&](std::size_t i) { measure_one(study, quantity, runs[i], folder / runs[i].name, outcomes[i]); });
    if (quantity.reference.empty()) continue;
    each(quantity.name, [&](std::size_t i) {
      compare_one(study, quantity, runs[i], outcomes[reference_run(study, quantity, runs[i])], outcomes[i]);
    });
  }
  for (const auto& limit : study.limits)
    each(limit.name, [&](std::size_t i) { answer_one(study, limit, runs[i], folder / runs[i].name, outcomes[i]); });
  for (const auto& quantity : study.quantities)
    for (auto& outcome : outcomes) judge(quantity, outcome);
  return notes;
}

void measure_run(const Study& study, const StudyRun& run, const fs::path& folder, Outcome& outcome) {
  if (outcome.status != Outcome::Status::converged) return;
  const auto attempt = [](const auto& work) {
    try {
      work();
    } catch (const std::exception&) {  // measure() tells of it
    }
  };
  for (const auto& quantity : study.quantities) attempt([&] { measure_one(study, quantity, run, folder, outcome); });
  for (const auto& limit : study.limits) attempt([&] { answer_one(study, limit, run, folder, outcome); });
}

void write_tables(const Study& study, const std::vector<StudyRun>& runs, const std::vector<Outcome>& outcomes,
                  const fs::path& folder) {
  auto root = json_of(study, runs, outcomes);
  if (const auto campaign = campaign_of(study, runs, outcomes)) {
    root["campaign"] = json_of(*campaign);
    write_campaign(*campaign, folder);
  }
  write_file_atomically(folder / "study.csv", csv_of(study, runs, outcomes));
  write_file_atomically(folder / "study.json", root.dump(2) + "\n");
}

}  // namespace splashdown::apps
