#include "apps/statistics/next_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/statistics/filters.hpp"
#include "apps/statistics/grades.hpp"
#include "apps/statistics/missing.hpp"

namespace splashdown::apps {

namespace {

constexpr double finer_by[] = {1.4, 2, 2.8, 4, 5.6, 8};
constexpr double usual_refine = 2;    // where none of them is known to help
constexpr double to_spare = 0.9;      // of a band's limit
constexpr double j211_share = 0.045;  // of means over the longest steps that J211 allows (filters.hpp)

double band_of(const BandParts& parts) {
  return std::hypot(std::hypot(parts.mesh, parts.step), std::hypot(parts.sampling, parts.rest));
}

BandParts finer(const BandParts& parts, double refine) {
  return {parts.mesh / refine, parts.step, parts.sampling / refine, parts.rest};
}

BandParts with_short_steps(const BandParts& parts) {
  return {parts.mesh, parts.step, std::min(parts.sampling, j211_share), parts.rest};
}

/// Of the headlines that a mesh can do something for.
std::vector<BandParts> bands(const Summary& summary) {
  std::vector<BandParts> list;
  for (const auto& [name, body] : summary.bodies)
    for (const auto& headline : headlines(summary, name))
      if (!headline.is_impulse && !body.rising) list.push_back(headline.grade->parts);
  return list;
}

template <class Change>
double widest(const std::vector<BandParts>& list, const Change& change) {
  double band = 0;
  for (const auto& parts : list) band = std::max(band, band_of(change(parts)));
  return band;
}

/// The least band of a better grade.
double better_than(Grade grade) { return grade == Grade::doubtful ? resolved_band : doubtful_band; }

/// The grade that the water alone leaves to numbers.
Grade of_water(const Summary& summary) {
  auto grade = Grade::resolved;
  for (const auto& [name, body] : summary.bodies) grade = std::max(grade, body.of_water);
  return grade;
}

std::optional<NextStep> narrower(const Summary& summary) {
  const auto list = bands(summary);
  const double band = widest(list, [](const auto& parts) { return parts; });
  const auto now = grade_of_band(band);
  if (now == Grade::resolved) return {};
  const double wanted = to_spare * better_than(now);
  const auto limit_text = fmt::format("{:g} %", 100 * better_than(now));
  const bool water_allows = of_water(summary) < now;
  NextStep next{.effect = {}, .command = {}};
  if (widest(list, with_short_steps) <= wanted) {
    next.cure = NextStep::Cure::shorter_steps;
    next.value = 1. / (10 * structures_class);
    const double step = summary.steps > 0 ? summary.simulated_time / static_cast<double>(summary.steps) : next.value;
    next.seconds = summary.wall_seconds * std::max(1., step / next.value);
    next.promises = water_allows;
  } else {
    const auto* found = std::ranges::find_if(finer_by, [&](double refine) {
      return widest(list, [=](const auto& parts) { return finer(parts, refine); }) <= wanted;
    });
    next.promises = found != std::end(finer_by) && water_allows && std::ranges::all_of(list, [](const auto& p) {
                      return std::hypot(p.step, p.rest) <= std::max(p.mesh, p.sampling) || band_of(p) <= resolved_band;
                    });
    next.value = found == std::end(finer_by) ? usual_refine : *found;
    next.seconds = summary.wall_seconds * std::pow(next.value, cost_exponent(summary.dimension));
  }
  next.effect = next.promises   ? fmt::format("brings the bands within {}", limit_text)
                : !water_allows ? "may not help: the water's energy or volume is wrong, see the reasons"
                                : fmt::format("may not bring the bands within {}", limit_text);
  return next;
}

}  // namespace

std::optional<NextStep> next_step(const Summary& summary) {
  if (summary.status != "done") return {};
  if (const auto end = end_to_ask_for(summary)) {
    const double longer = *end / std::max(summary.simulated_time, 1e-300);
    NextStep next{.cure = NextStep::Cure::longer, .value = *end, .effect = {}, .command = {}};
    next.seconds = summary.wall_seconds * std::max(1., longer);
    next.effect = "may need more still: the run then holds what it lacks if that comes by then";
    return next;
  }
  return narrower(summary);
}

std::string option_of(const NextStep& next) {
  switch (next.cure) {
    case NextStep::Cure::finer:
      return fmt::format("--refine {:.3g}", next.value);
    case NextStep::Cure::shorter_steps:
      return fmt::format("--set time.dt_max={:.3g}", next.value);
    case NextStep::Cure::longer:
      break;
  }
  return fmt::format("--set time.end={:.3g}", next.value);
}

std::string text_of(const NextStep& next) {
  const auto time = next.seconds < 90     ? fmt::format("{:.2g} s", next.seconds)
                    : next.seconds < 5400 ? fmt::format("{:.0f} min", next.seconds / 60)
                                          : fmt::format("{:.2g} h", next.seconds / 3600);
  return fmt::format("{}, about {}: {}", next.command.empty() ? option_of(next) : next.command, time, next.effect);
}

}  // namespace splashdown::apps
