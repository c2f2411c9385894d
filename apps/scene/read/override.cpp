#include "apps/scene/read/override.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "apps/scene/read/read.hpp"
#include "apps/scene/read/reader.hpp"

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

std::string without_blanks_around(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t");
  return begin == std::string::npos ? std::string() : text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
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

std::optional<std::size_t> index_of(const std::string& word) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
  if (error != std::errc() || end != word.data() + word.size()) return {};
  return index;
}

toml::node* element_of(toml::array& array, const std::string& word) {
  for (auto& element : array)
    if (auto* table = element.as_table(); table && (*table)["name"].value<std::string>() == word) return &element;
  const auto index = index_of(word);
  return index ? array.get(*index) : nullptr;
}

/// A list of numbers, words or lists with one of its entries replaced, as TOML; a message for what it does not hold.
struct ChangedList {
  std::string text, problem;
};
ChangedList changed(const toml::array& list, std::span<const std::string> indices, const std::string& path,
                    const std::string& value) {
  const auto index = index_of(indices.front());
  if (!index || *index >= list.size())
    return {{},
            list.empty()
                ? fmt::format("{} is an empty list.", path)
                : fmt::format("{} has the entries 0 to {}, not '{}'.", path, list.size() - 1, indices.front())};
  std::string text;
  for (std::size_t i = 0; i < list.size(); ++i) {
    std::string entry = written(*list.get(i));
    if (i == *index && indices.size() == 1) {
      entry = value;
    } else if (i == *index) {
      const auto* inner = list.get(i)->as_array();
      if (!inner) return {{}, fmt::format("{}.{} is a single value and has no entries.", path, i)};
      auto deeper = changed(*inner, indices.subspan(1), fmt::format("{}.{}", path, i), value);
      if (!deeper.problem.empty()) return deeper;
      entry = deeper.text;
    }
    text += (i > 0 ? ", " : "") + entry;
  }
  return {"[" + text + "]", {}};
}

/// An element of an array of tables; the array itself goes with its last one.
bool remove_element(toml::table& table, const std::string& key, toml::array& array, const std::string& word) {
  const auto* element = element_of(array, word);
  if (!element) return false;
  for (auto it = array.begin(); it != array.end(); ++it)
    if (&*it == element) {
      array.erase(it);
      break;
    }
  if (array.empty()) table.erase(key);
  return true;
}

void put(toml::table& table, const std::string& key, toml::table value) {
  // Moving keeps the place a node carries; copying would drop it.
  value.get("value")->visit([&](auto& node) { table.insert_or_assign(key, std::move(node)); });
}

}  // namespace

Override override_of(const std::string& given) {
  const auto end = given.find(": ");
  if (!given.starts_with("--") || end == std::string::npos) return {"--set " + given, given};
  return {given.substr(0, end), given.substr(end + 2)};
}

void apply_override(toml::table& root, const std::string& given_argument, Problems& problems) {
  const auto [source, argument] = override_of(given_argument);
  const auto refuse = [&, source = source](const std::string& message) { problems.add_at({source, 0}, message); };
  const auto equals = argument.find('=');
  if (equals == std::string::npos || equals == 0)
    return refuse("must read key.path=value. Use e.g. --set fluid.density=1025.");
  const auto words = words_of(without_blanks_around(argument.substr(0, equals)));
  if (std::any_of(words.begin(), words.end(), [](const auto& word) { return word.empty(); }))
    return refuse("a word of the key is empty. Use e.g. --set fluid.density=1025.");
  if (words.size() > static_cast<std::size_t>(most_key_words))
    return refuse(fmt::format("the key has {} words. Those of scenes have four at most.", words.size()));
  const auto given = without_blanks_around(argument.substr(equals + 1));
  const bool removes = given.empty();
  auto value = parsed(removes ? "{}" : given, source);
  const auto comma = given.find(',');
  if (!value && comma != std::string::npos && given.find_first_not_of("0123456789+-., ") == std::string::npos) {
    if (given.find(',', comma + 1) != std::string::npos || given.find('.') != std::string::npos)
      return refuse(fmt::format("a list stands in brackets: did you mean [{}]?", given));
    auto point = given;
    point[comma] = '.';
    return refuse(fmt::format(
        "numbers have a point, not a comma, and lists stand in brackets: did you mean {} or [{}]?", point, given));
  }
  if (!value)
    return refuse("the value is not TOML. Use a number, a word, true, [1, 2] or \"a text\" (mind the shell's quotes).");

  toml::node* node = &root;
  toml::table* around = &root;  // the table that `node` is a value of
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
      if (!table->contains(word)) {
        const auto key = path + (path.empty() ? "" : ".") + word;
        if (index_of(words[i + 1]))
          return refuse(
              fmt::format("{} is not in the scene, so it has no entry {}. Give all of it, e.g. --set "
                          "{}=[0.0, 1.0].",
                          key, words[i + 1], key));
        put(*table, word, *parsed("{}", source));
      }
      around = table;
      node = table->get(word);
    } else if (auto* list = node->as_array(); list && !list->is_array_of_tables()) {
      if (removes) return refuse(fmt::format("an entry of {} cannot be removed. Give all of {}.", path, words[i - 1]));
      const auto text = changed(*list, std::span(words).subspan(i), path, written(*value->get("value")));
      if (!text.problem.empty()) return refuse(text.problem + " The first is 0: x, then y (and z).");
      auto whole = parsed(text.text, source);  // so that the place of all of it is this argument
      if (!whole) return refuse(fmt::format("the value cannot stand in a list: {}.", text.text));
      return put(*around, words[i - 1], std::move(*whole));
    } else if (auto* array = node->as_array()) {
      node = element_of(*array, word);
      if (node && last && removes) {
        remove_element(*around, words[i - 1], *array, word);
        return;
      }
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
