#include "apps/run/progress.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "apps/text/number_text.hpp"

namespace splashdown::apps {
namespace {

constexpr double seconds_between_lines = 5;
constexpr double seconds_of_memory = 5;  // of the speed that the time left is judged by

double seconds(std::chrono::steady_clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

}  // namespace

std::string progress_text(const ProgressPoint& point, double left) {
  auto text = fmt::format("{:3.0f} %  t = {:.4g} of {:.4g} s  step {}  dt {:.2g} s", 100 * point.time / point.stop,
                          point.time, point.stop, point.steps, point.dt);
  if (point.nodes) text += fmt::format("  nodes {}", *point.nodes);
  if (point.passes) text += fmt::format("  passes {}", *point.passes);
  if (left >= 0) text += fmt::format("  left {}", clock_text(left));
  return text;
}

double Progress::time_left(const ProgressPoint& point) {
  const auto now = Clock::now();
  if (!rated_) {
    rated_ = now;
    rated_time_ = point.time;
    return -1;
  }
  const double span = seconds(now - *rated_);
  if (span > 0) {
    const double weight = std::min(1., rate_ == 0 ? 1. : span / seconds_of_memory);
    rate_ += weight * ((point.time - rated_time_) / span - rate_);
    rated_ = now;
    rated_time_ = point.time;
  }
  return rate_ > 0 ? (point.stop - point.time) / rate_ : -1;
}

void Progress::show(const ProgressPoint& point) {
  if (style_ == Style::none) return;
  const auto now = Clock::now();
  if (!last_) {
    last_ = now;
    time_left(point);
    if (style_ == Style::plain) return;
  } else if (style_ == Style::plain ? seconds(now - *last_) < seconds_between_lines : !line_.is_due()) {
    return;
  }
  last_ = now;
  const auto text = progress_text(point, time_left(point));
  if (style_ == Style::terminal) return line_.show(text);
  fmt::print("{}\n", text);
  std::fflush(stdout);
}

void Progress::say(const std::string& text) {
  if (style_ == Style::none) return;
  line_.clear();
  fmt::print("{}\n", text);
  std::fflush(stdout);
}

}  // namespace splashdown::apps
