#include "apps/statistics/verdict.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "apps/report/words.hpp"
#include "apps/statistics/grades.hpp"

namespace splashdown::apps {

namespace {

struct Finding {
  Grade grade;
  std::string reason;
};

/// From the run's summary to a reason, or to none.
using Measurement = std::optional<Finding> (*)(const Summary&);
using Concern = bool (*)(const BodySummary&);

/// The grade of a share of error, and the words that close its sentence. A share that is no number is the worst.
struct Judgement {
  Grade grade;
  std::string words;
};
std::optional<Judgement> judgement(double share) {
  if (share <= doubtful_above) return {};
  if (share <= unphysical_above) return Judgement{Grade::doubtful, fmt::format("above {:g} %", 100 * doubtful_above)};
  return Judgement{Grade::unphysical, fmt::format("above {:g} %", 100 * unphysical_above)};
}

std::string joule(const Summary& summary, double energy) {
  return with_unit(energy, energy_unit(summary.dimension), 3);
}

std::optional<Finding> failure(const Summary& summary) {
  if (summary.status != "failed") return {};
  return Finding{Grade::unphysical,
                 fmt::format("The run could not go on at t = {:.6g} s: {}. Use nothing of its last steps; try smaller "
                             "steps (time.cfl) or finer elements.",
                             summary.simulated_time, summary.cause)};
}

std::optional<Finding> energy_gain(const Summary& summary) {
  if (!summary.ledger) return {};
  const auto& ledger = *summary.ledger;
  const auto found = judgement(ledger.energy_gain);
  if (!found) return {};
  return Finding{
      found->grade,
      fmt::format("The water gained {} from nowhere until t = {:.4g} s, {:.3g} % of {} ({}): {}. Use nothing after "
                  "t = {:.4g} s, from where on the gain rises (report.html shows its curve); try finer elements at the "
                  "bodies and "
                  "the surface (size, fluid.size.surface) or smaller steps (time.cfl).",
                  joule(summary, ledger.energy_gain_joule), ledger.energy_gain_time, 100 * ledger.energy_gain,
                  joule(summary, ledger.energy_scale), ledger.energy_scale_from, found->words,
                  ledger.energy_gain_since)};
}

std::optional<Finding> kinetic_deficit(const Summary& summary) {
  if (!summary.ledger) return {};
  const auto found = judgement(summary.ledger->kinetic_deficit);
  if (!found) return {};
  return Finding{found->grade,
                 fmt::format("The water's kinetic energy was below zero by {:.3g} % of {} ({}), which no motion has: "
                             "elements were turned inside out. Try finer elements where the water is thin, or smaller "
                             "steps (time.cfl).",
                             100 * summary.ledger->kinetic_deficit, joule(summary, summary.ledger->energy_scale),
                             summary.ledger->energy_scale_from)};
}

std::optional<Finding> volume(const Summary& summary) {
  if (!summary.ledger) return {};
  const auto& ledger = *summary.ledger;
  const double of_hulls = ledger.volume_error_bodies.value_or(0);
  const bool less_water_than_hulls = !(std::abs(ledger.volume_error) < std::abs(of_hulls));  // or no number
  const double error = less_water_than_hulls ? ledger.volume_error : of_hulls;
  const auto found = judgement(std::abs(error));
  if (!found) return {};
  return Finding{
      found->grade,
      fmt::format("The volume of the water changed by {:.3g} {}, {:.3g} % of {}, drops included: {}. See in the ledger "
                  "where it went; try finer elements at the surface (fluid.size.surface) and at the bodies (size).",
                  ledger.volume_final + ledger.spray - ledger.volume_initial, summary.dimension == 2 ? "m^2" : "m^3",
                  100 * error, less_water_than_hulls ? "all water" : "the bodies' hulls", found->words)};
}

// Volume is right again, but not every motion that it missed meanwhile.
std::optional<Finding> returned(const Summary& summary) {
  if (!summary.ledger || std::abs(summary.ledger->returned_share) <= unphysical_above) return {};
  const auto& ledger = *summary.ledger;
  return Finding{
      Grade::doubtful,
      fmt::format("The mesh {} {:.3g} {} that came back at the free surface, {:.3g} % of the bodies' hulls or of "
                  "the water, above {:g} %. Try finer elements at the surface (fluid.size.surface) and at the "
                  "bodies (size).",
                  ledger.returned > 0 ? "lost" : "gained", std::abs(ledger.returned),
                  summary.dimension == 2 ? "m^2" : "m^3", 100 * std::abs(ledger.returned_share),
                  100 * unphysical_above)};
}

bool every_body(const BodySummary&) { return true; }
bool touched_water(const BodySummary& body) { return body.landing.first_contact >= 0; }

constexpr struct {
  Measurement measure;
  Concern concerns;
} measurements[] = {{failure, every_body},
                    {energy_gain, touched_water},
                    {kinetic_deficit, touched_water},
                    {volume, touched_water},
                    {returned, touched_water}};

void add(Verdict& verdict, const Finding& finding) {
  verdict.grade = std::max(verdict.grade, finding.grade);
  verdict.reasons.push_back(finding.reason);
}

/// A body is worth what its headline numbers are.
void add_numbers(Summary& summary, const std::string& name, BodySummary& body) {
  const auto of_run = body.verdict.grade;
  for (const auto& headline : headlines(summary, name)) {
    const auto& number = *headline.grade;
    if (number.grade <= of_run) continue;
    const auto band = std::isfinite(number.band)
                          ? fmt::format("within {:.{}f} %", 100 * number.band, number.band < 0.1 ? 1 : 0)
                          : std::string("without a band");
    Finding finding{number.grade, fmt::format("{}: {} {} {}: {}.", name, headline.name, headline.value, band,
                                              fmt::join(number.reasons, "; "))};
    add(body.verdict, finding);
    add(summary.verdict, finding);
  }
}

}  // namespace

void judge(Summary& summary) {
  summary.verdict = {};
  for (auto& [name, body] : summary.bodies) body.verdict = {};
  for (const auto& [measure, concerns] : measurements) {
    const auto finding = measure(summary);
    if (!finding) continue;
    add(summary.verdict, *finding);
    for (auto& [name, body] : summary.bodies)
      if (concerns(body)) add(body.verdict, *finding);
  }
  grade_numbers(summary);
  for (auto& [name, body] : summary.bodies) add_numbers(summary, name, body);
  summary.next = next_step(summary);
}

}  // namespace splashdown::apps
