#include "apps/statistics/verdict/verdict.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "apps/statistics/verdict/grades.hpp"
#include "apps/statistics/verdict/missing.hpp"
#include "apps/statistics/verdict/next_step.hpp"
#include "apps/statistics/verdict/share.hpp"
#include "apps/statistics/verdict/statements.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {

namespace {

struct Finding {
  Grade grade;
  std::string reason;
  std::string doubt, advice;  ///< in plain words
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
  return digits_with_unit(energy, energy_unit(summary.dimension), 3);
}

std::optional<Finding> failure(const Summary& summary) {
  if (summary.status != "failed") return {};
  return Finding{Grade::unphysical,
                 fmt::format("The run could not go on at t = {:.6g} s: {}. Use nothing of its last steps. {}",
                             summary.simulated_time, summary.cause,
                             summary.cure.empty() ? "Try smaller steps (time.cfl) or finer elements." : summary.cure),
                 fmt::format("all of it (the run could not go on at t = {:.4g} s)", summary.simulated_time),
                 summary.cure.empty()
                     ? "use nothing of its last steps; smaller steps (time.cfl) or finer elements may help"
                     : "use nothing of its last steps; " + summary.cure};
}

/// Of what there was to give; over ten times of that the number says no more.
std::string gain_text(const LedgerSummary& ledger) {
  const auto ratio = ratio_of(ledger.energy_gain, 1);
  return ratio ? fmt::format("{:.3g} %", 100 * *ratio) : "more than ten times that";
}

/// Until when the run is good: a gain that begins with it leaves nothing.
std::string usable_text(const Summary& summary) {
  const auto& ledger = *summary.ledger;
  constexpr double as_good_as_none = 0.02;  // of the run
  if (!(ledger.energy_gain_since > as_good_as_none * summary.simulated_time))
    return "The gain rises from the start: use nothing of this run";
  return fmt::format("Use nothing after t = {:.4g} s, from where on the gain rises", ledger.energy_gain_since);
}

/// Without its capital.
std::string sentence_inside(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

std::optional<Finding> energy_gain(const Summary& summary) {
  if (!summary.ledger) return {};
  const auto& ledger = *summary.ledger;
  const auto found = judgement(ledger.energy_gain);
  if (!found) return {};
  return Finding{
      found->grade,
      fmt::format(
          "The water gained {} from nowhere until t = {:.4g} s, {} of {} ({}): {}. {} (report.html shows its "
          "curve); try finer elements at the bodies and the surface (size, fluid.size.surface) or smaller steps "
          "(time.cfl).",
          joule(summary, ledger.energy_gain_joule), ledger.energy_gain_time, gain_text(ledger),
          joule(summary, ledger.energy_scale), ledger.energy_scale_from, found->words, usable_text(summary)),
      fmt::format("the water's energy ({} of what was exchanged came from nowhere)", part_words(ledger.energy_gain)),
      (found->grade == Grade::unphysical ? sentence_inside(usable_text(summary)) + "; " : "") +
          "finer elements at the bodies and the surface (size, fluid.size.surface) or smaller steps (time.cfl)"};
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
                             summary.ledger->energy_scale_from),
                 "the water's energy (below zero: elements were turned inside out)",
                 "finer elements where the water is thin, or smaller steps (time.cfl)"};
}

constexpr const char* finer_everywhere = "finer elements at the surface (fluid.size.surface) and at the bodies (size)";

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
                  ledger.volume_excess(), summary.dimension == 2 ? "m^2" : "m^3", 100 * error,
                  less_water_than_hulls ? "all water" : "the bodies' hulls", found->words),
      fmt::format("the water's volume (it changed by {} of {})", part_words(error),
                  less_water_than_hulls ? "all water" : "the hulls"),
      finer_everywhere};
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
                  100 * unphysical_above),
      fmt::format("the water's volume ({} of the hulls or of the water came back at the surface)",
                  part_words(ledger.returned_share)),
      finer_everywhere};
}

bool is_held(const BodySummary& body) { return body.held_against > 0; }

/// Joints, stops or springs that hold what was meant to move.
std::optional<Finding> held(const Summary& summary) {
  std::string names;
  double most = 0;
  for (const auto& [name, body] : summary.bodies) {
    if (!is_held(body)) continue;
    names += (names.empty() ? "" : ", ") + name;
    most = std::max(most, body.held_against);
  }
  if (names.empty()) return {};
  return Finding{Grade::doubtful,
                 fmt::format("A free body never moved though {} pulled at it: {}. Its joints hold it fast: see what "
                             "splashdown check asks about them.",
                             digits_with_unit(most, summary.dimension == 2 ? "N/m" : "N", 3), names),
                 fmt::format("the motion of {} (held fast though something pulled at it)", names),
                 "see what splashdown check asks about the joints of " + names};
}

bool every_body(const BodySummary&) { return true; }
bool touched_water(const BodySummary& body) { return body.landing.first_contact >= 0; }

/// What of the water a measurement is of.
enum class OfWater { nothing, energy, volume, both };

