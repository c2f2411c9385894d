#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "apps/quantity/expression.hpp"
#include "apps/scene/read/echo.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/study/folder.hpp"
#include "apps/study/study.hpp"

namespace splashdown::apps {
namespace {

/// A value as part of a folder's name. Numbers carry their axis, words speak for themselves.
std::string word_of(const Axis& axis, const AxisValue& value) {
  return value.number ? axis.name + "-" + value.text : value.text;
}

/// The place of what `message` complains about, if that is a --set argument of this run, and the message
/// without the argument.
std::optional<std::pair<Place, std::string>> origin(const Study& study, const StudyRun& run,
                                                    const std::string& message) {
  const auto blamed = [&](const std::vector<std::string>& set) -> std::optional<std::string> {
    for (const auto& argument : set)
      if (const auto start = "--set " + argument + ": "; message.starts_with(start))
        return argument + ": " + message.substr(start.size());
    return {};
  };
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const auto& axis = study.axes[a];
    const auto& value = axis.values[run.value[a]];
    if (auto text = blamed(value.set)) return std::pair(value.place, "axis." + axis.name + ": " + *text);
  }
  for (std::size_t k = 0; k < study.derived.size() && study.derived.size() <= run.set.size(); ++k)
    if (auto text = blamed({run.set[run.set.size() - study.derived.size() + k]}))
      return std::pair(study.derived[k].place, "derived: " + *text);
  if (auto text = blamed(study.set)) return std::pair(Place{study.file.string(), 1}, "set: " + *text);
  return {};
}

/// The axes that vary by themselves; all others go with one of them, or with the product of some.
std::vector<std::size_t> leaders_of(const Study& study) {
  std::vector<std::size_t> leaders;
  for (std::size_t a = 0; a < study.axes.size(); ++a)
    if (study.axes[a].leader == a && study.axes[a].product.empty()) leaders.push_back(a);
  return leaders;
}

/// Of an axis, where leaders stand at these.
std::size_t index_of(const Study& study, std::size_t axis, const std::vector<std::size_t>& leaders) {
  const std::size_t leader = study.axes[axis].leader;
  const auto& product = study.axes[leader].product;
  if (product.empty()) return leaders[leader];
  const auto lows = std::ranges::count_if(product, [&](std::size_t of) { return leaders[of] == 0; });
  return lows % 2 == 0 ? 1 : 0;  // the sign of the product is +1
}

/// Mistakes at their place in the study file, and those of the scene itself, whose messages carry their own place.
struct Findings {
  explicit Findings(const Study& study) : problems(study.file.string()) {}

  void throw_if_any(std::vector<std::string> messages) const {
    for (auto& message : problems.messages()) messages.push_back(std::move(message));
    messages.insert(messages.end(), elsewhere.begin(), elsewhere.end());
    if (!messages.empty()) throw SceneError(std::move(messages));
  }

  Problems problems;
  std::set<std::string> told;
  std::vector<std::string> elsewhere;
};

/// Of "axis.NAME: KEY=VALUE: KEY = VALUE: RULE": what has nothing to do with the value.
std::string rule_of(const std::string& text) {
  const auto argument = text.find(": ") + 2, said = text.find(": ", argument) + 2;
  const auto key = text.substr(argument, text.find('=', argument) - argument) + " = ";
  const auto rule = text.compare(said, key.size(), key) == 0 ? text.find(": ", said) : said;
  return text.substr(rule == std::string::npos ? said : rule);
}

/// For an axis of numbers whose key takes a list.
std::string hint_for(const std::string& text) {
  const auto key = text.find(": ") + 2;
  if (text.find("must be a list of") == std::string::npos || text.find("not a number") == std::string::npos) return {};
  return fmt::format(" An axis of numbers sets one of its entries: key = \"{}.0\" is the first.",
                     text.substr(key, text.find('=', key) - key));
}

/// The scene of the first run that is one.
std::optional<Scene> resolve_into(const Study& study, std::vector<StudyRun>& runs, Findings& findings) {
  std::optional<Scene> first;
  for (auto& run : runs) {
    try {
      auto file = read_scene(study.scene, run.set);
      run.resolved = std::move(file.resolved);
      const double end = file.scene.time.end;
      run.stop = study.until.value_or(end);
      if (run.stop > end && findings.told.insert("until").second)
        findings.problems.add_at(
            study.until_place,
            fmt::format(
                "until = {:g}: must not exceed time.end = {:g} s of {}. Use set = [\"time.end={:g}\"] for longer "
                "runs.",
                run.stop, end, run.name, run.stop));
      if (!first) first = std::move(file.scene);
    } catch (const SceneError& error) {
      for (const auto& message : error.messages()) {
        if (const auto place = origin(study, run, message)) {
          // What has nothing to do with the value is the same for all values of the axis.
          const auto& [where, text] = *place;
          if (findings.told.insert(fmt::format("{}:{}", where.line, rule_of(text))).second)
            findings.problems.add_at(where, text + hint_for(text));
        } else if (findings.told.insert(message).second) {
          findings.elsewhere.push_back(message);
        }
      }
    }
  }
  return first;
}

/// The scene that quantities are judged by if no run has one.
std::optional<Scene> scene_without_axes(const Study& study) {
  for (const auto& set : {study.set, std::vector<std::string>{}}) {
    try {
      return read_scene(study.scene, set).scene;
    } catch (const SceneError&) {  // told for the runs
    }
  }
  return {};
}

/// The value of a derived key in a run.
double derived_number(const Study& study, const DerivedKey& derived, const StudyRun& run) {
  return quantity::evaluate_number(derived.value, [&](const std::string& name) -> std::optional<quantity::Value> {
    if (const auto found = study.constants.find(name); found != study.constants.end())
      return quantity::Value::number(found->second);
    const auto axis = std::ranges::find(study.axes, name, &Axis::name);
    if (axis == study.axes.end()) return {};
    const auto& value = axis->values[run.value[static_cast<std::size_t>(axis - study.axes.begin())]];
    if (!value.number) return {};
    return quantity::Value::number(*value.number);
  });
}

void add_derived(const Study& study, StudyRun& run, Problems& problems) {
  for (const auto& derived : study.derived) {
    std::string fault = "has no finite value";
    double number = NAN;
    try {
      number = derived_number(study, derived, run);
    } catch (const std::runtime_error& error) {
      fault = error.what();
    }
    if (!std::isfinite(number))
      problems.add_at(derived.place, fmt::format("derived.{} = {}: in the run {}: {}. Use another expression.",
                                                 derived.key, toml_text(derived.value), run.name, fault));
    run.set.push_back(derived.key + "=" + toml_text(number));
  }
}

/// What can be expanded while mistakes are sought; without any it is the study itself.
Study without_empty_axes(Study study) {
  std::vector<std::size_t> now;
  std::vector<Axis> kept;
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    Axis axis = study.axes[a];
    const auto& leader = study.axes[axis.leader];
    const bool alone = axis.leader == a || leader.values.size() != axis.values.size();
    now.push_back(kept.size());
    axis.leader = alone ? kept.size() : now[axis.leader];
    if (std::ranges::any_of(axis.product, [&](std::size_t of) { return study.axes[of].values.empty(); }))
      axis.product.clear();
    for (auto& of : axis.product) of = now[of];
    if (!axis.values.empty()) kept.push_back(std::move(axis));
  }
  // What derived keys name may be gone.
  if (kept.size() != study.axes.size()) study.derived.clear();
  study.axes = std::move(kept);
  return study;
}

}  // namespace

