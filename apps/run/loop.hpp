// The step loop: chooses dt, refuses steps, ends at the stop time exactly.
//
//   dt = min(criterion, growth dt_{n-1});  a refused step is tried again with half of it.
//
// After ten refusals of a step the fluid may let go the fragment for which it was refused, and dt is what it was; after twenty the
// run ends. It also ends where shorter steps go on, but the way to the end of one that was refused takes more than a hundred
// refusals: bodies that a mechanism drives into a corner come nearer in ever shorter steps and never get there. And where a
// hundred steps in a row are below 1e-8 of the whole time: the last film between two walls gets faster as it gets
// thinner, and no such run reaches its end. And before a step that carries bodies where they must not be.
//
// Nothing here depends on the wall clock except when checkpoints are taken and when a budget ends, neither
// of which changes a step. The steps that the stop time shortens are taken after a last checkpoint, so a run
// that is continued beyond it makes the same steps as one that was never stopped.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "coupling/schemes/stepper.hpp"

namespace splashdown::apps {

/// What a continued run needs to know besides the state of its parts.
struct LoopState {
  double dt_previous = 0;                ///< of the last committed step; 0 before the first [s]
  double dt_cap = 0;                     ///< largest dt that the steps before allow; 0 before the first [s]
  long steps = 0;                        ///< committed
  std::map<std::string, long> rejected;  ///< refused attempts by cause
  long released = 0;                     ///< fragments of the fluid that no smaller dt kept with the rest
  long crawling = 0;                     ///< committed of late, each below 1e-8 of the whole time
  double refused_end = 0;                ///< end of the first refused step that has not been passed since [s]
  long refused_on_the_way = 0;           ///< attempts until there

  /// Whether the steps have become too short to go on.
  bool crawls() const { return crawling >= 100; }
  /// Whether there seems to be no way past a refused step.
  bool is_stuck() const { return refused_on_the_way > 100; }
};

/// A step that was tried with success and is not committed yet: everything at `time` is known.
struct StepMade {
  double time = 0;  ///< t_n
  double dt = 0, dt_previous = 0;
  coupling::StepReport report;
  bool last = false;  ///< t_n is the stop time; this step is never committed
};

/// What stands in the way of a step whatever its dt.
struct Obstacle {
  std::string cause, cure;
};

class LoopHost {
 public:
  virtual ~LoopHost() = default;
  /// Bound on the next step besides the stepper's own criterion [s].
  virtual double dt_bound() const = 0;
  virtual void record(const StepMade& step) = 0;
  /// Whether the step that was tried last may not be committed.
  virtual std::optional<Obstacle> obstacle() = 0;
  virtual void refused(double time, double dt, const std::string& cause) = 0;
  virtual void released(double time, const std::string& cause) = 0;
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

/// The next dt towards an instant `remaining` away: dt itself, or equal parts when two steps or fewer are
/// left, so that no sliver of a step remains.
double fitted_dt(double dt, double remaining);

}  // namespace splashdown::apps
