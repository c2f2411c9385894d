#include "apps/statistics/verdict/limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/quantity/expression.hpp"
#include "apps/quantity/names.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double last_share = 0.02;  // of the time since first contact
constexpr double roundoff = 1e-9;    // of the end

double entry(const nlohmann::json& summary, const std::string& path) {
  const auto found = quantity::find_entry(summary, path);
  return found ? found->numbers.front() : none;
}

/// What a run knows of a number.
struct Known {
  double value = none, band = none, time = none;
  int runs = 0;        ///< that it is the mean of; 0: it is the run's own
  std::string reason;  ///< why nothing can be said of it, whatever its value
};

std::string without_value(std::string path) {
  const std::string end = ".value";
  return path.ends_with(end) ? path.substr(0, path.size() - end.size()) : path;
}

/// bodies.NAME.grades.KEY of bodies.NAME.KEY.value, and so for what is not a body.
std::string grade_path(const std::string& path) {
  const auto second = path.find('.', path.find('.') + 1);
  return path.substr(0, second) + ".grades" + without_value(path.substr(second));
}

bool stayed_dry(const nlohmann::json& summary, const NamedNumber& number, double value) {
  if (number.body.empty()) return !(value > 0);
  return !std::isfinite(entry(summary, "bodies." + number.body + ".first_contact_time"));
}

const nlohmann::json* grade_at(const nlohmann::json& summary, const std::string& path) {
  auto slashes = "/" + path;
  std::ranges::replace(slashes, '.', '/');
  const nlohmann::json::json_pointer pointer(slashes);
  return summary.contains(pointer) ? &summary.at(pointer) : nullptr;
}

Known known_of(const NamedNumber& number, const nlohmann::json& summary, const MeanNumbers& means) {
  Known known;
  std::string path;
  for (const auto& one : number.paths) {
    path = one;
    known.value = entry(summary, path);
    if (std::isfinite(known.value)) break;
  }
  if (stayed_dry(summary, number, known.value)) {
    known.reason = (number.body.empty() ? number.name.substr(0, number.name.find('.')) : number.body) + " stayed dry";
    return known;
  }
  if (!std::isfinite(known.value)) {
    known.reason = fmt::format("the run has no {}", number.name);
    return known;
  }
  known.time = entry(summary, without_value(path) + ".time");
  const nlohmann::json* grade = grade_at(summary, grade_path(path));
  if (grade && grade->value("grade", "") == name_of(Grade::unphysical))
    known.reason = "the run is unphysical, see the verdict";
  else if (grade && grade->at("band_percent").is_number())
    known.band = std::abs(known.value) * grade->at("band_percent").get<double>() / 100;
  if (const auto mean = means.find(path); mean != means.end() && known.reason.empty()) {
    known.value = mean->second.value;
    known.band = mean->second.band;
    known.runs = mean->second.runs;
  }
  return known;
}

/// The numbers of an expression, one of them off by so many of its bands.
double value_of(const Limit& limit, const std::map<std::string, Known>& numbers, const std::string& off = {},
                double bands = 0) {
  const auto value = [&](const std::string& name) {
    const auto& known = numbers.at(name);
    return known.value + (name == off ? bands * known.band : 0);
  };
  if (numbers.contains(limit.quantity)) return value(limit.quantity);  // a name with a dash is no difference
  return quantity::evaluate_number(limit.quantity, [&](const std::string& name) -> std::optional<quantity::Value> {
    return numbers.contains(name) ? std::optional(quantity::Value::number(value(name))) : std::nullopt;
  });
}

double band_of(const Limit& limit, const std::map<std::string, Known>& numbers, double value) {
  double band = 0;
  for (const auto& [name, known] : numbers) {
    if (!std::isfinite(known.band)) return none;
    band += std::max(std::abs(value_of(limit, numbers, name, 1) - value),
                     std::abs(value_of(limit, numbers, name, -1) - value));
  }
  return band;
}

class Answering {
 public:
  Answering(std::span<const NamedNumber> numbers, const nlohmann::json& summary, double end, const MeanNumbers& means)
      : numbers_(numbers),
        json_(summary),
        means_(means),
        done_(summary.value("status", "") == "done"),
        simulated_time_(entry(summary, "simulated_time")),
        end_(end) {}

