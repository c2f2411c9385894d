#include "apps/report/curves/behind.hpp"

#include <fmt/format.h>

#include <cmath>

#include "apps/report/curves/style.hpp"
#include "apps/report/words.hpp"
#include "apps/statistics/verdict/limits.hpp"

namespace splashdown::apps {
namespace {

using Json = nlohmann::ordered_json;

Values values_at(const Json& json, const char* key) {
  Values values;
  if (json.contains(key) && json[key].is_array())
    for (const auto& v : json[key]) values.push_back(v.is_number() ? v.get<double>() : NAN);
  return values;
}

}  // namespace

std::vector<Stretch> pulse_of_peaks(const Json& peaks, double time_scale) {
  const auto& pulse = shown_pulse(peaks);
  const double begin = number_at(pulse, {"begin"}), duration = number_at(pulse, {"duration"}),
               change = number_at(pulse, {"delta_v"});
  if (!(begin >= 0) || !(duration > 0)) return {};
  return {{begin * time_scale, (begin + duration) * time_scale,
           std::isfinite(change) ? "pulse: Δv " + digits_with_unit(change, "m/s", 3) : "pulse"}};
}

std::vector<Level> levels_of(const Json& summary, const std::string& number, double scale) {
  std::vector<Level> levels;
  for (const auto& [name, limit] : member(summary, "limits").items()) {
    const auto quantity = text_at(limit, "quantity");
    if (quantity != number && !quantity.starts_with(number + "_")) continue;
    const double value = number_at(limit, {limit.contains("above") ? "above" : "below"});
    if (std::isfinite(value))
      levels.push_back({value * scale, fmt::format("limit {}: {}", name, value_text(value, text_at(limit, "unit")))});
  }
  return levels;
}

std::vector<Between> theory_of(const Json& body, double time_scale, double force_scale) {
  const auto& theory = member(body, "load_by_theory");
  Between band{"von Kármán to Wagner", scaled(values_at(theory, "time"), time_scale),
               scaled(values_at(theory, "karman"), force_scale), scaled(values_at(theory, "wagner"), force_scale)};
  if (band.x.size() < 2 || band.low.size() != band.x.size() || band.high.size() != band.x.size()) return {};
  return {std::move(band)};
}

}  // namespace splashdown::apps
