#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "apps/quantity/expression.hpp"
#include "apps/scene/numbers.hpp"
#include "apps/scene/rules/check.hpp"

namespace splashdown::apps {
namespace {

using Names = std::vector<std::string>;

/// The name nearest to it, of the same body or record if there is such a one.
std::string cure_for(const std::string& name, const Names& valid) {
  Names beside, owners;
  const auto owner = name.substr(0, name.find('.') + 1);
  for (const auto& other : valid)  // a word too few
    if (!owner.empty() && other.starts_with(owner) && other.ends_with("_" + name.substr(owner.size())))
      return "Did you mean '" + other + "'?";
  if (const auto near = nearest(name, valid); !near.empty()) return "Did you mean '" + near + "'?";
  for (const auto& other : valid) {
    if (other.starts_with(owner)) beside.push_back(other);
    const auto of = other.substr(0, other.find('.'));
    if (std::ranges::find(owners, of) == owners.end()) owners.push_back(of);
  }
  if (!owner.empty() && !beside.empty()) return "There is " + listing(beside) + ".";
  if (owners.empty()) return "The scene has no numbers that have names: add a body or a record.";
  return fmt::format("Use NAME.NUMBER, e.g. {}; NAME is {}.", valid.front(), listing(owners));
}

void check_names(const Limit& limit, const std::string& key, const Names& valid, Problems& problems) {
  if (std::ranges::find(valid, limit.quantity) != valid.end()) return;
  Names names;
  try {
    quantity::check_syntax(limit.quantity);
    names = quantity::names_in(limit.quantity);
  } catch (const std::runtime_error& error) {
    return problems.add(key, error.what(),
                        "Use the name of a number, e.g. hull.peak_g, or an expression in such names.");
  }
  if (names.empty()) return problems.add(key, "holds no number of the run", "Use the name of one, e.g. hull.peak_g.");
  for (const auto& name : std::set<std::string>(names.begin(), names.end()))
    if (std::ranges::find(valid, name) == valid.end())
      return problems.add(key, fmt::format("no number of the run is called '{}'", name), cure_for(name, valid));
}

}  // namespace

void check_limits(const Scene& scene, const SceneLabels& labels, Problems& problems) {
  if (scene.limits.empty() || problems.found_in("body") || problems.found_in("record")) return;
  Names valid;
  std::set<std::string> taken;
  for (const auto& number : numbers_of(scene)) valid.push_back(number.name);
  for (std::size_t i = 0; i < scene.limits.size(); ++i) {
    const auto& limit = scene.limits[i];
    if (problems.found_in(labels.limits[i])) continue;
    const bool of_record = labels.limits[i].starts_with("record");
    const auto key = labels.limits[i] + (of_record ? "" : ".quantity");
    if (!taken.insert(limit.name).second)
      problems.add(of_record ? key : labels.limits[i] + ".name", "there is a limit of this name already",
                   "Give every limit, and every record with one, its own name.");
    if (std::ranges::count(valid, limit.quantity) > 1)
      problems.add(key, fmt::format("'{}' is the number of a body and of a record", limit.quantity),
                   "Give the record another name than the body.");
    else
      check_names(limit, key, valid, problems);
  }
}

}  // namespace splashdown::apps
