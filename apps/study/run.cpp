#include "apps/study/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <deque>
#include <list>
#include <thread>

#include "apps/files/folder_lock.hpp"
#include "apps/process/child_process.hpp"
#include "apps/process/exit.hpp"
#include "apps/process/interrupt.hpp"
#include "apps/process/renewed_line.hpp"
#include "apps/study/campaign/envelope.hpp"
#include "apps/study/campaign/results.hpp"
#include "apps/study/folder.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double most_share_of_tables = 0.02;  // of the time

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// A run that outlived a killed study still writes in its folder, until it has saved its checkpoint.
bool is_busy(const fs::path& folder) {
  if (!fs::exists(folder)) return false;
  try {
    const FolderLock lock(folder, std::chrono::milliseconds(0));
    return false;
  } catch (const std::runtime_error&) {
    return true;
  }
}

class Runner {
 public:
  Runner(const Study& study, const std::vector<StudyRun>& runs, std::vector<Outcome>& outcomes, fs::path folder,
         int jobs, bool quiet)
      : study_(study),
        runs_(runs),
        outcomes_(outcomes),
        folder_(std::move(folder)),
        jobs_(static_cast<std::size_t>(jobs)),
        quiet_(quiet),
        line_(!quiet && RenewedLine::is_terminal()) {
    for (std::size_t i = 0; i < runs.size(); ++i)
      if (!outcomes[i].finished())
        queue_.push_back(i);
      else if (answers_at_once())
        measure_run(study, runs[i], folder_ / runs[i].name, outcomes[i]);
    before_ = runs.size() - queue_.size();
  }

  RunnerEnd go() {
    if (before_ > 0) say(fmt::format("{} of {} runs are finished and stay as they are", before_, runs_.size()));
    write_tables(study_, runs_, outcomes_, folder_);
    while (!running_.empty() || !queue_.empty()) {
      if (interrupt_received() && !end_.interrupted) stop();
      start_what_fits();
      collect();
      show();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    line_.clear();
    return std::move(end_);
  }

 private:
  struct Running {
    std::size_t run;
    ChildProcess process;
  };

  fs::path log_of(std::size_t i) const { return folder_ / (runs_[i].name + ".log"); }

  /// Whether a run's answer decides on the next one.
  bool answers_at_once() const { return study_.stop || study_.envelope; }

  /// The next run of the queue, or with an envelope the one that tells most about it; nothing: none for now.
  std::optional<std::size_t> take() {
    auto chosen = queue_.begin();
    if (study_.envelope) {
      if (waits_for_an_end_) return {};
      const auto begun =
          std::ranges::find(queue_, Outcome::Status::interrupted, [&](std::size_t i) { return outcomes_[i].status; });
      chosen = begun != queue_.end() ? begun : std::ranges::find(queue_, most_telling().value_or(runs_.size()));
      if (chosen == queue_.end()) {
        waits_for_an_end_ = true;
        if (running_.empty()) enough();
        return {};
      }
    }
    const std::size_t i = *chosen;
    queue_.erase(chosen);
    return i;
  }

  std::optional<std::size_t> most_telling() const {
    if (before_ + made_ + running_.size() >= static_cast<std::size_t>(study_.envelope->runs)) return {};
    std::vector<std::size_t> at_work;
    for (const auto& running : running_) at_work.push_back(running.run);
    return EnvelopePlane(study_, runs_, outcomes_, at_work).next();
  }

  /// An envelope leaves most of the plane's runs out.
  std::size_t most_runs_made() const {
    return study_.envelope ? std::min(runs_.size(), static_cast<std::size_t>(study_.envelope->runs)) : runs_.size();
  }

  void enough() {
    queue_.clear();
    end_.enough = true;
  }

  void start_what_fits() {
    busy_ = 0;
    for (std::size_t tries = queue_.size(); tries > 0 && running_.size() < jobs_; --tries) {
      const auto next = take();
      if (!next) return;
      const std::size_t i = *next;
      const auto place = folder_ / runs_[i].name;
      if (is_busy(place)) {
        ++busy_;
        queue_.push_back(i);
        continue;
      }
      prepare(runs_[i], place);
      fs::remove(log_of(i));
      running_.push_back({i, ChildProcess(command_of(study_, runs_[i], place), log_of(i))});
    }
  }

  void collect() {
    for (auto it = running_.begin(); it != running_.end();) {
      if (const auto end = it->process.end()) {
        conclude(it->run, *end);
        it = running_.erase(it);
      } else {
        ++it;
      }
    }
  }

  void conclude(std::size_t i, const ChildProcess::End& end) {
    const auto& name = runs_[i].name;
    auto& outcome = outcomes_[i];
    outcome = outcome_of(study_, runs_[i], folder_ / name);
    if (!outcome.finished() && end.code != exit_code::interrupted) {
      outcome.cause = end.signal != 0 ? fmt::format("ended by signal {} ({})", end.signal, ::strsignal(end.signal))
                                      : fmt::format("exit code {}: {}", end.code, last_line(log_of(i)));
      // Whoever kills a run, the machine when memory is short included, may want it to go on later.
      outcome.status = end.signal != 0 ? Outcome::Status::interrupted : Outcome::Status::failed;
      end_.unable.push_back(name + ": " + outcome.cause);
    }
    if (end.code == exit_code::interrupted && study_.budget && !interrupt_received() &&
        !fs::exists(folder_ / name / "summary.json")) {
      outcome.status = Outcome::Status::stalled;
      outcome.cause = "the budget is spent before the first mesh is ready";
    }
    ++made_;
    last_end_ = Clock::now();
    waits_for_an_end_ = false;
    if (answers_at_once()) measure_run(study_, runs_[i], folder_ / name, outcome);
    if (is_enough()) enough();
    // What a run says about its coupling stands in its summary.
    if (outcome.finished() && outcome.status != Outcome::Status::failed) fs::remove(log_of(i));
    auto text = fmt::format("[{}/{}] {}: {}", before_ + made_, most_runs_made(), name, word(outcome.status));
    if (!outcome.verdict.empty()) text += ", " + outcome.verdict;
    const auto number = [&](const char* column, const char* format) {
      if (const auto found = outcome.numbers.find(column); found != outcome.numbers.end())
        text += fmt::format(fmt::runtime(format), found->second);
    };
    number("passes_mean", ", {:.3g} passes");
    number("wall_seconds", ", {:.3g} s");
    say(text);
    keep_tables();
  }

  /// Tables grow with the study: they are written anew as long as that takes a small share of the time.
  void keep_tables() {
    if (seconds_since(tables_at_) < seconds_of_tables_ / most_share_of_tables && !queue_.empty()) return;
    const auto begin = Clock::now();
    write_tables(study_, runs_, outcomes_, folder_);
    tables_at_ = Clock::now();
    seconds_of_tables_ = seconds_since(begin);
  }

  /// Whether the band that the study is for is narrow enough.
  bool is_enough() {
    if (!study_.stop || queue_.empty()) return false;
    const auto width = width_of(*study_.stop, study_, runs_, outcomes_);
    return width && *width <= study_.stop->width;
  }

  void stop() {
    end_.interrupted = true;
    queue_.clear();
    for (const auto& running : running_) running.process.ask_to_stop();
    say("stopping: the runs save their checkpoints");
  }

  void say(const std::string& text) {
    if (quiet_) return;
    line_.clear();
    fmt::print("{}\n", text);
    std::fflush(stdout);
  }

  /// On a terminal one line that renews itself; elsewhere the lines of finished runs are enough.
  void show() {
    if (!line_.is_due()) return;
    auto text =
        fmt::format("{:3.0f} %  {} of {} runs, {} at work", 100. * double(before_ + made_) / double(most_runs_made()),
                    before_ + made_, most_runs_made(), running_.size());
    if (made_ > 0) {
      const double between = std::chrono::duration<double>(last_end_ - started_).count() / double(made_);
      text += "  left " +
              clock_text(study_time_left(between, most_runs_made() - std::min(most_runs_made(), before_ + made_),
                                         seconds_since(last_end_)));
    }
    if (running_.empty() && busy_ > 0) text += fmt::format("  ({} still written by a study that was killed)", busy_);
    line_.show(text);
  }

  const Study& study_;
  const std::vector<StudyRun>& runs_;
  std::vector<Outcome>& outcomes_;
  fs::path folder_;
  std::size_t jobs_;
  bool quiet_;
  RenewedLine line_;
  std::deque<std::size_t> queue_;
  std::list<Running> running_;
  std::size_t before_ = 0, made_ = 0, busy_ = 0;
  bool waits_for_an_end_ = false;  // of a run, before an envelope chooses another one
  RunnerEnd end_;
  double seconds_of_tables_ = 0;
  Clock::time_point tables_at_{};
  Clock::time_point started_ = Clock::now(), last_end_ = started_;
};

}  // namespace

