#include "apps/run/next.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/check/cost.hpp"
#include "apps/scene/choose/refine.hpp"
#include "apps/scene/read/override.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/statistics/verdict/next_step.hpp"
#include "apps/text/shell_word.hpp"

namespace splashdown::apps {
namespace {

using Words = std::vector<std::string>;

constexpr const char* refine_key = "fluid.size.refine=";

/// What all of them set.
Words said_values(const Words& overrides) {
  Words said;
  for (const auto& word : overrides) said.push_back(override_of(word).argument);
  return said;
}

/// The --set values of the run without those of a key.
Words without(Words overrides, const std::string& key) {
  std::erase_if(overrides, [&](const std::string& word) { return word.starts_with(key); });
  return overrides;
}

/// What the step changes.
struct Change {
  Words said;  ///< --set values that stay
  Words set;   ///< all of the new run's
  std::string options;
  bool resumes = false;
};

/// Values become those of the command line, where refine divides dt_max, too.
Change change_of(NextStep& next, const RunOptions& options, const Scene& scene) {
  Change change;
  change.said = said_values(options.overrides);
  const double refine = refine_of(scene);
  Words added;
  const auto add = [&](double value, const std::string& key) {
    if (!(value > 0)) return;
    change.said = without(change.said, key);
    added.push_back(fmt::format("{}{:.3g}", key, value));
  };
  if (next.dt_max > 0) next.dt_max *= refine * std::max(1., next.refine);
  if (next.refine > 0) next.refine *= refine;
  add(next.refine, refine_key);
  add(next.dt_max, "time.dt_max=");
  if (options.until && next.end > 0 && next.end <= scene.time.end) {
    change.options = fmt::format("--until {:.3g}", next.end);
  } else {
    add(next.end, "time.end=");
    change.options = options_of(next);
  }
  change.set = change.said;
  change.set.insert(change.set.end(), added.begin(), added.end());
  return change;
}

/// A refine that the aims of a run chose is said as they would be.
std::string command_of(const RunOptions& options, const Change& change) {
  auto text = fmt::format("splashdown run {}", shell_word(options.scene.string()));
  if (options.out) text += " --out " + shell_word(options.out->string());
  for (const auto& word : change.said)
    text += word.starts_with(refine_key) ? " --refine " + shell_word(word.substr(std::string(refine_key).size()))
                                         : " --set " + shell_word(word);
  if (options.threads) text += fmt::format(" --threads {}", *options.threads);
  if (!change.options.empty()) text += " " + change.options;
  if (options.large) text += " --large";
  if (options.no_report) text += " --no-report";
  return text + (change.resumes ? " --resume" : "");
}

}  // namespace

std::string command_of(const RunOptions& options) {
  Change change;
  change.said = said_values(options.overrides);
  if (options.until) change.options = fmt::format("--until {:g}", *options.until);
  return command_of(options, change);
}

void complete(std::optional<NextStep>& next, const RunOptions& options, const Scene& scene, double wall_seconds) {
  if (!next) return;
  auto change = change_of(*next, options, scene);
  try {
    const auto file = read_scene(options.scene, change.set);
    // Sizes that are chosen may follow the run's length: then it is another run.
    change.resumes = next->end > 0 && file.chosen.empty();
    const double guess = predicted_seconds(scene), other = predicted_seconds(file.scene);
    if (!(next->end > 0) && guess > 0 && other > guess) next->seconds = wall_seconds * other / guess;
    if (change.resumes) next->seconds = std::max(0., next->seconds - wall_seconds);
  } catch (const SceneError&) {
    return next.reset();
  }
  next->command = command_of(options, change);
}

}  // namespace splashdown::apps
