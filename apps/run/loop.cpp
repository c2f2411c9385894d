#include "apps/run/loop.hpp"

#include <utility>

namespace splashdown::apps {

LoopEnd run_loop(coupling::Stepper& stepper, LoopState& state, double stop, LoopHost& host) {
  using enum LoopEnd::Status;
  Steps steps(stepper, state, host);
  bool undisturbed = true;  // no step has been shortened for the stop time
  for (;;) {
    const bool last = stepper.time() >= stop;
    if (undisturbed) {
      if (!last)
        if (const auto cause = host.interruption()) {
          host.checkpoint();
          return {interrupted, *cause};
        }
      if (last || state.crawls() || host.checkpoint_due()) host.checkpoint();
    }
    const auto plan = steps.plan(stop);
    if (!plan.failure.empty()) return {failed, plan.failure};
    if (undisturbed && !last && plan.wanted != plan.regular) {
      host.checkpoint();
      undisturbed = false;
    }
    const LoopState before = state;
    const auto tried = steps.attempt(plan);
    if (!tried.made.report.ok()) {
      if (undisturbed) {
        // A run that is continued from here makes these attempts again, and counts them then.
        auto counted = std::exchange(state, before);
        host.checkpoint();
        state = std::move(counted);
      }
      return {failed, tried.made.report.cause, tried.cure};
    }
    host.record(tried.made);
    if (last) return {done, {}};
    steps.commit(plan, tried.made, stop);
  }
}

}  // namespace splashdown::apps
