#include "apps/quantity/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "apps/quantity/expression.hpp"

namespace splashdown::quantity {

std::optional<Value> find_column(const Table& table, const std::string& name) {
  const auto* column = table.find(name);
  if (column == nullptr) return std::nullopt;
  return Value::column(*column);
}

std::optional<std::string> after(const std::string& prefix, const std::string& name) {
  if (name.rfind(prefix + ".", 0) != 0) return std::nullopt;
  return name.substr(prefix.size() + 1);
}

std::optional<Value> find_entry(const nlohmann::json& root, const std::string& path) {
  std::string pointer = "/" + path;
  std::replace(pointer.begin(), pointer.end(), '.', '/');
  const nlohmann::json::json_pointer place(pointer);
  if (!root.contains(place)) return std::nullopt;
  const nlohmann::json& node = root.at(place);
  if (node.is_boolean()) return Value::number(node.get<bool>() ? 1 : 0);
  if (!node.is_number()) return std::nullopt;
  return Value::number(node.get<double>());
}

nlohmann::json read_summary(const std::filesystem::path& folder) {
  std::ifstream in(folder / "summary.json");
  return in ? nlohmann::json::parse(in) : nlohmann::json::object();
}

Table rows_where(const Table& table, const std::string& where, const Lookup& lookup) {
  const Value mask = evaluate(where, lookup);
  if (mask.numbers.size() != table.rows())
    throw std::runtime_error(fmt::format("where = \"{}\" is not one value a row", where));
  return select_rows(table, mask.numbers);
}

}  // namespace splashdown::quantity