constexpr struct {
  Measurement measure;
  Concern concerns;
  OfWater of;
} measurements[] = {{failure, every_body, OfWater::both},
                    {energy_gain, touched_water, OfWater::energy},
                    {kinetic_deficit, touched_water, OfWater::energy},
                    {volume, touched_water, OfWater::volume},
                    {returned, touched_water, OfWater::volume},
                    {held, is_held, OfWater::nothing}};

void add(Verdict& verdict, const Finding& finding) {
  verdict.grade = std::max(verdict.grade, finding.grade);
  verdict.reasons.push_back(finding.reason);
}

/// Each sentence once.
void add_once(std::vector<std::string>& list, const std::string& text) {
  if (!text.empty() && std::ranges::find(list, text) == list.end()) list.push_back(text);
}

/// The same in plain words.
void add_plain(Verdict& verdict, const Finding& finding) {
  if (finding.grade == Grade::resolved) return verdict.notes.push_back(finding.reason);
  add_once(verdict.doubted, finding.doubt);
  add_once(verdict.advice, finding.advice);
  verdict.because.push_back(finding.reason);
}

/// Whatever no measurement found fault with.
void trust_water(Verdict& verdict, bool energy, bool volume) {
  if (!energy && !volume) return;
  verdict.trusted.emplace_back(!energy   ? "the water's volume"
                               : !volume ? "the water's energy"
                                         : "the water's volume and energy");
}

std::string band_text(const NumberGrade& number) {
  constexpr double least = 0.001;  // told as a number
  if (!std::isfinite(number.band)) return "without a band";
  if (number.band < least) return fmt::format("within less than {:g} %", 100 * least);
  return fmt::format("within {:.{}f} %", 100 * number.band, number.band < 0.1 ? 1 : 0);
}

/// A body is worth what its headline numbers are. What is still to come was told before.
void add_numbers(Summary& summary, const std::string& name, BodySummary& body, bool several) {
  const bool to_come = peak_is_to_come(summary, name);
  const auto list = headlines(summary, name);
  std::vector<std::string> because;
  for (auto* verdict : {&body.verdict, &summary.verdict})
    if (to_come && list.empty()) add_once(verdict->doubted, fmt::format("the load on {} (it still rises)", name));
  for (const auto& headline : list) {
    const auto& number = *headline.grade;
    const auto about = fmt::format("{}: {} {} {}", name, headline.name, headline.value, band_text(number));
    const auto plain = statement_of(summary, name, headline, several);
    for (auto* verdict : {&body.verdict, &summary.verdict}) {
      verdict->about.push_back(about);
      (number.grade == Grade::resolved ? verdict->trusted : verdict->doubted).push_back(plain);
    }
    if (number.grade <= body.of_water || (to_come && grade_of_band(number.band) < Grade::unresolved)) continue;
    const Finding finding{number.grade, fmt::format("{}: {}.", about, fmt::join(number.reasons, "; ")), {}, {}};
    add(body.verdict, finding);
    add(summary.verdict, finding);
    add_once(because, further_causes(summary, name, headline, several));
  }
  for (const auto& group : grouped(because)) summary.verdict.because.push_back(group);
}

/// First of all.
void add_missing(Summary& summary) {
  for (const auto& one : missing(summary)) {
    const Finding finding{one.grade, one.reason, one.doubt, one.advice};
    add(summary.verdict, finding);
    add_plain(summary.verdict, finding);
    const auto body = summary.bodies.find(one.body);
    if (body == summary.bodies.end()) continue;
    add(body->second.verdict, finding);
    add_plain(body->second.verdict, finding);
  }
}

}  // namespace

void judge(Summary& summary) {
  summary.verdict = {};
  for (auto& [name, body] : summary.bodies) body.verdict = {}, body.of_water = Grade::resolved;
  add_missing(summary);
  bool energy = summary.ledger.has_value(), volume_kept = energy;
  for (const auto& [measure, concerns, of] : measurements) {
    const auto finding = measure(summary);
    if (!finding) continue;
    if (of == OfWater::energy || of == OfWater::both) energy = false;
    if (of == OfWater::volume || of == OfWater::both) volume_kept = false;
    add(summary.verdict, *finding);
    add_plain(summary.verdict, *finding);
    for (auto& [name, body] : summary.bodies) {
      if (!concerns(body)) continue;
      add(body.verdict, *finding), add_plain(body.verdict, *finding);
      body.of_water = std::max(body.of_water, finding->grade);
    }
  }
  grade_numbers(summary);
  const auto several = std::ranges::count_if(summary.bodies, [&](const auto& body) {
                         return !headlines(summary, body.first).empty();
                       }) > 1;
  auto findings = std::exchange(summary.verdict.doubted, {});
  for (auto& [name, body] : summary.bodies) add_numbers(summary, name, body, several);
  // Where all is wrong, numbers come after what makes them so.
  auto& doubted = summary.verdict.doubted;
  doubted.insert(summary.verdict.grade == Grade::unphysical ? doubted.begin() : doubted.end(), findings.begin(),
                 findings.end());
  trust_water(summary.verdict, energy, volume_kept);
  if (summary.verdict.about.empty())
    summary.verdict.about.emplace_back(summary.ledger ? "the water's energy and volume alone: no load is graded"
                                                      : "nothing: there is no water");
  summary.next = next_step(summary);
}

}  // namespace splashdown::apps
