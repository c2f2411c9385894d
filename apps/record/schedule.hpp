// When output is due: at the first step at or after each multiple of an interval, or after each listed time.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace splashdown::apps {

class Schedule {
 public:
  Schedule() = default;
  /// `every` = 0: each step.
  explicit Schedule(double every) : every_(every) {}
  explicit Schedule(std::vector<double> times) : times_(std::move(times)), listed_(true) {}

  /// To be asked once a step.
  bool due(double time) {
    if (listed_) return due_listed(time);
    if (every_ <= 0) return true;
    // Steps that aim at a multiple miss it by rounding only.
    const auto passed = static_cast<long>(std::floor(time / every_ + 1e-9));
    if (passed < next_) return false;
    next_ = passed + 1;
    return true;
  }

  /// Settings come from the scene; only the position is state.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(next_);
  }

 private:
  bool due_listed(double time) {
    bool due = false;
    for (; next_ < static_cast<long>(times_.size()); ++next_) {
      const double wanted = times_[static_cast<std::size_t>(next_)];
      if (time < wanted - 1e-9 * std::abs(wanted)) break;
      due = true;
    }
    return due;
  }

  double every_ = 0;
  std::vector<double> times_;  ///< ascending
  bool listed_ = false;
  long next_ = 0;
};

}  // namespace splashdown::apps
