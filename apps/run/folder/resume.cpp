#include "apps/run/folder/resume.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "apps/files/run_files.hpp"
#include "apps/scene/rules/problems.hpp"

namespace splashdown::apps {
namespace {

/// Values by dotted key.
void flatten(const toml::node& node, const std::string& key, std::map<std::string, std::string>& values) {
  if (const auto* table = node.as_table()) {
    for (const auto& [name, value] : *table)
      flatten(value, key.empty() ? std::string(name.str()) : fmt::format("{}.{}", key, name.str()), values);
  } else if (node.is_array_of_tables()) {
    for (std::size_t i = 0; i < node.as_array()->size(); ++i)
      flatten(*node.as_array()->get(i), fmt::format("{}[{}]", key, i), values);
  } else {
    std::ostringstream text;
    node.visit([&](const auto& value) { text << value; });
    values[key] = text.str();
  }
}

std::map<std::string, std::string> values_of(const std::string& resolved) {
  std::map<std::string, std::string> values;
  flatten(toml::parse(resolved), {}, values);
  std::erase_if(values, [](const auto& entry) {
    const auto& key = entry.first;
    return key == "title" || key == "output.checkpoint" || key.starts_with("time.") || key.starts_with("coupling.") ||
           key.starts_with("limit[") || key.find("].limit.") != std::string::npos;
  });
  return values;
}

}  // namespace

std::vector<std::string> differences(const std::string& resolved_now, const std::string& resolved_then) {
  const auto now = values_of(resolved_now), then = values_of(resolved_then);
  const auto value = [](const auto& values, const std::string& key) {
    const auto found = values.find(key);
    return found == values.end() ? std::string("absent") : found->second;
  };
  std::vector<std::string> result;
  auto all = now;
  all.insert(then.begin(), then.end());
  for (const auto& [key, unused] : all)
    if (value(now, key) != value(then, key))
      result.push_back(fmt::format("{} = {}, in the checkpoint {}", key, value(now, key), value(then, key)));
  return result;
}

std::vector<std::string> unusable(const std::filesystem::path& directory, const std::vector<std::string>& reasons) {
  std::vector<std::string> messages;
  for (const auto& reason : reasons) messages.push_back("--resume: " + reason);
  messages.push_back(fmt::format(
      "--resume: no checkpoint of {0} can be continued; nothing was changed. Continue it with the version "
      "that wrote it, or begin anew: in another folder (--out), or with --restart instead of --resume, which "
      "replaces what {0} holds.",
      directory.string()));
  return messages;
}

StoredCheckpoints find_checkpoints(const std::filesystem::path& directory, const std::string& resolved) {
  auto stored = read_checkpoints(directory / "checkpoint");
  if (stored.good.empty() && !stored.bad.empty()) throw SceneError(unusable(directory, stored.bad));
  if (stored.good.empty() && holds_tables(directory))
    throw SceneError(unusable(directory, {directory.string() + " holds tables of a run, but no checkpoint"}));
  std::vector<std::string> messages;
  try {
    for (const auto& found : stored.good)
      for (const auto& difference : differences(resolved, found.state.scene))
        messages.push_back(
            fmt::format("--resume: {}: must be what the run began with. Repeat its --set arguments, or start "
                        "anew without --resume.",
                        difference));
  } catch (const toml::parse_error&) {
    throw SceneError(unusable(directory, {"its checkpoint holds no scene"}));
  }
  std::ranges::sort(messages);
  const auto twice = std::ranges::unique(messages);
  messages.erase(twice.begin(), twice.end());
  if (!messages.empty()) throw SceneError(std::move(messages));
  return stored;
}

}  // namespace splashdown::apps
