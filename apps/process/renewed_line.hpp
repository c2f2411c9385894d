// One line on standard output that renews itself.
#pragma once

#include <chrono>
#include <string>

namespace splashdown::apps {

/// A line on a terminal that is written over by the next text and erased in the end.
class RenewedLine {
 public:
  /// `on`: whether there is a terminal to write on. Without one nothing is ever written.
  explicit RenewedLine(bool on) : on_(on) {}
  RenewedLine(const RenewedLine&) = delete;
  RenewedLine& operator=(const RenewedLine&) = delete;
  ~RenewedLine() { clear(); }

  /// Whether standard output is a terminal.
  static bool is_terminal();
  /// Whether a new text would be seen: there is a terminal, and the last text is older than a fifth of a second.
  bool is_due() const;
  void show(const std::string& text);  ///< in place of what is there
  void clear();                        ///< erases it

 private:
  using Clock = std::chrono::steady_clock;

  bool on_, shown_ = false;
  Clock::time_point last_;
};

}  // namespace splashdown::apps
