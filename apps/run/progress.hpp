// How far a run is: one line that renews itself on a terminal, a plain line now and then elsewhere.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "apps/process/renewed_line.hpp"

namespace splashdown::apps {

struct ProgressPoint {
  double time = 0, stop = 0, dt = 0;
  long steps = 0;
  std::optional<std::size_t> nodes;  ///< absent without a fluid
  std::optional<int> passes;         ///< absent without coupling
};

/// One line of progress; `left` in wall seconds, negative: not known yet.
std::string progress_text(const ProgressPoint& point, double left);

class Progress {
 public:
  enum class Style { none, plain, terminal };
  explicit Progress(Style style) : style_(style), line_(style == Style::terminal) {}

  void show(const ProgressPoint& point);
  /// A line of its own, above the progress line.
  void say(const std::string& text);
  void clear() { line_.clear(); }

 private:
  using Clock = std::chrono::steady_clock;
  double time_left(const ProgressPoint& point);

  Style style_;
  RenewedLine line_;
  std::optional<Clock::time_point> last_;
  double rate_ = 0;  // simulated seconds a wall second, of late
  double rated_time_ = 0;
  std::optional<Clock::time_point> rated_;
};

}  // namespace splashdown::apps
