#include "apps/statistics/verdict/next_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/statistics/filters.hpp"
#include "apps/statistics/verdict/grades.hpp"
#include "apps/statistics/verdict/missing.hpp"
#include "apps/statistics/verdict/verdict.hpp"

namespace splashdown::apps {

namespace {

constexpr double finer_by[] = {1, 1.4, 2, 2.8, 4, 5.6, 8};
constexpr double usual_refine = 2;    // where none of them is known to help
constexpr double to_spare = 0.9;      // of a band's limit
constexpr double j211_share = 0.045;  // of means over the longest steps that J211 allows (filters.hpp)

double band_of(const BandParts& parts) {
  return std::hypot(std::hypot(parts.mesh, parts.step), std::hypot(parts.sampling, parts.rest));
}

BandParts changed(const BandParts& parts, double refine, bool short_steps) {
  return {parts.mesh / refine, parts.step, short_steps ? std::min(parts.sampling, j211_share) : parts.sampling,
          parts.rest};
}

/// As a finer mesh may find it: this one knows the growth of the wetted width, twice a difference of widths, no better than to
/// half of a facet at either end.
BandParts at_most(const NumberGrade& grade, int dimension) {
  BandParts parts = grade.parts;
  Evidence known = grade.evidence;
  if (!std::isfinite(known.growing) || !(known.elements > 0)) return parts;
  const double mesh = mesh_band(dimension, known);
  known.growing = std::min(1., known.growing + 1 / known.elements);
  if (mesh > 0) parts.mesh *= mesh_band(dimension, known) / mesh;
  return parts;
}

/// Of the headlines that a mesh can do something for: as they are, and as finer meshes may find them.
struct Bands {
  std::vector<BandParts> now, at_most;
};

Bands bands(const Summary& summary) {
  Bands list;
  for (const auto& [name, body] : summary.bodies)
    for (const auto& headline : headlines(summary, name))
      if (!headline.is_impulse && !body.rising) {
        list.now.push_back(headline.grade->parts);
        list.at_most.push_back(at_most(*headline.grade, summary.dimension));
      }
  return list;
}

double widest(const std::vector<BandParts>& list, double refine, bool short_steps) {
  double band = 0;
  for (const auto& parts : list) band = std::max(band, band_of(changed(parts, refine, short_steps)));
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

/// What neither a mesh nor shorter steps change is not what makes the band.
bool can_be_narrowed(const BandParts& parts) {
  return band_of(parts) <= resolved_band || std::hypot(parts.step, parts.rest) <= std::max(parts.mesh, parts.sampling);
}

/// The first way to a band below `wanted`; else the usual one, without a promise.
NextStep way_to(double wanted, const std::vector<BandParts>& list) {
  constexpr double j211_steps = 1. / (10 * structures_class);
  NextStep next{.effect = {}, .command = {}};
  for (const double refine : finer_by)
    for (const bool short_steps : {false, true}) {
      if (widest(list, refine, short_steps) > wanted) continue;
      next.promises = std::ranges::all_of(list, can_be_narrowed);
      next.refine = refine > 1 ? refine : 0;
      next.dt_max = short_steps ? j211_steps : 0;
      return next;
    }
  next.refine = usual_refine;
  if (std::ranges::any_of(list, [](const auto& parts) { return parts.sampling > j211_share; }))
    next.dt_max = j211_steps;
  return next;
}

std::optional<NextStep> narrower(const Summary& summary) {
  const auto list = bands(summary);
  const auto now = grade_of_band(widest(list.now, 1, false));
  if (now == Grade::resolved) return {};
  auto next = way_to(to_spare * better_than(now), list.at_most);
  const bool water_allows = of_water(summary) < now;
  // Volume that came back at the surface on this mesh may be more on a finer one.
  const bool holds_volume = !summary.ledger || std::abs(summary.ledger->returned_share) <= doubtful_above;
  next.promises = next.promises && water_allows && holds_volume;
  const double step = summary.steps > 0 ? summary.simulated_time / static_cast<double>(summary.steps) : 0;
  next.seconds = summary.wall_seconds * std::pow(std::max(1., next.refine), cost_exponent(summary.dimension));
  if (next.dt_max > 0) next.seconds *= std::max(1., step / std::max(1., next.refine) / next.dt_max);
  const auto limit = fmt::format("{:g} %", 100 * better_than(now));
  next.effect = next.promises   ? "brings the bands within " + limit
                : !water_allows ? "may not help: the water's energy or volume is wrong, see the reasons"
                : !holds_volume ? "may not bring the bands within " + limit + ": volume came back at the free surface"
                                : "may not bring the bands within " + limit;
  return next;
}

}  // namespace

std::optional<NextStep> next_step(const Summary& summary) {
  if (summary.status != "done") return {};
  if (const auto end = end_to_ask_for(summary)) {
    const double longer = *end / std::max(summary.simulated_time, 1e-300);
    NextStep next{.end = *end, .effect = {}, .command = {}};
    next.seconds = summary.wall_seconds * std::max(1., longer);
    next.effect = "may need more still: the run then holds what it lacks if that comes by then";
    return next;
  }
  return narrower(summary);
}

std::string options_of(const NextStep& next) {
  std::string text;
  const auto add = [&](double value, const char* option) {
    if (value > 0) text += fmt::format("{}{}{:.3g}", text.empty() ? "" : " ", option, value);
  };
  add(next.refine, "--refine ");
  add(next.dt_max, "--set time.dt_max=");
  add(next.end, "--set time.end=");
  return text;
}

std::string text_of(const NextStep& next) {
  const auto time = next.seconds < 90     ? fmt::format("{:.2g} s", next.seconds)
                    : next.seconds < 5400 ? fmt::format("{:.0f} min", next.seconds / 60)
                                          : fmt::format("{:.2g} h", next.seconds / 3600);
  return fmt::format("{}, about {}: {}", next.command.empty() ? options_of(next) : next.command, time, next.effect);
}

}  // namespace splashdown::apps
