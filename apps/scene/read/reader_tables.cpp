// Tables within a table.
#include <fmt/format.h>

#include <algorithm>

#include "apps/scene/read/reader.hpp"
#include "apps/text/plain_text.hpp"

namespace splashdown::apps {
namespace {

const toml::table no_table;

}  // namespace

void Reader::numbers_by_name(std::string_view name, std::map<std::string, double>& target, const std::string& example) {
  if (visit_) {
    note(name,
         {.type = Wanted::Type::table, .hint = "Names with numbers, e.g. " + example + ".", .header = header_of(name)});
    context_->sketch->open(header_of(name)).others = Wanted{.type = Wanted::Type::number};
    return;
  }
  const auto* node = find(name, Need::optional, {}, {});
  if (!node) return;
  const auto* table = node->as_table();
  if (!table)
    return context_->problems.add(key(name), "must be a table",
                                  fmt::format("Write [{}] with NAME = NUMBER.", header_of(name)));
  for (const auto& [entry, value] : *table) {
    const auto where = fmt::format("{}.{}", key(name), entry.str());
    context_->problems.note(where, place_of(value), written_short(value));
    if (!value.is_number()) context_->problems.add(where, "must be a number", "Use e.g. " + example + ".");
    if (!is_exact(value))
      context_->problems.add(where, "whole numbers beyond 2^53 are not kept exactly",
                             "Write it with a point, e.g. 1e16.");
    target.emplace(entry.str(), value.value<double>().value_or(0));
  }
  const auto section = context_->echo.open("[" + header_of(name) + "]");
  for (const auto& [entry, value] : target) context_->echo.add(section, entry, toml_text(value));
}

std::optional<Reader> Reader::table(std::string_view name, Need need, std::string cure) {
  if (visit_) {
    note(name, {.type = Wanted::Type::table, .header = header_of(name)}, need);
    return Reader(*context_, no_table, key(name), header_of(name));
  }
  if (cure.empty()) cure = "Write [" + header_of(name) + "] with its keys below.";
  const auto* node = find(name, need, "a table", cure);
  if (!node) return {};
  if (const auto* table = node->as_table()) return Reader(*context_, *table, key(name), header_of(name));
  wrong_type(key(name), "a table", *node, cure);
  return {};
}

Reader Reader::table_or_defaults(std::string_view name) {
  if (!visit_)
    if (auto reader = table(name)) return std::move(*reader);
  note(name, {.type = Wanted::Type::table, .header = header_of(name), .even_absent = true});
  return Reader(*context_, no_table, key(name), header_of(name));
}

void Reader::each_table(std::string_view name, const std::function<void(Reader&)>& read) {
  if (visit_) {
    note(name, {.type = Wanted::Type::tables, .header = header_of(name)});
    Reader reader(*context_, no_table, fmt::format("{}[0]", key(name)), header_of(name), true);
    return read(reader);
  }
  const auto cure = "Write [[" + header_of(name) + "]], once for each.";
  const auto* node = find(name, Need::optional, {}, {});
  if (!node) return;
  const auto* array = node->as_array();
  if (!array || !std::all_of(array->begin(), array->end(), [](const auto& n) { return n.is_table(); })) {
    wrong_type(key(name), "an array of tables", *node, cure);
    return;
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < array->size(); ++i) {
    const auto& table = *array->get(i)->as_table();
    const auto own = one_line(table["name"].value<std::string>().value_or(""));
    const bool by_name = !own.empty() && names.insert(own).second;
    // One at a time: its sub-tables must be echoed before the next element opens.
    Reader reader(*context_, table, by_name ? key(name) + "." + own : fmt::format("{}[{}]", key(name), i),
                  header_of(name), true);
    read(reader);
  }
}

}  // namespace splashdown::apps
