#include "apps/commands.hpp"

#include <fmt/format.h>

#include <sstream>

#include "apps/plain_text.hpp"

namespace splashdown::apps {

int bad_input(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) fmt::print(stderr, "error: {}\n", one_line(line));
  return exit_code::bad_input;
}

}  // namespace splashdown::apps
