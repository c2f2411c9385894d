// Residuals of the coupling, a row a pass: passes.csv.
//
// Attempts that were refused stand before the one that was accepted, for a scheme that fails fails in them. They wait for the end of
// their step, so that a run which is continued, and tries them again, has them once.
#pragma once

#include <cstddef>
#include <vector>

#include "apps/files/csv.hpp"
#include "apps/record/schedule.hpp"

namespace splashdown::apps {

inline constexpr const char* passes_header = "step,time,dt,accepted,pass,residual";

/// A step that was tried and may not be committed.
struct RefusedAttempt {
  double time = 0, dt = 0;             ///< t_n, size [s]
  std::vector<double> pass_residuals;  ///< after each pass, relative [-]
};

class PassRows {
 public:
  /// Rows of the steps that this schedule wants.
  explicit PassRows(Schedule due) : due_(std::move(due)) {}

  /// An attempt at the step that is accepted, or given up, next.
  void refused(RefusedAttempt attempt) { waiting_.push_back(std::move(attempt)); }
  /// To be asked once a step: whether accepted() may be called. What was refused is forgotten if not.
  bool due(double time);
  /// Of the step with this number, from 0, what was refused before it included.
  void accepted(CsvFile& file, std::size_t step, const RefusedAttempt& attempt);
  /// What was refused of a step that is none.
  void given_up(CsvFile& file, std::size_t step);
  /// Whether given_up() has anything to write.
  bool waits() const { return !waiting_.empty(); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(due_);
  }

 private:
  Schedule due_;
  std::vector<RefusedAttempt> waiting_;  ///< not part of the checkpoint
};

}  // namespace splashdown::apps
