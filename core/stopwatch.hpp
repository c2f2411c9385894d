// Adds the time until its end to a sum.
#pragma once

#include <chrono>
#include <ctime>

namespace splashdown {

/// Seconds of the wall clock since `start`.
inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Seconds that this process has spent on processors, in all its threads: other work on the machine hardly adds to them.
inline double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Measures its own life by the wall clock.
class Stopwatch {
 public:
  /// Starts. `seconds`: the sum to which the destructor adds; it must live longer.
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() { seconds_ += seconds_since(start_); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace splashdown
