#include "apps/run/loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace splashdown::apps {
namespace {

// The first step sees the scene as it was drawn: node spacing and pressure have not met yet (docs/design-notes).
constexpr double first_share = 0.2;
// The leapfrog kick is the mean of two steps; neighbours of similar length keep its second order.
constexpr double growth = 1.5;
// Ten halvings: what they do not cure, a fragment of the water may be the cause of, which goes its own way from there.
constexpr int refusals_for_release = 10;
// Twenty: what no dt of that size cures is no matter of dt.
constexpr int most_refusals = 20;
constexpr double smallest_share = 1e-6;
// A day at a millisecond a step. An impact may be as short for a few steps.
constexpr double never = 1e-8;

struct Attempt {
  coupling::StepReport report;
  double dt = 0;
};

/// What kind of refusal it is: causes carry their numbers behind a colon.
std::string kind_of(const std::string& cause) { return cause.substr(0, cause.find(": ")); }

coupling::StepReport attempt(coupling::Stepper& stepper, double dt) {
  try {
    return stepper.attempt(dt);
  } catch (const std::exception& error) {
    return {.cause = error.what()};
  }
}

/// Halves dt until the step is accepted, or not worth trying.
Attempt attempt_with_cuts(coupling::Stepper& stepper, double dt, double criterion, LoopState& state, LoopHost& host) {
  const double wanted = dt;
  for (int refusals = 1;; ++refusals, dt *= 0.5) {
    auto report = attempt(stepper, dt);
    if (report.ok()) return {std::move(report), dt};
    ++state.rejected[kind_of(report.cause)];
    if (stepper.time() >= state.refused_end) state.refused_end = stepper.time() + dt, state.refused_on_the_way = 0;
    ++state.refused_on_the_way;
    host.refused(stepper.time(), dt, report.cause);
    if (state.is_stuck())
      report.cause += fmt::format(" ({} refusals on the way to {:.9g} s, {:.1e} s from here)", state.refused_on_the_way,
                                  state.refused_end, state.refused_end - stepper.time());
    if (dt < smallest_share * criterion || refusals == most_refusals || state.is_stuck())
      return {std::move(report), dt};
    if (refusals == refusals_for_release && report.of_fluid && stepper.release_fragment()) {
      ++state.released;
      state.refused_on_the_way = 0;  // other water
      host.released(stepper.time(), report.cause);
      dt = 2 * wanted;
    }
  }
}

}  // namespace

double fitted_dt(double dt, double remaining) {
  if (remaining <= dt) return remaining;
  return remaining < 2 * dt ? 0.5 * remaining : dt;
}

LoopEnd run_loop(coupling::Stepper& stepper, LoopState& state, double stop, LoopHost& host) {
  using enum LoopEnd::Status;
  bool undisturbed = true;  // no step has been shortened for the stop time
  for (;;) {
    const double time = stepper.time();
    const bool last = time >= stop;
    if (undisturbed) {
      if (!last)
        if (const auto cause = host.interruption()) {
          host.checkpoint();
          return {interrupted, *cause};
        }
      if (last || state.crawls() || host.checkpoint_due()) host.checkpoint();
    }

    if (!last && state.crawls())
      return {
          failed,
          fmt::format("the steps have become too short to go on: {} in a row of {:.1e} s and less, with {:.2g} s left. "
                      "Water moves too fast for longer ones, as where a gap closes",
                      state.crawling, state.dt_previous, stop - time)};
    const double criterion = std::min(stepper.stable_dt(), host.dt_bound());
    if (!(criterion > 0 && std::isfinite(criterion)))
      return {failed, fmt::format("the time-step criterion gives dt = {} s", criterion)};
    if (state.dt_cap == 0) state.dt_cap = first_share * criterion;
    const double regular = std::min(criterion, state.dt_cap);
    // The step that gives the last row is not taken: it need not be longer than the one before.
    const double closing = state.dt_previous > 0 ? std::min(regular, state.dt_previous) : regular;
    const double wanted = last ? closing : fitted_dt(regular, stop - time);
    if (undisturbed && !last && wanted != regular) {
      host.checkpoint();
      undisturbed = false;
    }

    const LoopState before = state;
    auto step = attempt_with_cuts(stepper, wanted, criterion, state, host);
    std::string cure;
    if (auto obstacle = step.report.ok() && !last ? host.obstacle() : std::nullopt) {
      step.report.cause = std::move(obstacle->cause);
      cure = std::move(obstacle->cure);
    }
    if (!step.report.ok()) {
      if (undisturbed) {
        // A run that is continued from here makes these attempts again, and counts them then.
        auto counted = std::exchange(state, before);
        host.checkpoint();
        state = std::move(counted);
      }
      return {failed, step.report.cause, cure};
    }
    host.record({time, step.dt, state.dt_previous, step.report, last});
    if (last) return {done, {}};
    stepper.commit();
    ++state.steps;
    state.crawling = step.dt < never * stop ? state.crawling + 1 : 0;
    state.dt_previous = step.dt;
    state.dt_cap = growth * (step.dt < wanted ? step.dt : regular);
  }
}

}  // namespace splashdown::apps
