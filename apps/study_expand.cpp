#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "apps/scene_read.hpp"
#include "apps/study.hpp"

namespace splashdown::apps {
namespace {

/// A value as part of a folder's name. Numbers carry their axis, words speak for themselves.
std::string word_of(const Axis& axis, const AxisValue& value) {
  std::string word = value.number ? axis.name + "-" + value.text : value.text;
  for (char& c : word)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-' && c != '+') c = '_';
  return word;
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
  if (auto text = blamed(study.set)) return std::pair(Place{study.file.string(), 1}, "set: " + *text);
  return {};
}

}  // namespace

std::optional<std::size_t> Axis::find(const std::string& text) const {
  const auto found = std::ranges::find(values, text, &AxisValue::text);
  if (found == values.end()) return {};
  return static_cast<std::size_t>(found - values.begin());
}

std::vector<StudyRun> expand(const Study& study) {
  double combinations = 1;
  std::string factors;
  for (const auto& axis : study.axes) {
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
  std::vector<std::size_t> index(study.axes.size(), 0);
  for (;;) {
    StudyRun run{.name = {}, .value = index, .set = study.set, .resolved = {}};
    for (std::size_t a = 0; a < index.size(); ++a) {
      const auto& value = study.axes[a].values[index[a]];
      if (a > 0) run.name += '_';
      run.name += word_of(study.axes[a], value);
      run.set.insert(run.set.end(), value.set.begin(), value.set.end());
    }
    const auto plain = run.name;
    for (int n = 2; !names.insert(run.name).second; ++n) run.name = fmt::format("{}_{}", plain, n);
    runs.push_back(std::move(run));
    std::size_t a = index.size();
    while (a > 0 && ++index[a - 1] == study.axes[a - 1].values.size()) index[--a] = 0;
    if (a == 0) return runs;
  }
}

void resolve(const Study& study, std::vector<StudyRun>& runs) {
  Problems problems(study.file.string());
  std::set<std::string> told;
  std::vector<std::string> elsewhere;  // in the scene itself: its messages carry their own place
  for (auto& run : runs) {
    try {
      run.resolved = read_scene(study.scene, run.set).resolved;
    } catch (const SceneError& error) {
      for (const auto& message : error.messages()) {
        if (!told.insert(message).second) continue;
        if (const auto place = origin(study, run, message))
          problems.add_at(place->first, place->second);
        else
          elsewhere.push_back(message);
      }
    }
  }
  auto messages = problems.messages();
  messages.insert(messages.end(), elsewhere.begin(), elsewhere.end());
  if (!messages.empty()) throw SceneError(std::move(messages));
}

std::size_t reference_run(const Study& study, const StudyQuantity& quantity, const StudyRun& run) {
  std::size_t index = 0;
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const auto fixed = quantity.reference.find(a);
    index = index * study.axes[a].values.size() + (fixed == quantity.reference.end() ? run.value[a] : fixed->second);
  }
  return index;
}

}  // namespace splashdown::apps
