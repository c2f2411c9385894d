// The steps of a simulation: chooses dt, tries, halves what is refused.
//
//   dt = min(criterion, growth dt_{n-1});  a refused step is tried again with half of it.
//
// After ten refusals of a step the fluid may let go the fragment for which it was refused, and dt is what it was; after twenty
// there is no step. There is none either where shorter steps go on, but the way to the end of one that was refused takes more than a
// hundred refusals: bodies that a mechanism drives into a corner come nearer in ever shorter steps and never get there. And where a
// hundred steps in a row are below 1e-8 of the whole time: the last film between two walls gets faster as it gets
// thinner, and no such run reaches its end. And before a step that carries bodies where they must not be.
//
// Nothing here depends on the wall clock.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "coupling/schemes/stepper.hpp"

namespace splashdown::apps {

/// What a continued simulation needs to know besides the state of its parts.
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

/// Who knows more of a simulation than its stepper does.
class StepHost {
 public:
  virtual ~StepHost() = default;
  /// Bound on the next step besides the stepper's own criterion [s].
  virtual double dt_bound() const = 0;
  /// Whether the step that was tried last may not be committed.
  virtual std::optional<Obstacle> obstacle() = 0;
  virtual void refused(double /*time*/, double /*dt*/, const coupling::StepReport& /*why*/) {}  ///< an attempt
  virtual void released(double /*time*/, const std::string& /*cause*/) {}  ///< a fragment of the fluid
};

/// The next step as it is wanted.
struct StepPlan {
  double criterion = 0;  ///< largest dt that stepper and host allow [s]
  double regular = 0;    ///< dt wherever the stop time may be [s]
  double wanted = 0;     ///< dt [s]
  bool last = false;     ///< t_n is the stop time: the step is tried, for what is known at t_n then
  std::string failure;   ///< why there is no step; empty: there is one
};

/// A step that was tried; where it was refused for good, `made.report` has the cause.
struct StepTried {
  StepMade made;
  std::string cure;  ///< of an obstacle
};

class Steps {
 public:
  /// Keeps the references.
  Steps(coupling::Stepper& stepper, LoopState& state, StepHost& host) : stepper_(stepper), state_(state), host_(host) {}

  /// The step from here towards `stop` [s].
  StepPlan plan(double stop);
  /// Tries it, with smaller dt where it is refused.
  StepTried attempt(const StepPlan& plan);
  /// Accepts what was tried last, which was not refused.
  void commit(const StepPlan& plan, const StepMade& made, double stop);

 private:
  coupling::Stepper& stepper_;
  LoopState& state_;
  StepHost& host_;
};

/// The next dt towards an instant `remaining` away: dt itself, or equal parts when two steps or fewer are
/// left, so that no sliver of a step remains.
double fitted_dt(double dt, double remaining);

}  // namespace splashdown::apps
