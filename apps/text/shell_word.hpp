// Words of a command that is told, to be pasted.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace splashdown::apps {

/// As a shell takes it: in quotes where it has other characters than those of names, paths and numbers.
inline std::string shell_word(const std::string& word) {
  constexpr std::string_view harmless = "_-./=,+:@%";
  const auto is_plain = [&](unsigned char c) {
    return std::isalnum(c) != 0 || harmless.find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace splashdown::apps