bool Axis::is_of_numbers() const {
  return std::ranges::all_of(values, [](const AxisValue& value) { return value.number.has_value(); });
}

std::optional<std::size_t> Axis::find(const std::string& text) const {
  const auto found = std::ranges::find(values, text, &AxisValue::text);
  if (found == values.end()) return {};
  return static_cast<std::size_t>(found - values.begin());
}

std::vector<StudyRun> expand(const Study& study) {
  const auto leaders = leaders_of(study);
  double combinations = 1;
  std::string factors;
  for (const std::size_t a : leaders) {
    const auto& axis = study.axes[a];
    combinations *= static_cast<double>(axis.values.size());
    factors += fmt::format("{}{} of {}", factors.empty() ? "" : ", ", axis.values.size(), axis.name);
  }
  if (combinations > most_runs)
    throw SceneError(
        {fmt::format("{}: axis: {:g} combinations ({}), more than {} runs. Use fewer values, or several "
                     "studies.",
                     study.file.string(), combinations, factors, most_runs)});
  std::vector<StudyRun> runs;
  std::set<std::string> names;
  Problems problems(study.file.string());
  std::vector<std::size_t> index(study.axes.size(), 0);  // of leaders; others follow theirs
  for (;;) {
    StudyRun run{.name = {}, .value = index, .set = study.set, .resolved = {}};
    for (std::size_t a = 0; a < index.size(); ++a) {
      run.value[a] = index_of(study, a, index);
      const auto& value = study.axes[a].values[run.value[a]];
      if (a > 0) run.name += '_';
      run.name += word_of(study.axes[a], value);
      run.set.insert(run.set.end(), value.set.begin(), value.set.end());
    }
    run.name = safe_component(run.name);
    const auto plain = run.name;
    for (int n = 2; !names.insert(run.name).second; ++n) run.name = fmt::format("{}_{}", plain, n);
    if (problems.empty()) add_derived(study, run, problems);  // one run that has none says enough
    runs.push_back(std::move(run));
    std::size_t k = leaders.size();
    while (k > 0 && ++index[leaders[k - 1]] == study.axes[leaders[k - 1]].values.size()) index[leaders[--k]] = 0;
    if (k == 0) break;
  }
  problems.throw_if_any();
  return runs;
}

void resolve(const Study& study, std::vector<StudyRun>& runs) {
  Findings findings(study);
  resolve_into(study, runs, findings);
  findings.throw_if_any({});
}

StudyPlan plan_study(const std::filesystem::path& file) {
  Problems problems(file.string());
  StudyPlan plan{.study = read_study(file, problems), .runs = {}};
  // Axes without values are told already; the others are judged without them.
  const Study study = without_empty_axes(plan.study);
  Findings findings(study);
  if (!study.axes.empty() && !problems.found_in("scene") && std::filesystem::is_regular_file(study.scene)) {
    try {
      plan.runs = expand(study);
      auto scene = resolve_into(study, plan.runs, findings);
      if (!scene) scene = scene_without_axes(study);
      if (scene) check_quantities(plan.study, *scene, findings.problems);
    } catch (const SceneError& error) {
      findings.elsewhere.insert(findings.elsewhere.end(), error.messages().begin(), error.messages().end());
    }
  }
  findings.throw_if_any(problems.messages());
  return plan;
}

std::size_t reference_run(const Study& study, const StudyQuantity& quantity, const StudyRun& run) {
  std::size_t index = 0;
  for (const std::size_t leader : leaders_of(study)) {
    std::size_t value = run.value[leader];
    for (const auto& [axis, fixed] : quantity.reference)
      if (study.axes[axis].leader == leader) value = fixed;
    index = index * study.axes[leader].values.size() + value;
  }
  return index;
}

}  // namespace splashdown::apps
