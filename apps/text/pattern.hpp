// Text by example: POSIX extended regular expressions, of the C library. The standard's templates take four seconds to compile in every
// source that names them.
#pragma once

#include <regex.h>

#include <array>
#include <stdexcept>
#include <string>

namespace splashdown::apps {

class Pattern {
 public:
  /// Throws std::invalid_argument where it is none.
  explicit Pattern(const char* text) {
    if (regcomp(&compiled_, text, REG_EXTENDED) != 0) throw std::invalid_argument(std::string("no pattern: ") + text);
  }
  ~Pattern() { regfree(&compiled_); }
  Pattern(const Pattern&) = delete;
  Pattern& operator=(const Pattern&) = delete;

  /// What the first match in `text` has in the pattern's first `count` pairs of brackets; empty without a match.
  template <std::size_t count>
  std::array<std::string, count> in(const std::string& text) const {
    std::array<regmatch_t, count + 1> places;
    std::array<std::string, count> found;
    if (regexec(&compiled_, text.c_str(), places.size(), places.data(), 0) != 0) return found;
    for (std::size_t i = 0; i < count; ++i)
      if (const auto& [begin, end] = places[i + 1]; begin >= 0)
        found[i] = text.substr(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
    return found;
  }

 private:
  regex_t compiled_{};
};

}  // namespace splashdown::apps
