#include "apps/process/exit.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>

#include "apps/text/plain_text.hpp"

namespace splashdown::apps {

std::string trouble(const std::exception& error) {
  const auto* files = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
  if (!files) return error.what();
  return fmt::format("{}: {}. Use another --out, a folder that you may write to.", files->path1().string(),
                     files->code().message());
}

int bad_input(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) fmt::print(stderr, "error: {}\n", one_line(line));
  return exit_code::bad_input;
}

}  // namespace splashdown::apps
