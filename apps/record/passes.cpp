#include "apps/record/passes.hpp"

namespace splashdown::apps {
namespace {

void write_passes(CsvFile& file, std::size_t step, const RefusedAttempt& attempt, bool accepted) {
  for (std::size_t pass = 0; pass < attempt.pass_residuals.size(); ++pass) {
    file << step << attempt.time << attempt.dt << (accepted ? 1 : 0) << pass + 1 << attempt.pass_residuals[pass];
    file.end_row();
  }
}

}  // namespace

bool PassRows::due(double time) {
  const bool due = due_.due(time);
  if (!due) waiting_.clear();
  return due;
}

void PassRows::accepted(CsvFile& file, std::size_t step, const RefusedAttempt& attempt) {
  given_up(file, step);
  write_passes(file, step, attempt, true);
}

void PassRows::given_up(CsvFile& file, std::size_t step) {
  for (const auto& attempt : waiting_) write_passes(file, step, attempt, false);
  waiting_.clear();
}

}  // namespace splashdown::apps
