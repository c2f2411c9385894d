#include "apps/scene_override.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <vector>

#include "apps/scene_read.hpp"

namespace splashdown::apps {
namespace {

/// The words of a.b.c; body[0].mass is the same as body.0.mass.
std::vector<std::string> words_of(const std::string& path) {
  std::vector<std::string> words(1);
  for (const char c : path) {
    if (c == '.' || c == '[')
      words.emplace_back();
    else if (c != ']')
      words.back() += c;
  }
  return words;
}

bool is_bare_word(const std::string& text) {
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
}

/// The value under the key "value" of a table whose nodes carry `source` as their place.
std::optional<toml::table> parsed(const std::string& text, const std::string& source) {
  try {
    auto table = toml::parse("value = " + text, source);
    if (table.size() == 1) return table;
  } catch (const toml::parse_error&) {
  }
  if (is_bare_word(text)) return toml::parse("value = \"" + text + "\"", source);
  return {};
}

std::vector<std::string> names_in(const toml::array& array) {
  std::vector<std::string> names;
  for (const auto& element : array)
    if (const auto* table = element.as_table())
      if (const auto name = (*table)["name"].value<std::string>()) names.push_back(*name);
  return names;
}

toml::node* element_of(toml::array& array, const std::string& word) {
  for (auto& element : array)
    if (auto* table = element.as_table(); table && (*table)["name"].value<std::string>() == word) return &element;
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
  const bool whole = error == std::errc() && end == word.data() + word.size();
  return whole ? array.get(index) : nullptr;
}

void put(toml::table& table, const std::string& key, toml::table value) {
  // Moving keeps the place a node carries; copying would drop it.
  value.get("value")->visit([&](auto& node) { table.insert_or_assign(key, std::move(node)); });
}

}  // namespace

void apply_override(toml::table& root, const std::string& argument, Problems& problems) {
  const std::string source = "--set " + argument;
  const auto refuse = [&](const std::string& message) { problems.add_at({source, 0}, message); };
  const auto equals = argument.find('=');
  if (equals == std::string::npos || equals == 0)
    return refuse("must read key.path=value. Use e.g. --set fluid.density=1025.");
  const auto words = words_of(argument.substr(0, equals));
  if (std::any_of(words.begin(), words.end(), [](const auto& word) { return word.empty(); }))
    return refuse("a word of the key is empty. Use e.g. --set fluid.density=1025.");
  if (words.size() > static_cast<std::size_t>(most_key_words))
    return refuse(fmt::format("the key has {} words. Those of scenes have four at most.", words.size()));
  const bool removes = equals + 1 == argument.size();
  auto value = parsed(removes ? "{}" : argument.substr(equals + 1), source);
  const auto comma = argument.find(',', equals), digits = argument.find_first_not_of("0123456789+-,", equals + 1);
  if (!value && comma != std::string::npos && digits == std::string::npos) {
    auto point = argument.substr(equals + 1);
    point[comma - equals - 1] = '.';
    return refuse("numbers have a point, not a comma: did you mean " + point + "?");
  }
  if (!value)
    return refuse("the value is not TOML. Use a number, a word, true, [1, 2] or \"a text\" (mind the shell's quotes).");

  toml::node* node = &root;
  std::string path;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto& word = words[i];
    const bool last = i + 1 == words.size();
    if (auto* table = node->as_table()) {
      if (last && removes) {
        if (table->erase(word) == 0) refuse("there is no such key to remove. Give a value behind the equals sign.");
        return;
      }
      if (last) return put(*table, word, std::move(*value));
      if (!table->contains(word)) put(*table, word, *parsed("{}", source));
      node = table->get(word);
    } else if (auto* array = node->as_array()) {
      node = element_of(*array, word);
      if (!node) {
        const auto names = names_in(*array);
        const auto near = nearest(word, names);
        return refuse(fmt::format("no {} is called '{}'. {}", path, word,
                                  !near.empty()   ? "Did you mean '" + near + "'?"
                                  : names.empty() ? fmt::format("Use an index from 0 to {}.", array->size() - 1)
                                                  : "There is " + listing(names) + "."));
      }
      if (last) return refuse(fmt::format("{} '{}' is a whole table. Name one of its keys.", path, word));
    } else {
      return refuse(fmt::format("{} is a single value and has no keys.", path));
    }
    path += (path.empty() ? "" : ".") + word;
  }
}

}  // namespace splashdown::apps
