// The step loop of a run: ends at the stop time exactly, with checkpoints on the way.
//
// The wall clock decides when checkpoints are taken and when a budget ends; neither changes a step. The steps that the stop
// time shortens are taken after a last checkpoint, so a run that is continued beyond it makes the same steps as one that was
// never stopped.
#pragma once

#include <optional>
#include <string>

#include "apps/simulation/steps.hpp"

namespace splashdown::apps {

class LoopHost : public StepHost {
 public:
  virtual void record(const StepMade& step) = 0;
  virtual bool checkpoint_due() = 0;
  virtual void checkpoint() = 0;
  /// Why the run shall be interrupted before its next step.
  virtual std::optional<std::string> interruption() = 0;
};

struct LoopEnd {
  enum class Status { done, interrupted, failed };
  Status status = Status::done;
  std::string cause;      ///< empty when done
  std::string cure = {};  ///< what helps where shorter steps and finer elements do not; empty: they may
};

LoopEnd run_loop(coupling::Stepper& stepper, LoopState& state, double stop, LoopHost& host);

}  // namespace splashdown::apps
