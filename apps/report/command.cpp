#include "apps/report/command.hpp"

#include <fmt/format.h>

#include "apps/process/exit.hpp"
#include "apps/report/report.hpp"

namespace splashdown::apps {

int report_command(const std::filesystem::path& directory) {
  try {
    const auto result = write_report(directory);
    for (const auto& warning : result.warnings) fmt::print(stderr, "note: {}\n", warning);
    fmt::print("{}\n", result.page.string());
    return exit_code::done;
  } catch (const std::runtime_error& error) {
    return bad_input(trouble(error));
  }
}

}  // namespace splashdown::apps