  LimitAnswer to(const Limit& limit) const {
    LimitAnswer answer{.name = limit.name,
                       .quantity = limit.quantity,
                       .unit = limit.unit,
                       .above = limit.above,
                       .limit = limit.value,
                       .answer = within_the_band,
                       .reason = {}};
    const auto known = numbers_in(limit);
    try {
      answer.value = value_of(limit, known);
      answer.band = band_of(limit, known, answer.value);
    } catch (const std::runtime_error& error) {
      answer.reason = error.what();
    }
    for (const auto& [name, number] : known) {
      if (answer.reason.empty()) answer.reason = number.reason;
      answer.runs = std::max(answer.runs, number.runs);
    }
    if (answer.reason.empty() && !std::isfinite(answer.band)) answer.reason = "it has no band";
    if (!answer.reason.empty()) return answer;
    const bool above = answer.value - answer.band > limit.value, below = answer.value + answer.band < limit.value;
    if (!above && !below) return answer;
    const bool peak = known.contains(limit.quantity) && is_peak(limit.quantity);
    if (!(above && peak)) answer.reason = unfinished(known);
    if (answer.reason.empty()) answer.answer = above == limit.above ? "yes" : "no";
    return answer;
  }

 private:
  static constexpr const char* within_the_band = "within the band";

  const NamedNumber* find(const std::string& name) const {
    const auto found = std::ranges::find(numbers_, name, &NamedNumber::name);
    return found == numbers_.end() ? nullptr : &*found;
  }
  bool is_peak(const std::string& name) const { return find(name)->peak; }

  std::map<std::string, Known> numbers_in(const Limit& limit) const {
    std::map<std::string, Known> known;
    if (const auto* number = find(limit.quantity)) return {{limit.quantity, known_of(*number, json_, means_)}};
    for (const auto& name : quantity::names_in(limit.quantity))
      if (const auto* number = find(name)) known.emplace(name, known_of(*number, json_, means_));
    return known;
  }

  /// Why larger values may come yet; empty: they may not.
  std::string unfinished(const std::map<std::string, Known>& known) const {
    if (!done_ || simulated_time_ < (1 - roundoff) * end_)
      return fmt::format("the run ended at {:.4g} s of {:.4g} s", simulated_time_, end_);
    for (const auto& [name, number] : known) {
      const auto first = entry(json_, "bodies." + find(name)->body + ".first_contact_time");
      const double since = std::isfinite(first) ? first : 0;
      if (find(name)->peak && number.time >= simulated_time_ - last_share * (simulated_time_ - since))
        return "it was still rising when the run ended";
    }
    return {};
  }

  std::span<const NamedNumber> numbers_;
  const nlohmann::json& json_;
  const MeanNumbers& means_;
  bool done_;
  double simulated_time_, end_;
};

}  // namespace

std::vector<LimitAnswer> answered(std::span<const Limit> limits, std::span<const NamedNumber> numbers,
                                  const Summary& summary, double end) {
  if (limits.empty()) return {};
  return answered(limits, numbers, nlohmann::json::parse(to_json(summary)), end, {});
}

std::vector<LimitAnswer> answered(std::span<const Limit> limits, std::span<const NamedNumber> numbers,
                                  const nlohmann::json& summary, double end, const MeanNumbers& means) {
  std::vector<LimitAnswer> answers;
  const Answering answering(numbers, summary, end, means);
  for (const auto& limit : limits) answers.push_back(answering.to(limit));
  return answers;
}

std::string value_text(double value, const std::string& unit) {
  const bool takes_prefix = unit == "Pa" || unit == "m" || unit.starts_with("N");
  if (takes_prefix) {
    const auto [scale, name] = si_unit(value, unit);
    return fmt::format("{:.3g} {}", scale * value, name);
  }
  return fmt::format("{:.3g}{}{}", value, unit == "-" || unit.empty() ? "" : " ", unit == "-" ? "" : unit);
}

std::string text_of(const LimitAnswer& limit) {
  auto text = fmt::format("{}: {} {}? {}", limit.name, limit.above ? "above" : "below",
                          value_text(limit.limit, limit.unit), limit.answer);
  if (std::isfinite(limit.value)) text += ", " + value_text(limit.value, limit.unit);
  if (std::isfinite(limit.band)) text += " +- " + value_text(limit.band, limit.unit);
  if (limit.runs > 0) text += fmt::format(", mean of {} runs", limit.runs);
  if (!limit.reason.empty()) text += "; " + limit.reason;
  return text;
}

}  // namespace splashdown::apps
