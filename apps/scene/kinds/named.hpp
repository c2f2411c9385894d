// Rows that a scene names: each has a `name`.
#pragma once

#include <ranges>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace splashdown::apps {

/// The row of that name. Throws std::logic_error for a name that readers did not choose from these.
template <std::ranges::range Rows>
const auto& named(const Rows& rows, std::string_view name) {
  for (const auto& row : rows)
    if (row.name == name) return row;
  throw std::logic_error("nothing is called '" + std::string(name) + "'");
}

/// The names of all rows, in their order.
template <std::ranges::range Rows>
std::vector<std::string> names_of(const Rows& rows) {
  std::vector<std::string> names;
  for (const auto& row : rows) names.emplace_back(row.name);
  return names;
}

}  // namespace splashdown::apps
