// Runs members of a class of scenes and holds each against its laws.
//
//   stability_ensemble --command build/release/splashdown --class round_drops --seeds 1:60 --jobs 4
//   stability_ensemble --class slots --seeds 7:7 --print                       (writes the scene, runs nothing)
//   stability_ensemble --class slots --seeds 1:9 --write scenes                (the same into scenes/slots/SEED, with files)
//   stability_ensemble --csv stability.csv --page docs/stability.md           (only writes the page's tables)
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/stability/ensemble/classes.hpp"
#include "tests/stability/ensemble/laws.hpp"
#include "tests/stability/ensemble/table.hpp"
#include "tests/validation/program.hpp"

namespace splashdown::ensemble {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string command, seeds = "1:8";
  std::vector<std::string> classes, changes;
  fs::path scratch = "stability", csv, page, write;
  int jobs = 1;
  double budget = 120;
  bool keep = false, print = false, cut_may_hold = false;
};

/// FROM:TO, both included, or single seeds, with commas between them.
std::vector<std::uint64_t> seeds_of(const std::string& text) {
  std::vector<std::uint64_t> seeds;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    std::istringstream in(part);
    std::uint64_t from = 0, to = 0;
    char colon = 0;
    bool good = static_cast<bool>(in >> from);
    to = from;
    if (good && !in.eof()) good = (in >> colon >> to) && colon == ':';
    if (!good || !in.eof() || to < from)
      throw std::runtime_error(fmt::format("--seeds {}: must be FROM:TO, e.g. 1:60, or a list, e.g. 1:5,9", text));
    for (std::uint64_t seed = from; seed <= to; ++seed) seeds.push_back(seed);
  }
  return seeds;
}

Run run_of(const Member& member, const Options& options) {
  const fs::path home = options.scratch / member.kind / std::to_string(member.seed);
  fs::remove_all(home);
  fs::create_directories(home);
  member.write_to(home);

  Run run;
  run.folder = home / "run";
  const fs::path log = home / "log";
  std::vector<std::string> words{
      options.command, "run",      (home / "scene.toml").string(),   "--out", run.folder.string(), "--threads", "1",
      "--quiet",       "--budget", fmt::format("{}", options.budget)};
  for (const std::string& change : options.changes) words.insert(words.end(), {"--set", change});
  const auto start = std::chrono::steady_clock::now();
  // A budget ends a run between two steps; one that hangs in a step is killed.
  run.exit_code = validation::run_program(words, log, 2 * options.budget + 30);
  run.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  run.log = validation::tail_of(log);
  return run;
}

class Ensemble {
 public:
  explicit Ensemble(const Options& options) : options_(options) {}

  void run(const std::vector<Member>& members) {
    std::atomic<std::size_t> next = 0;
    std::vector<std::thread> workers;
    for (int i = 0; i < options_.jobs; ++i)
      workers.emplace_back([&] {
        for (std::size_t at; (at = next++) < members.size();) one(members[at]);
      });
    for (std::thread& worker : workers) worker.join();
  }

  /// True if all laws held.
  bool conclude() {
    for (auto& [kind, gains] : gains_) {
      // Of few members the largest is all that can be said, and that is judged already.
      if (gains.values.size() < 20) continue;
      const double found = percentile_95(gains.values);
      const bool held = found <= gains.bound;
      fmt::print("{} {}: energy of 95 of 100 members: {:.3g} against {:g}\n", held ? "held" : "FELL", kind, found,
                 gains.bound);
      broken_ = broken_ || !held;
    }
    fmt::print("{} of {} members hold, {} of them refused as they may be, {} cut short\n", held_, all_, refused_, cut_);
    return !broken_;
  }

 private:
  struct Gains {
    double bound = 0;
    std::vector<double> values;
  };

  void one(const Member& member) {
    const Run run = run_of(member, options_);
    Verdict verdict = judge(member, run);
    if (options_.cut_may_hold && run.exit_code == 130)
      std::erase_if(verdict.findings, [](const Finding& f) { return f.law == "ends"; });
    const std::lock_guard guard(mutex_);
    report(member, run, verdict);
    if (!options_.csv.empty()) append_rows(options_.csv, member, run, verdict);
    if (!options_.keep) fs::remove_all(run.folder.parent_path());
  }

