// What a reader asks for and with which rules: what a JSON Schema is made of (schema.hpp), from the code that reads.
//
// A reader with a sketch finds every table there is and every table empty. Each key that it asks for is noted with its
// rule, and where it would go by what stands in the file (one word of several, a key that is there or not) the sketch
// decides. explore() reads again and again, one decision changed at a time, until it meets no new one.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/rules/rules.hpp"

namespace splashdown::apps {

/// What a value has to be.
struct Wanted {
  enum class Type { anything, number, whole, text, texts, word, words, list, rows, table, tables };
  Type type = Type::anything;
  std::string hint = {};                ///< for whoever writes it
  Rule rule = {};                       ///< of the numbers
  std::vector<std::string> words = {};  ///< that are valid
  std::size_t length = 0;               ///< of a list, or of each row; 0: any
  std::string header = {};              ///< under which a table is noted
  bool even_absent = false;             ///< a table that is read with its defaults when it is absent

  bool operator==(const Wanted&) const = default;
};

class Sketch {
 public:
  struct Key {
    std::vector<Wanted> any_of;  ///< empty: nothing is said about it here
    bool required = false;
    bool refused = false;
  };
  /// One look at a table.
  struct Visit {
    std::vector<std::string> order;  ///< of the keys, as they were asked for
    std::map<std::string, Key, std::less<>> keys;
    std::map<std::string, std::string> picked;  ///< the words that decisions gave to keys
    std::map<std::string, bool> usual;          ///< of these keys: the word is the one in force without the key
    std::optional<Wanted> others;               ///< keys that the user names

    Key& at(std::string_view name);
  };

  /// Calls `read` until no decision is left that it did not go both ways about.
  void explore(const std::function<void()>& read);

  // For readers.
  Visit& open(const std::string& header);
  /// Which of `count` ways to go; `usual`: the way to begin with.
  std::size_t decide(const std::string& what, std::size_t count, std::size_t usual);

  /// All looks at the tables of this name in headers, "" for the root.
  const std::deque<Visit>& visits(const std::string& header) const { return visits_.at(header); }
  /// The same, null for tables that no reader looks at.
  const std::deque<Visit>* find(const std::string& header) const {
    const auto found = visits_.find(header);
    return found == visits_.end() ? nullptr : &found->second;
  }

 private:
  struct Options {
    std::size_t count, usual;
  };
  std::map<std::string, std::deque<Visit>> visits_;
  std::map<std::string, std::size_t> decided_;  // in this reading
  std::map<std::string, Options> met_;
};

}  // namespace splashdown::apps
