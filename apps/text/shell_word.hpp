// Words of a command, as a POSIX shell takes them.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

namespace splashdown::apps {

/// In single quotes: the shell takes it as it is.
inline std::string shell_quoted(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// Of a command that is told, to be pasted: in quotes where it has other characters than those of names, paths and numbers.
inline std::string shell_word(const std::string& word) {
  constexpr std::string_view harmless = "_-./=,+:@%";
  const auto is_plain = [&](unsigned char c) {
    return std::isalnum(c) != 0 || harmless.find(static_cast<char>(c)) != std::string_view::npos;
  };
  return !word.empty() && std::ranges::all_of(word, is_plain) ? word : shell_quoted(word);
}

/// Of a script: all words in quotes.
inline std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const auto& word : words) line += (line.empty() ? "" : " ") + shell_quoted(word);
  return line;
}

}  // namespace splashdown::apps
