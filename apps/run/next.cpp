#include "apps/run/next.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/check/cost.hpp"
#include "apps/cli/shell_word.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/statistics/next_step.hpp"

namespace splashdown::apps {
namespace {

using Words = std::vector<std::string>;

constexpr const char* refine_key = "fluid.size.refine=";

double guessed_seconds(const Scene& scene) {
  const auto cost = scene.dimension == 2 ? predicted_cost<2>(scene) : predicted_cost<3>(scene);
  return cost.seconds_to_start + cost.steps * cost.seconds_per_step;
}

/// The --set values of the run without those of a key.
Words without(Words overrides, const std::string& key) {
  std::erase_if(overrides, [&](const std::string& word) { return word.starts_with(key); });
  return overrides;
}

/// What the step changes.
struct Change {
  Words set;   ///< all of the new run's, in the order in which they hold
  Words said;  ///< these but the last, which `option` says
  std::string option;
  bool resumes = false;
};

Change change_of(NextStep& next, const RunOptions& options, const Scene& scene) {
  Change change;
  const auto as = [&](const std::string& key, const std::string& option) {
    change.said = change.set = without(options.overrides, key);
    change.set.push_back(fmt::format("{}{:.3g}", key, next.value));
    change.option = option;
  };
  const double refine = scene.fluid ? scene.fluid->size.refine : 1;
  if (next.cure == NextStep::Cure::finer) {
    next.value *= refine;
    as(refine_key, option_of(next));
  } else if (next.cure == NextStep::Cure::shorter_steps) {
    next.value *= refine;
    as("time.dt_max=", option_of(next));
  } else if (options.until && next.value <= scene.time.end) {
    change.said = change.set = options.overrides;
    change.option = fmt::format("--until {:.3g}", next.value);
  } else {
    as("time.end=", option_of(next));
  }
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
  text += " " + change.option;
  if (options.large) text += " --large";
  if (options.no_report) text += " --no-report";
  return text + (change.resumes ? " --resume" : "");
}

}  // namespace

void complete(std::optional<NextStep>& next, const RunOptions& options, const Scene& scene, double wall_seconds) {
  if (!next) return;
  auto change = change_of(*next, options, scene);
  try {
    const auto file = read_scene(options.scene, change.set);
    // Sizes that are chosen may follow the run's length: then it is another run.
    change.resumes = next->cure == NextStep::Cure::longer && file.chosen.empty();
    const double guess = guessed_seconds(scene), other = guessed_seconds(file.scene);
    if (next->cure == NextStep::Cure::finer && guess > 0 && other > guess) next->seconds = wall_seconds * other / guess;
    if (change.resumes) next->seconds = std::max(0., next->seconds - wall_seconds);
  } catch (const SceneError&) {
    return next.reset();
  }
  next->command = command_of(options, change);
}

}  // namespace splashdown::apps
