#include "apps/scene/rules/problems.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace splashdown::apps {
namespace {

std::string joined(const std::vector<std::string>& messages) { return fmt::format("{}", fmt::join(messages, "\n")); }

/// Insertions, deletions, substitutions and swaps of neighbours (Damerau, restricted).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = i + j;
        continue;
      }
      const std::size_t differs = a[i - 1] == b[j - 1] ? 0 : 1;
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + differs});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}

/// The key of the table around a key; `body[1]` stands in `body`.
std::string parent(const std::string& key) {
  const auto cut = key.find_last_of(".[");
  return cut == std::string::npos ? std::string() : key.substr(0, cut);
}

}  // namespace

SceneError::SceneError(std::vector<std::string> messages)
    : std::runtime_error(joined(messages)), messages_(std::move(messages)) {}

void Problems::note(const std::string& key, Place place, std::string value) {
  notes_.emplace(key, Note{std::move(place), std::move(value)});
}

Place Problems::place_of(std::string key) const {
  for (;; key = parent(key)) {
    if (const auto found = notes_.find(key); found != notes_.end() && !found->second.place.source.empty())
      return found->second.place;
    if (key.empty()) return {file_, 1};
  }
}

void Problems::note_in_force(const std::string& key, double value, double divisor) {
  const auto found = notes_.find(key);
  if (found == notes_.end()) return;
  const auto by = notes_.find(refine_key);
  const bool by_option = by != notes_.end() && by->second.place.line == 0;  // its text says the value
  found->second.in_force =
      fmt::format("{:g} once divided by {}", value,
                  by_option ? by->second.place.source : fmt::format("{} = {:g}", refine_key, divisor));
}

void Problems::add(const std::string& key, const std::string& rule, const std::string& cure) {
  const auto found = notes_.find(key);
  const Note note = found == notes_.end() ? Note{} : found->second;
  const bool is_chosen = found != notes_.end() && note.place.source.empty();
  std::string subject = note.value.empty() ? key : key + " = " + note.value;
  if (!note.value.empty() && is_chosen) subject += " (chosen, because the scene names none)";
  if (!note.in_force.empty()) subject += ", " + note.in_force;
  problems_.push_back({key, place_of(key),
                       fmt::format("{}{}{}. {}{}", subject, key.empty() ? "" : ": ", rule, cure,
                                   note.in_force.empty() ? "" : " Or use a refine nearer to 1.")});
}

void Problems::add_missing(const std::string& key, const std::string& meaning, const std::string& cure) {
  problems_.push_back({key, place_of(key), fmt::format("{} is missing: {}. {}", key, meaning, cure)});
}

void Problems::add_unknown(const std::string& key, const std::vector<std::string>& valid,
                           const std::string& elsewhere) {
  if (!elsewhere.empty())
    return add(key, "exists " + elsewhere, valid.empty() ? "Remove it." : "Valid here: " + listing(valid) + ".");
  const auto cut = key.find_last_of('.');
  const std::string near = nearest(cut == std::string::npos ? key : key.substr(cut + 1), valid);
  if (valid.empty()) return add(key, "unknown key", "This table has no keys: remove it.");
  add(key, "unknown key", near.empty() ? "Valid here: " + listing(valid) + "." : "Did you mean '" + near + "'?");
}

void Problems::add_at(const Place& place, const std::string& message) { problems_.push_back({{}, place, message}); }

bool Problems::found_in(const std::string& key) const {
  return std::any_of(problems_.begin(), problems_.end(), [&](const Problem& problem) {
    return problem.key.starts_with(key) &&
           (problem.key.size() == key.size() || problem.key[key.size()] == '.' || problem.key[key.size()] == '[');
  });
}

std::vector<std::string> Problems::messages() const {
  auto sorted = problems_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Problem& a, const Problem& b) {
    const bool a_set = a.place.line == 0, b_set = b.place.line == 0;
    return a_set != b_set ? b_set : a.place.line < b.place.line;
  });
  std::vector<std::string> result;
  for (const auto& problem : sorted) {
    const auto& place = problem.place;
    result.push_back(place.line > 0 ? fmt::format("{}:{}: {}", place.source, place.line, problem.text)
                                    : fmt::format("{}: {}", place.source, problem.text));
  }
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

void Problems::throw_if_any() const {
  if (!empty()) throw SceneError(messages());
}

std::string nearest(const std::string& word, const std::vector<std::string>& valid) {
  // A unit too few or too many: pitch is pitch_deg, not path; limits_deg of a slider are limits.
  for (const auto& candidate : valid)
    if ((word.size() >= 3 && candidate.starts_with(word + "_")) || word == candidate + "_deg") return candidate;
  std::string best;
  // Beyond a third of the letters the words have nothing to do with each other.
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const auto& candidate : valid) {
    if (const auto distance = edit_distance(word, candidate); distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string listing(const std::vector<std::string>& words) {
  std::string result;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) result += i + 1 == words.size() ? " or " : ", ";
    result += "'" + words[i] + "'";
  }
  return result;
}

}  // namespace splashdown::apps