  void report(const Member& member, const Run& run, const Verdict& verdict) {
    const bool held = verdict.held();
    ++all_, held_ += held, refused_ += verdict.refused, cut_ += verdict.cut;
    broken_ = broken_ || !held;
    std::string said;
    if (verdict.refused) said = "refused: " + verdict.cause;
    for (const Finding& f : verdict.findings) {
      if (!said.empty()) said += ", ";
      said += fmt::format("{}{} {:.3g}/{:g}", f.held() ? "" : "!", f.law, f.measured, f.bound);
      if (f.law == "energy" && member.laws.energy->in_most > 0) {
        gains_[member.kind].bound = member.laws.energy->in_most;
        gains_[member.kind].values.push_back(f.measured);
      }
    }
    std::replace(said.begin(), said.end(), '\n', ' ');
    fmt::print("{} {} {} [{}] {:.1f} s{}: {}\n", held ? "held" : "FELL", member.kind, member.seed, member.what,
               run.wall_seconds, verdict.cut ? " cut" : "", said);
    if (!held && !verdict.cause.empty()) fmt::print("     {}\n", verdict.cause);
    std::fflush(stdout);
  }

  const Options& options_;
  std::mutex mutex_;
  std::map<std::string, Gains> gains_;
  int all_ = 0, held_ = 0, refused_ = 0, cut_ = 0;
  bool broken_ = false;
};

int run(int argc, char** argv) {
  Options options;
  CLI::App app("Runs random members of classes of scenes and holds each against its laws.");
  std::string known;
  for (const Class& each : classes()) known += "\n  " + each.name + ": " + each.what;
  app.footer("Classes:" + known);
  app.add_option("--command", options.command, "the splashdown program")->check(CLI::ExistingFile);
  app.add_option("--class", options.classes, "class of scenes, 'all' for all of them; may be given several times");
  app.add_option("--seeds", options.seeds, "FROM:TO, both included; lists with commas")->capture_default_str();
  app.add_option("--jobs", options.jobs, "runs at a time")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--budget", options.budget, "wall seconds of a run; one that hangs is killed at twice that and 30 s")
      ->capture_default_str();
  app.add_option("--scratch", options.scratch, "where runs leave their files")->capture_default_str();
  app.add_option("--set", options.changes, "key.path=value, handed on to all runs; laws stay as they are");
  app.add_option("--csv", options.csv, "file that findings are appended to");
  app.add_option("--page", options.page, "page whose tables are written from --csv");
  app.add_flag("--keep", options.keep, "keep the runs' folders");
  app.add_flag("--print", options.print, "write the scenes to the terminal and run nothing");
  app.add_option("--write", options.write, "folder that the scenes are written to; nothing is run");
  app.add_flag("--cut-may-hold", options.cut_may_hold, "a run that its budget stopped is judged by what it did");
  CLI11_PARSE(app, argc, argv);

  const std::vector<std::uint64_t> seeds = seeds_of(options.seeds);
  if (std::find(options.classes.begin(), options.classes.end(), "all") != options.classes.end()) {
    options.classes.clear();
    for (const Class& each : classes()) options.classes.push_back(each.name);
  }
  std::vector<Member> members;
  for (const std::string& name : options.classes)
    for (const std::uint64_t seed : seeds) members.push_back(generate(name, seed));
  if (options.print) {
    for (const Member& member : members)
      fmt::print("# {} {}: {}\n{}\n", member.kind, member.seed, member.what, member.scene);
    return 0;
  }
  if (!options.write.empty()) {
    for (const Member& member : members) {
      const fs::path home = options.write / member.kind / std::to_string(member.seed);
      fs::create_directories(home);
      member.write_to(home);
    }
    return 0;
  }
  if (!members.empty() && options.command.empty()) throw std::runtime_error("--command is needed to run something");
  bool held = true;
  if (!members.empty()) {
    options.command = fs::absolute(options.command).string();
    options.scratch = fs::absolute(options.scratch);
    Ensemble ensemble(options);
    ensemble.run(members);
    held = ensemble.conclude();
  }
  if (!options.page.empty()) write_page(options.csv, options.page);
  return held ? 0 : 1;
}

}  // namespace
}  // namespace splashdown::ensemble

int main(int argc, char** argv) {
  try {
    return splashdown::ensemble::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "stability_ensemble: {}\n", error.what());
    return 2;
  }
}
