#include "tests/validation/judge.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/quantity/expression.hpp"
#include "apps/quantity/names.hpp"

namespace splashdown::validation {

using namespace quantity;

namespace {

std::string in_words(double expected, const Bound& bound) {
  if (bound.expected) return fmt::format("{:.6g}", expected);
  if (bound.at_most) return fmt::format("<= {:g}", *bound.at_most);
  if (bound.at_least) return fmt::format(">= {:g}", *bound.at_least);
  return "";
}

bool within(double measured, double expected, const Bound& bound) {
  const double band = bound.absolute ? bound.tolerance : bound.tolerance * std::abs(expected);
  // Written so that nan is never within.
  if (bound.expected && !(std::abs(measured - expected) <= band)) return false;
  if (bound.at_most && !(measured <= *bound.at_most)) return false;
  if (bound.at_least && !(measured >= *bound.at_least)) return false;
  return std::isfinite(measured);
}

}  // namespace

double Judge::measure(const CheckSpec& check, Verdict& verdict) {
  const RunSpec& run = example_.run(check.run);
  const Outcome& outcome = runner_.outcome(example_, run);
  if (outcome.exit_code != run.exit_code)
    throw std::runtime_error(
        fmt::format("the run ended with {} instead of {}:\n{}", outcome.exit_code, run.exit_code, outcome.log_tail));
  const nlohmann::json summary = read_summary(outcome.folder);
  Table reference, table;
  const Lookup lookup = [&](const std::string& name) -> std::optional<Value> {
    if (const auto column = after("ref", name)) return find_column(reference, *column);
    if (const auto path = after("summary", name)) return find_entry(summary, *path);
    if (auto column = find_column(table, name)) return column;
    if (name == "exit_code") return Value::number(outcome.exit_code);
    if (const auto found = measured_.find(name); found != measured_.end()) return Value::number(found->second);
    const auto found = example_.constants.find(name);
    if (found == example_.constants.end()) return std::nullopt;
    return Value::number(found->second);
  };
  if (!check.reference.empty()) reference = read_table(example_.folder, check.reference);
  if (!check.table.empty()) table = read_table(outcome.folder, check.table);
  if (!check.where.empty()) table = rows_where(table, check.where, lookup);
  const double expected = check.bound.expected ? evaluate_number(*check.bound.expected, lookup) : 0;
  verdict.expected = in_words(expected, check.bound);
  const double measured = evaluate_number(check.quantity, lookup);
  verdict.passed = within(measured, expected, check.bound);
  return measured;
}

Verdict Judge::judge(const CheckSpec& check) {
  Verdict verdict;
  verdict.example = example_.folder.filename().string();
  verdict.check = check.name;
  verdict.run = check.run;
  verdict.unit = check.unit;
  verdict.why = check.why;
  verdict.judged = check.bound.judges();
  if (check.bound.expected)
    verdict.allowed = check.bound.absolute ? fmt::format("{:g}", check.bound.tolerance)
                                           : fmt::format("{:g} %", 100 * check.bound.tolerance);
  try {
    verdict.measured = measure(check, verdict);
    measured_[check.name] = verdict.measured;
  } catch (const std::exception& error) {
    verdict.measured = std::numeric_limits<double>::quiet_NaN();
    verdict.error = error.what();
  }
  return verdict;
}

}  // namespace splashdown::validation
