#include "apps/text/shell.hpp"

namespace splashdown::apps {

std::string shell_word(const std::string& word) {
  std::string result(1, '\'');
  for (const char c : word) {
    if (c == '\'')
      result += "'\\''";
    else
      result += c;
  }
  return result + '\'';
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const auto& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

}  // namespace splashdown::apps
