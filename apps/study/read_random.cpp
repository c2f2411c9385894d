#include "apps/study/read_random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "apps/quantity/expression.hpp"
#include "apps/scene/kinds/named.hpp"

namespace splashdown::apps {
namespace {

/// Where values or weights are wrong.
void refuse_distribution(Reader& reader, const std::string& fault) {
  reader.context().problems.add(reader.path(), fault,
                                "Write e.g. distribution = {type = \"normal\", mean = 3, sd = 0.5}.");
}

/// What an expression in a distribution may name: constants, and random axes before this one that have numbers.
std::vector<std::string> names_before(const Study& study) {
  std::vector<std::string> names;
  for (const auto& [name, value] : study.constants) names.push_back(name);
  for (const auto& axis : study.axes)
    if (axis.sampled && axis.values.empty()) names.push_back(axis.name);  // cases have their values already
  return names;
}

std::string fault_of_expression(const Study& study, const std::string& expression) {
  try {
    const auto valid = names_before(study);
    for (const auto& name : quantity::names_in(expression))
      if (std::ranges::find(valid, name) == valid.end())
        return fmt::format("'{}' is neither a constant nor a random axis of numbers before this one", name);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

/// A number, or an expression of what is drawn before.
void read_part(Reader& reader, const Study& study, RandomAxis& random, std::string_view key, Distribution::Part part,
               const std::string& cure, Need need = Need::optional) {
  using enum Wanted::Type;
  const auto* node = reader.node(key, need, "what the distribution is made of", cure, {number, text});
  if (!node) return;
  Problems& problems = reader.context().problems;
  if (node->is_string()) {
    const auto expression = *node->value<std::string>();
    if (const auto fault = fault_of_expression(study, expression); !fault.empty())
      return problems.add(reader.key(key), fault, cure);
    random.conditions.emplace_back(part, expression);
  } else if (const auto value = node->value<double>(); value && std::isfinite(*value) && node->is_number()) {
    random.distribution.set(part, *value);
  } else {
    problems.add(reader.key(key), "must be a number or an expression", cure);
  }
}

void read_distribution(Reader& reader, const Study& study, RandomAxis& random) {
  using enum Distribution::Type;
  using enum Distribution::Part;
  auto& distribution = random.distribution;
  struct Law {
    std::string_view name;
    Distribution::Type type;
  };
  static constexpr Law laws[] = {
      {"normal", normal}, {"lognormal", lognormal}, {"weibull", weibull}, {"uniform", uniform}, {"table", table}};
  std::string name;
  if (!reader.choice("type", name, names_of(laws), Need::required)) return reader.skip_all();
  distribution.type = named(laws, name).type;
  const auto part = [&](const char* key, Distribution::Part which, const char* cure, Need need = Need::optional) {
    read_part(reader, study, random, key, which, cure, need);
  };
  const auto pair = [&](const char* one, const char* other) {
    const char* const cure = "Use a number, or an expression of random axes before this one.";
    part(one, first, cure, Need::required);
    part(other, second, cure, Need::required);
  };
  if (distribution.type == uniform) return pair("min", "max");
  if (distribution.type == table) {
    reader.numbers("values", distribution.values, any("", "Use values that ascend, e.g. [0, 1, 3]."));
    reader.numbers("below", distribution.below,
                   any("", "Use the share of all that lies below each value, e.g. [0, 0.7, 1]."));
    return;
  }
  distribution.type == weibull ? pair("shape", "scale") : pair("mean", "sd");
  part("min", least, "Use the lowest value that can occur.");
  part("max", most, "Use the highest value that can occur.");
}

/// The case into whose share of all weights `share` falls.
std::size_t drawn_case(const std::vector<double>& weights, double share) {
  const double all = std::accumulate(weights.begin(), weights.end(), 0.);
  double sum = 0;
  for (std::size_t k = 0; k + 1 < weights.size(); ++k)
    if ((sum += weights[k]) > share * all) return k;
  return weights.size() - 1;
}

/// The distribution of an axis in combination `k`, where those before it have their values.
Distribution distribution_at(const Study& study, const RandomAxis& random, std::size_t k) {
  auto distribution = random.distribution;
  const auto lookup = [&](const std::string& name) -> std::optional<quantity::Value> {
    if (const auto found = study.constants.find(name); found != study.constants.end())
      return quantity::Value::number(found->second);
    const auto axis = std::ranges::find(study.axes, name, &Axis::name);
    if (axis == study.axes.end() || k >= axis->values.size() || !axis->values[k].number) return {};
    return quantity::Value::number(*axis->values[k].number);
  };
  for (const auto& [part, expression] : random.conditions)
    distribution.set(part, quantity::evaluate_number(expression, lookup));
  return distribution;
}

/// Nothing, and a problem, where the numbers of the distribution are none for what was drawn before.
std::optional<double> draw_number(Reader& root, const Study& study, const RandomAxis& random, std::size_t k,
                                  double share) {
  std::string fault;
  try {
    const auto distribution = distribution_at(study, random, k);
    fault = fault_of(distribution);
    if (fault.empty()) return quantile(distribution, share);
  } catch (const std::runtime_error& error) {
    fault = error.what();
  }
  const auto& axis = study.axes[random.axis];
  std::string drawn;
  for (const auto& other : study.axes)
    if (other.sampled && &other != &axis && k < other.values.size() && other.values[k].number)
      drawn += fmt::format("{}{} = {}", drawn.empty() ? " with " : ", ", other.name, other.values[k].text);
  root.context().problems.add_at(random.place, fmt::format("axis.{}.distribution:{}: {}. Cut off what comes before, or "
                                                           "use other expressions.",
                                                           axis.name, drawn, fault));
  return {};
}

}  // namespace

std::vector<std::string> set_text(const std::string& key, const std::string& value) {
  if (key.empty()) return {};
  return {key + "=" + value};
}

void read_random(Reader& reader, const Study& study, RandomAxis& random, const std::string& spacing) {
  Problems& problems = reader.context().problems;
  reader.number("scale", random.scale, any("", "Use the factor from these values to the scene's key."));
  random.place = reader.place(reader.holds("range") ? "range" : "distribution");
  if (!reader.context().sketch && reader.holds("distribution")) {
    const char* const cure = "Write e.g. distribution = {type = \"normal\", mean = 3, sd = 0.5}.";
    if (const auto* node = reader.node("distribution", Need::optional, {}, cure); !node->is_table())
      return problems.add(reader.key("distribution"), "must be a table of its type and numbers", cure);
  }
  if (auto table = reader.table("distribution")) {
    if (reader.holds("range"))
      problems.add(reader.key("range"), "must not stand beside distribution", "Use one of the two.");
    read_distribution(*table, study, random);
    if (problems.found_in(table->path()) || !random.conditions.empty()) return;
    if (const auto fault = fault_of(random.distribution); !fault.empty()) refuse_distribution(*table, fault);
    return;
  }
  std::vector<double> range;
  reader.numbers("range", range, any("", "Use the lowest and the highest value, e.g. range = [-5, 5]."));
  if (problems.found_in(reader.key("range"))) return;
  const bool log = spacing == "log";
  if (range.size() != 2 || range[0] >= range[1] || (log && range[0] <= 0))
    return problems.add(
        reader.key("range"),
        log ? "must be two positive numbers, the lower one first" : "must be two numbers, the lower one first",
        "Use e.g. range = [1, 5].");
  random.distribution.type = log ? Distribution::Type::log_uniform : Distribution::Type::uniform;
  random.distribution.first = range[0];
  random.distribution.second = range[1];
}

void draw_random(Reader& root, Study& study, const std::vector<RandomAxis>& randoms) {
  std::vector<std::string> names;
  for (const auto& random : randoms) names.push_back(study.axes[random.axis].name);
  const auto shares = shares_of(study.samples->plan, study.samples->number, study.samples->seed, names);
  for (std::size_t i = 0; i < randoms.size(); ++i) {
    const auto& random = randoms[i];
    auto& axis = study.axes[random.axis];
    const auto cases = std::exchange(axis.values, {});
    for (std::size_t k = 0; k < shares[i].size(); ++k) {
      if (!random.weights.empty()) {
        axis.values.push_back(cases[drawn_case(random.weights, shares[i][k])]);
        continue;
      }
      const auto drawn = draw_number(root, study, random, k, shares[i][k]);
      if (!drawn) return;
      const auto text = fmt::format("{:.6g}", *drawn);  // tables and folders show what is run
      const double number = std::stod(text);
      axis.values.push_back({.text = text,
                             .number = number,
                             .set = set_text(random.key, toml_text(number * random.scale)),
                             .place = random.place});
    }
  }
}

}  // namespace splashdown::apps
