// The step loop with a stepper that needs no fluid: exact end times, refused steps, checkpoints, resumption.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include "apps/run/loop.hpp"

namespace splashdown::apps::run_loop_test {
namespace {

/// x' = x^2-like growth of the criterion's speed, so that dt varies from step to step.
class FakeStepper final : public coupling::Stepper {
 public:
  double time() const override { return time_; }
  double stable_dt() const override { return 0.01 / (1 + state_ * state_); }
  coupling::StepReport attempt(double dt) override {
    dt_ = dt;
    return {.cause = refuse ? refuse(time_, dt) : "", .passes = 1, .of_fluid = of_fluid};
  }
  void commit() override {
    state_ += dt_ * std::cos(7 * time_);
    time_ += dt_;
  }
  std::vector<std::pair<std::string, double>> phase_seconds() const override { return {}; }
  void save(std::ostream& out) const override {
    out.write(reinterpret_cast<const char*>(&time_), sizeof time_);
    out.write(reinterpret_cast<const char*>(&state_), sizeof state_);
  }
  void load(std::istream& in) override {
    in.read(reinterpret_cast<char*>(&time_), sizeof time_);
    in.read(reinterpret_cast<char*>(&state_), sizeof state_);
  }

  bool release_fragment() override { return release && release(); }

  std::function<std::string(double, double)> refuse;
  std::function<bool()> release;
  bool of_fluid = true;  // what is refused

 private:
  double time_ = 0, state_ = 0, dt_ = 0;
};

struct Saved {
  std::string stepper;
  LoopState loop;
  std::size_t rows = 0;
};

class FakeHost final : public LoopHost {
 public:
  FakeHost(const FakeStepper& stepper, const LoopState& loop) : stepper_(stepper), loop_(loop) {}
  double dt_bound() const override { return bound_at ? std::min(bound, bound_at(stepper_.time())) : bound; }
  void record(const StepMade& step) override { rows.push_back(step); }
  void refused(double, double, const coupling::StepReport&) override {}
  std::optional<Obstacle> obstacle() override { return in_the_way ? in_the_way(stepper_.time()) : std::nullopt; }
  void released(double, const std::string&) override { ++fragments; }
  bool checkpoint_due() override { return checkpoint_every > 0 && rows.size() % checkpoint_every == 0; }
  void checkpoint() override {
    std::ostringstream out;
    stepper_.save(out);
    saved = {out.str(), loop_, rows.size()};
    ++checkpoints;
  }
  std::optional<std::string> interruption() override {
    if (rows.size() < interrupt_after) return {};
    return "SIGINT";
  }

  std::vector<StepMade> rows;
  Saved saved;
  int checkpoints = 0, fragments = 0;
  double bound = 1;
  std::function<double(double)> bound_at;
  std::function<std::optional<Obstacle>(double)> in_the_way;
  std::size_t checkpoint_every = 0, interrupt_after = 1000000;

