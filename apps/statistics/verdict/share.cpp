#include "apps/statistics/verdict/share.hpp"

#include <fmt/format.h>

#include <cmath>

namespace splashdown::apps {

std::optional<double> ratio_of(double value, double reference, double noise, double most) {
  const double ratio = std::abs(value / reference);
  if (!(std::abs(reference) > noise) || !(ratio <= most)) return {};
  return ratio;
}

std::optional<double> share_of(double part, double whole, double noise) { return ratio_of(part, whole, noise, 1); }

std::optional<double> repair_share(const BodySummary& body) {
  double total = 0, repair = 0;
  for (const double value : body.impulse) total += value * value;
  for (const double value : body.impulse_repair) repair += value * value;
  return share_of(std::sqrt(repair), std::sqrt(total), cancels_below * body.impulse_to_and_fro);
}

std::string share_text(const std::optional<double>& share) {
  if (!share) return "no meaningful share";
  if (*share > 0 && *share < 0.001) return "less than 0.1 %";
  return *share < 0.1 ? fmt::format("{:.2g} %", 100 * *share) : fmt::format("{:.0f} %", 100 * *share);
}

}  // namespace splashdown::apps
