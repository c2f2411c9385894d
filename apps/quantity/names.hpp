// What the names in a quantity stand for: columns of a table and entries of summary.json.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/quantity/expression.hpp"
#include "apps/quantity/table.hpp"
#include "apps/quantity/value.hpp"

namespace splashdown::quantity {

std::optional<Value> find_column(const Table& table, const std::string& name);

/// What follows "prefix." in a name that starts so.
std::optional<std::string> after(const std::string& prefix, const std::string& name);

/// An entry by its path with dots, lists by position; numbers and booleans only.
std::optional<Value> find_entry(const nlohmann::json& root, const std::string& path);

/// summary.json of a run's folder; an empty object if there is none.
nlohmann::json read_summary(const std::filesystem::path& folder);

/// The rows of the table for which the expression `where` is not zero.
Table rows_where(const Table& table, const std::string& where, const Lookup& lookup);

}  // namespace splashdown::quantity
