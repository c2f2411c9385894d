#include "apps/process/renewed_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace splashdown::apps {
namespace {

constexpr std::chrono::milliseconds between_texts(200);        // five a second can be read
constexpr const char* back_and_erase_to_the_end = "\r\x1b[K";  // ECMA-48: erase in line

}  // namespace

bool RenewedLine::is_terminal() { return ::isatty(STDOUT_FILENO) != 0; }

bool RenewedLine::is_due() const {
  return on_ && (last_ == Clock::time_point() || Clock::now() - last_ >= between_texts);
}

void RenewedLine::show(const std::string& text) {
  if (!on_) return;
  last_ = Clock::now();
  shown_ = true;
  fmt::print("{}{}", back_and_erase_to_the_end, text);
  std::fflush(stdout);
}

void RenewedLine::clear() {
  if (!shown_) return;
  shown_ = false;
  fmt::print("{}", back_and_erase_to_the_end);
  std::fflush(stdout);  // notes go to the other stream
}

}  // namespace splashdown::apps
