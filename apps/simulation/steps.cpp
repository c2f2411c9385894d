#include "apps/simulation/steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
Attempt attempt_with_cuts(coupling::Stepper& stepper, double dt, double criterion, LoopState& state, StepHost& host) {
  const double wanted = dt;
  std::string first;  // what the step as it was wanted is refused for: later ones may be so for being too short
  for (int refusals = 1;; ++refusals, dt *= 0.5) {
    auto report = attempt(stepper, dt);
    if (report.ok()) return {std::move(report), dt};
    ++state.rejected[kind_of(report.cause)];
    if (refusals == 1) first = report.cause;
    if (stepper.time() >= state.refused_end) state.refused_end = stepper.time() + dt, state.refused_on_the_way = 0;
    ++state.refused_on_the_way;
    host.refused(stepper.time(), dt, report);
    if (state.is_stuck())
      report.cause += fmt::format(" ({} refusals on the way to {:.9g} s, {:.1e} s from here)", state.refused_on_the_way,
                                  state.refused_end, state.refused_end - stepper.time());
    if (dt < smallest_share * criterion || refusals == most_refusals || state.is_stuck()) {
      if (kind_of(first) != kind_of(report.cause))
        report.cause = fmt::format("{}; with dt = {:.1e} s: {}", first, dt, report.cause);
      return {std::move(report), dt};
    }
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

StepPlan Steps::plan(double stop) {
  const double time = stepper_.time();
  StepPlan plan;
  plan.last = time >= stop;
  if (!plan.last && state_.crawls()) {
    plan.failure = fmt::format(
        "the steps have become too short to go on: {} in a row of {:.1e} s and less, with {:.2g} s left. "
        "Water moves too fast for longer ones, as where a gap closes",
        state_.crawling, state_.dt_previous, stop - time);
    return plan;
  }
  plan.criterion = std::min(stepper_.stable_dt(), host_.dt_bound());
  if (!(plan.criterion > 0 && std::isfinite(plan.criterion))) {
    plan.failure = fmt::format("the time-step criterion gives dt = {} s", plan.criterion);
    return plan;
  }
  if (state_.dt_cap == 0) state_.dt_cap = first_share * plan.criterion;
  plan.regular = std::min(plan.criterion, state_.dt_cap);
  // The step that gives the last row is not taken: it need not be longer than the one before.
  const double closing = state_.dt_previous > 0 ? std::min(plan.regular, state_.dt_previous) : plan.regular;
  plan.wanted = plan.last ? closing : fitted_dt(plan.regular, stop - time);
  return plan;
}

StepTried Steps::attempt(const StepPlan& plan) {
  const double time = stepper_.time();
  auto step = attempt_with_cuts(stepper_, plan.wanted, plan.criterion, state_, host_);
  std::string cure;
  if (auto obstacle = step.report.ok() && !plan.last ? host_.obstacle() : std::nullopt) {
    step.report.cause = std::move(obstacle->cause);
    cure = std::move(obstacle->cure);
  }
  return {{time, step.dt, state_.dt_previous, std::move(step.report), plan.last}, std::move(cure)};
}

void Steps::commit(const StepPlan& plan, const StepMade& made, double stop) {
  stepper_.commit();
  ++state_.steps;
  state_.crawling = made.dt < never * stop ? state_.crawling + 1 : 0;
  state_.dt_previous = made.dt;
  state_.dt_cap = growth * (made.dt < plan.wanted ? made.dt : plan.regular);
}

}  // namespace splashdown::apps