 private:
  const FakeStepper& stepper_;
  const LoopState& loop_;
};

struct Story {
  FakeStepper stepper;
  LoopState loop;
  FakeHost host{stepper, loop};
  LoopEnd end;
  void run(double stop) { end = run_loop(stepper, loop, stop, host); }
  void resume(const FakeHost& from) {
    std::istringstream in(from.saved.stepper);
    stepper.load(in);
    loop = from.saved.loop;
    host.rows.assign(from.rows.begin(), from.rows.begin() + static_cast<long>(from.saved.rows));
  }
};

std::vector<double> times(const FakeHost& host) {
  std::vector<double> result;
  for (const auto& row : host.rows) result.push_back(row.time);
  return result;
}

TEST(RunLoop, ends_at_the_stop_time_exactly_with_a_last_row) {
  for (const double stop : {1e-3, 0.1, 0.3, 1. / 3, 1.0}) {
    Story story;
    story.run(stop);
    EXPECT_EQ(story.end.status, LoopEnd::Status::done);
    EXPECT_EQ(story.stepper.time(), stop);
    EXPECT_EQ(story.host.rows.back().time, stop);
    EXPECT_TRUE(story.host.rows.back().last);
    EXPECT_EQ(story.loop.steps + 1, static_cast<long>(story.host.rows.size()));
  }
}

TEST(RunLoop, leaves_no_sliver_before_the_stop_time) {
  EXPECT_EQ(fitted_dt(1, 5), 1);
  EXPECT_EQ(fitted_dt(1, 2), 1);
  EXPECT_EQ(fitted_dt(1, 1.5), 0.75);
  EXPECT_EQ(fitted_dt(1, 1.0001), 0.50005);
  EXPECT_EQ(fitted_dt(1, 1), 1);
  EXPECT_EQ(fitted_dt(1, 0.3), 0.3);
}

TEST(RunLoop, starts_gently_and_never_lengthens_a_step_by_more_than_half) {
  Story story;
  story.run(0.5);
  EXPECT_DOUBLE_EQ(story.host.rows[0].dt, 0.2 * 0.01);
  for (std::size_t i = 1; i < story.host.rows.size(); ++i) {
    EXPECT_EQ(story.host.rows[i].dt_previous, story.host.rows[i - 1].dt);
    EXPECT_LE(story.host.rows[i].dt, 1.5 * story.host.rows[i - 1].dt * (1 + 1e-15));
  }
}

TEST(RunLoop, keeps_to_the_bound_of_its_host) {
  Story story;
  story.host.bound = 0.003;
  story.run(0.5);
  for (const auto& row : story.host.rows) EXPECT_LE(row.dt, 0.003);
}

TEST(RunLoop, halves_a_refused_step_and_counts_the_cause) {
  Story story;
  story.stepper.refuse = [](double time, double dt) {
    return time > 0.1 && time < 0.2 && dt > 0.004 ? "inverted: cell " + std::to_string(time) : "";
  };
  story.run(0.5);
  EXPECT_EQ(story.end.status, LoopEnd::Status::done);
  EXPECT_GT(story.loop.rejected.at("inverted"), 0);
  for (const auto& row : story.host.rows) {
    if (row.time > 0.1 && row.time < 0.2) {
      EXPECT_LE(row.dt, 0.004);
    }
  }
}

TEST(RunLoop, gives_up_with_the_cause_and_a_checkpoint_of_the_last_good_state) {
  Story story;
  story.stepper.refuse = [](double time, double) { return time > 0.1 ? "no fluid" : ""; };
  story.run(0.5);
  EXPECT_EQ(story.end.status, LoopEnd::Status::failed);
  EXPECT_EQ(story.end.cause, "no fluid");
  EXPECT_EQ(story.host.checkpoints, 1);
  FakeStepper saved;
  std::istringstream in(story.host.saved.stepper);
  saved.load(in);
  EXPECT_EQ(saved.time(), story.stepper.time());
  EXPECT_EQ(story.loop.rejected.at("no fluid"), 20);
}

// Short steps may be refused for being short.
TEST(RunLoop, gives_up_with_what_the_wanted_step_was_refused_for) {
  Story story;
  story.stepper.refuse = [](double time, double dt) {
    return time < 0.1 ? "" : dt > 1e-4 ? "the mesh folds" : "passes do not end";
  };
  story.run(0.5);
  EXPECT_EQ(story.end.status, LoopEnd::Status::failed);
  EXPECT_EQ(story.end.cause.find("the mesh folds; with dt = "), 0u) << story.end.cause;
  EXPECT_NE(story.end.cause.find(": passes do not end"), std::string::npos) << story.end.cause;
}

TEST(RunLoop, ends_before_a_step_that_must_not_be_made_with_its_cure) {
  Story story;
  story.host.in_the_way = [](double time) {
    return time > 0.1 ? std::optional<Obstacle>({"through the floor", "add a floor"}) : std::nullopt;
  };
  story.run(0.5);
  EXPECT_EQ(story.end.status, LoopEnd::Status::failed);
  EXPECT_EQ(story.end.cause, "through the floor");
  EXPECT_EQ(story.end.cure, "add a floor");
  EXPECT_EQ(story.host.checkpoints, 1);
  EXPECT_LT(story.host.rows.back().time, story.stepper.time()) << "the step is not recorded";
  EXPECT_TRUE(story.loop.rejected.empty());
  Story again;
  again.host.in_the_way = story.host.in_the_way;
  again.resume(story.host);
  again.run(0.5);
  EXPECT_EQ(again.end.cause, "through the floor");
  EXPECT_EQ(again.stepper.time(), story.stepper.time());
}

TEST(RunLoop, gives_up_where_steps_become_so_short_that_no_end_is_in_sight) {
  Story story;
  story.host.bound_at = [](double time) { return std::max(1e-12, 0.1 * (0.3 - time)); };  // 1 ps from 0.3 s on
  story.run(0.5);
  EXPECT_EQ(story.end.status, LoopEnd::Status::failed);
  EXPECT_NE(story.end.cause.find("too short to go on: 100 in a row"), std::string::npos) << story.end.cause;
  EXPECT_EQ(story.host.checkpoints, 1);
  EXPECT_EQ(story.loop.crawling, 100);
  Story again;
  again.resume(story.host);
  again.run(0.5);
  EXPECT_EQ(again.end.cause, story.end.cause);
  // However near the end is: between walls that close just then, steps may halve with what is left.
  Story closing;
  closing.host.bound_at = [](double time) { return std::max(1e-12, 0.1 * (0.5 - 1e-9 - time)); };
  closing.run(0.5);
  EXPECT_EQ(closing.end.status, LoopEnd::Status::failed);
  // A few of them, as at an impact, are none of its business.
  Story impact;
  int few = 50;  // and fifteen more until they have grown
  impact.host.bound_at = [&](double time) { return time > 0.2 && few-- > 0 ? 1e-12 : 1.; };
  impact.run(0.5);
  EXPECT_EQ(impact.end.status, LoopEnd::Status::done);
  EXPECT_EQ(impact.loop.crawling, 0);
}

// A hundredth of the criterion would do, but it is never got through: hulls in a mechanism near its dead point.
TEST(RunLoop, gives_up_where_no_way_leads_past_a_refused_step) {
  Story story;
  story.stepper.refuse = [](double time, double dt) { return time > 0.3 && dt > 2e-5 ? "no room: at the top" : ""; };
  story.run(0.5);
  EXPECT_EQ(story.end.status, LoopEnd::Status::failed);
  EXPECT_EQ(story.end.cause.find("no room: at the top (101 refusals on the way to 0.3"), 0u) << story.end.cause;
  EXPECT_EQ(story.loop.rejected.at("no room"), story.loop.refused_on_the_way);
  Story again;
  again.stepper.refuse = story.stepper.refuse;
  again.resume(story.host);
  again.run(0.5);
  EXPECT_EQ(again.end.cause, story.end.cause);
  // Hard places that are passed do not add up.
  Story hard;
  hard.stepper.refuse = [](double, double dt) { return dt > 0.0005 ? "no room" : ""; };
  hard.run(0.5);
  EXPECT_EQ(hard.end.status, LoopEnd::Status::done);
  EXPECT_GT(hard.loop.rejected.at("no room"), 300);
}

TEST(RunLoop, lets_a_fragment_go_after_ten_refusals_and_tries_the_same_step_again) {
  for (const bool cures : {true, false}) {
    Story story;
    double refused_dt = 0;
    bool gone = false;
    story.stepper.refuse = [&](double time, double dt) -> std::string {
      if (time < 0.1 || (gone && cures) || time > 0.2) return "";
      refused_dt = std::max(refused_dt, dt);
      return "an element turns over: at 0";
    };
    story.stepper.release = [&] { return !std::exchange(gone, true); };
    story.run(0.5);
    EXPECT_TRUE(gone);
    EXPECT_EQ(story.end.status, cures ? LoopEnd::Status::done : LoopEnd::Status::failed);
    EXPECT_EQ(story.loop.rejected.at("an element turns over"), cures ? 10 : 20);
    EXPECT_EQ(story.loop.released, 1);
    EXPECT_EQ(story.host.fragments, 1);
    const auto made = std::ranges::find_if(story.host.rows, [](const StepMade& row) { return row.time >= 0.1; });
    if (cures) {
      EXPECT_EQ(made->dt, refused_dt);
    } else {
      EXPECT_EQ(made, story.host.rows.end());
      EXPECT_EQ(story.host.saved.loop.released, 0) << "a run that is continued from there lets it go again";
    }
  }
}

TEST(RunLoop, lets_no_fragment_go_for_what_is_not_the_fluids_fault) {
  Story story;
  story.stepper.of_fluid = false;
  story.stepper.refuse = [](double time, double) {
    return time < 0.1 ? "" : "the coupling did not converge: residual 1";
  };
  story.stepper.release = [] {
    ADD_FAILURE() << "a wild last pass is no reason";
    return true;
  };
  story.run(0.5);
  EXPECT_EQ(story.end.status, LoopEnd::Status::failed);
  EXPECT_EQ(story.loop.rejected.at("the coupling did not converge"), 20);
}

TEST(RunLoop, takes_an_exception_of_an_attempt_for_a_refusal) {
  Story story;
  bool once = false;
  story.stepper.refuse = [&](double time, double) -> std::string {
    if (time > 0.1 && !std::exchange(once, true)) throw std::runtime_error("out of luck");
    return "";
  };
  story.run(0.2);
  EXPECT_EQ(story.end.status, LoopEnd::Status::done);
  EXPECT_EQ(story.loop.rejected.at("out of luck"), 1);
}

TEST(RunLoop, a_run_continued_from_any_checkpoint_makes_the_same_steps) {
  Story whole;
  whole.run(0.5);
  for (const std::size_t stop_after : {0, 1, 7, 30}) {
    Story first, second;
    first.host.interrupt_after = stop_after;
    first.run(0.5);
    EXPECT_EQ(first.end.status, LoopEnd::Status::interrupted);
    EXPECT_EQ(first.end.cause, "SIGINT");
    second.resume(first.host);
    second.run(0.5);
    EXPECT_EQ(times(second.host), times(whole.host));
  }
}

TEST(RunLoop, a_run_stopped_at_a_time_and_continued_makes_the_steps_of_one_that_was_not) {
  Story whole;
  whole.run(0.5);
  for (const double until : {1e-4, 0.1, 0.25, 0.4999}) {
    Story first, second;
    first.run(until);
    EXPECT_EQ(first.stepper.time(), until);
    second.resume(first.host);
    second.run(0.5);
    EXPECT_EQ(times(second.host), times(whole.host)) << until;
  }
}

TEST(RunLoop, checkpoints_change_nothing) {
  Story without, with;
  with.host.checkpoint_every = 3;
  without.run(0.5);
  with.run(0.5);
  EXPECT_GT(with.host.checkpoints, 10);
  EXPECT_EQ(times(with.host), times(without.host));
}

}  // namespace
}  // namespace splashdown::apps::run_loop_test