double study_time_left(double between, std::size_t runs, double since) {
  // The next end is due; what has been waited for it is no longer left.
  return std::max(0., between * static_cast<double>(runs) - std::min(since, between));
}

std::vector<std::string> command_of(const Study& study, const StudyRun& run, const fs::path& folder) {
  std::vector<std::string> words = {
      own_program().string(), "run", study.scene.string(), "--out", folder.string(), "--resume", "--quiet"};
  if (study.threads) words.insert(words.end(), {"--threads", fmt::format("{}", *study.threads)});
  if (study.until) words.insert(words.end(), {"--until", fmt::format("{}", *study.until)});
  if (study.large) words.emplace_back("--large");
  if (!study.reports) words.emplace_back("--no-report");
  if (study.budget) words.insert(words.end(), {"--budget", fmt::format("{}", *study.budget)});
  for (const auto& argument : run.set) words.insert(words.end(), {"--set", argument});
  return words;
}

int exit_code_of(const std::vector<Outcome>& outcomes, bool interrupted) {
  const auto any = [&](Outcome::Status status) {
    return std::ranges::any_of(outcomes, [=](const auto& o) { return o.status == status; });
  };
  if (interrupted) return exit_code::interrupted;
  if (any(Outcome::Status::failed) || any(Outcome::Status::interrupted)) return exit_code::cannot_go_on;
  return exit_code::done;
}

RunnerEnd make_runs(const Study& study, const std::vector<StudyRun>& runs, std::vector<Outcome>& outcomes,
                    const fs::path& folder, int jobs, bool quiet) {
  return Runner(study, runs, outcomes, folder, jobs, quiet).go();
}

}  // namespace splashdown::apps
