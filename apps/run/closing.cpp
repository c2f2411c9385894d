#include "apps/run/closing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "apps/files/run_files.hpp"
#include "apps/record/frames/frames.hpp"
#include "apps/statistics/verdict/grades.hpp"
#include "apps/statistics/verdict/limits.hpp"
#include "apps/statistics/verdict/share.hpp"
#include "apps/statistics/verdict/statements.hpp"
#include "apps/text/number_text.hpp"
#include "apps/text/plain_text.hpp"

namespace splashdown::apps {
namespace {

std::string closing_row(const std::string& head, const std::string& text) {
  return fmt::format("  {:<12}{}\n", head, text);
}

std::string at(const Peak& peak) { return peak.time < 0 ? "" : " at " + with_unit(peak.time, "s"); }

/// " (+- 2.1 %)", with the grade if it is not resolved; nothing for what is not graded.
std::string band_text(const NumberGrade* number) {
  if (!number) return {};
  const auto band = band_mark(number->band);
  return number->grade == Grade::resolved ? " (" + band + ")" : fmt::format(" ({}, {})", band, name_of(number->grade));
}

/// The peak that is the headline: in space raw ones do not converge, and CFC 60 stands for them.
struct Shown {
  const Pulse* pulse;
  const NumberGrade* grade;
  std::string filter;
};
Shown shown(const PulseSummary& pulses, const PulseGrades& grades, int dimension) {
  const auto graded = grades.cfc.find(structures_class);
  const auto filtered = pulses.cfc.find(structures_class);
  if (dimension == 3 && filtered != pulses.cfc.end())
    return {&filtered->second, graded == grades.cfc.end() ? nullptr : &graded->second,
            fmt::format(" (CFC {})", structures_class)};
  return {&pulses.raw, grades.raw ? &*grades.raw : nullptr, ""};
}

std::string impact_text(const BodySummary& body, int dimension, bool is_dry_space) {
  const auto a = shown(body.acceleration, body.acceleration_grades, dimension);
  const auto f = shown(body.force, body.force_grades, dimension);
  if (body.landing.first_contact < 0)
    return fmt::format("{}peak acceleration {:.3g} g{}", is_dry_space ? "" : "stayed dry, ", a.pulse->value,
                       at(*a.pulse));
  const std::string force = dimension == 2 ? "N/m" : "N";
  auto text = fmt::format("wet from {}, peak force{} {}{}{}, peak acceleration{} {:.3g} g{}{}",
                          with_unit(body.landing.first_contact, "s"), f.filter, with_unit(f.pulse->value, force),
                          at(*f.pulse), band_text(f.grade), a.filter, a.pulse->value, at(*a.pulse), band_text(a.grade));
  if (body.impulse_to_and_fro > 0) {
    const auto share = repair_share(body);
    text += share ? ", repair share of the impulse " + share_text(share)
                  : ", no meaningful repair share: little impulse is left";
  }
  return text;
}

/// Filtered peaks of all classes, and the pulse in the class that J211 gives for integration to velocity or the next one.
std::string pulse_text(const PulseSummary& acceleration, const PulseGrades& grades = {}) {
  const auto& classes = acceleration.cfc;
  if (classes.empty()) return {};
  std::string names, peaks;
  for (const auto& [cfc, pulse] : classes) {
    names += fmt::format("{}{}", names.empty() ? "" : "/", cfc);
    const auto graded = grades.cfc.find(cfc);
    peaks += fmt::format("{}{:.3g} g{}", peaks.empty() ? "" : ", ", pulse.value,
                         band_text(cfc == structures_class && graded != grades.cfc.end() ? &graded->second : nullptr));
  }
  auto text = fmt::format("CFC {}: {}", names, peaks);
  const auto chosen = classes.contains(180) ? classes.find(180) : classes.begin();
  const auto& [cfc, pulse] = *chosen;
  if (std::isfinite(pulse.rise_time))
    text += fmt::format("; pulse (CFC {}) at {}, rise time {}", cfc, with_unit(pulse.time, "s"),
                        with_unit(pulse.rise_time, "s"));
  if (std::isfinite(pulse.duration))
    text += fmt::format(", duration {}, delta v {:.3g} m/s", with_unit(pulse.duration, "s"), pulse.change);
  return text;
}

std::string landing_text(const BodySummary& body) {
  const auto& landing = body.landing;
  std::string text;
  if (body.submergence.time >= 0)
    text += fmt::format("greatest submergence {}{}", with_unit(body.submergence.value, "m"), at(body.submergence));
  for (const auto& [name, angle] : landing.attitude)
    text += fmt::format("{}{} {:.1f} deg ({:.1f} to {:.1f})", text.empty() ? "" : ", ", name, angle.end,
                        angle.lowest.value, angle.highest.value);
  if (landing.capsized_since >= 0) text += ", capsized at " + with_unit(landing.capsized_since, "s");
  const auto skips = landing.dry_intervals.size();
  if (skips > 0)
    text += fmt::format(", left the water {} time{}, first at {}", skips, skips > 1 ? "s" : "",
                        with_unit(landing.dry_intervals.front()[0], "s"));
  if (landing.settled >= 0) text += ", settled at " + with_unit(landing.settled, "s");
  return text;
}

std::string body_rows(const std::string& name, const BodySummary& body, int dimension, bool is_dry_space) {
  auto text = closing_row(name, impact_text(body, dimension, is_dry_space));
  if (const auto pulse = pulse_text(body.acceleration, body.acceleration_grades); !pulse.empty())
    text += closing_row("", pulse);
  if (body.landing.first_contact >= 0) text += closing_row("", landing_text(body));
  if (const auto& highest = body.maximum_pressure; highest && dimension == 2)
    text +=
        closing_row("", fmt::format("maximum pressure {}{}{}, at ({:.3g}) m of its shape",
                                    with_unit(highest->peak.value, "Pa"), at(highest->peak),
                                    band_text(body.maximum_pressure_grade ? &*body.maximum_pressure_grade : nullptr),
                                    fmt::join(highest->point, ", ")));
  if (const auto& stress = body.stress; stress && stress->peak.value > 0)
    text += closing_row(
        "", fmt::format("peak von Mises stress {}{}{}, {}at ({:.3g}) m of the undeformed body",
                        with_unit(stress->peak.value, "Pa"), at(stress->peak),
                        band_text(stress->grade ? &*stress->grade : nullptr),
                        stress->part.empty() ? "" : "in " + stress->part + " ", fmt::join(stress->point, ", ")));
  return text;
}

std::string equipment_text(const EquipmentSummary& point) {
  auto text = fmt::format("peak acceleration {:.3g} g{}{}", point.raw.value, at(point.raw),
                          band_text(point.grades.raw ? &*point.grades.raw : nullptr));
  if (const auto pulse = pulse_text(point, point.grades); !pulse.empty()) text += ", " + pulse;
  return text;
}

std::string time_text(const Summary& summary) {
  auto phases = summary.phases;
  std::sort(phases.begin(), phases.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [name, seconds] : phases) {
    const double share = 100 * seconds / summary.wall_seconds;
    if (share < 1) continue;
    text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", name, share);
  }
  return text;
}

std::string coupling_text(const CouplingSummary& coupling) {
  const auto mean = fmt::format("{:.3g}", coupling.passes_mean);
  return fmt::format("{}, {}: {} pass{} a step, {} at most", coupling.scheme, coupling.interface_term, mean,
                     mean == "1" ? "" : "es", coupling.passes_max);
}

std::string refused_text(const Summary& summary) {
  std::string text = fmt::format("{} step{}", summary.rejected_steps, summary.rejected_steps == 1 ? "" : "s");
  for (const auto& [cause, count] : summary.rejected_causes) text += fmt::format("; {}: {}", cause, count);
  if (summary.released_fragments > 0)
    text += fmt::format("; fragments that flew on as drops: {}", summary.released_fragments);
  return text;
}

std::string files_text(const std::filesystem::path& directory, const std::map<std::string, BodySummary>& bodies) {
  std::string text = directory.string() + "/:";
  const auto add = [&](const char* name) {
    if (std::filesystem::exists(directory / name)) text += fmt::format(" {}", name);
  };
  for (const char* name : {"report.html", "summary.json"}) add(name);
  for (const char* name : run_tables()) add(name);
  add("frames.pvd");
  for (const auto& [name, body] : bodies)
    if (body.maximum_pressure) text += fmt::format(" hull_{}.vtu", file_name_of(name));
  return text;
}

std::string new_meshes_text(const Summary& summary) {
  const long count = summary.fluid ? summary.fluid->remeshings.value_or(0) : 0;
  return count == 0 ? "" : fmt::format(", {} new mesh{}", count, count == 1 ? "" : "es");
}

std::string liquid_text(const Summary& summary) {
  const auto& ledger = *summary.ledger;
  auto text = fmt::format("{} nodes ({} at most){}, volume error {:.2g} %", summary.nodes->final, summary.nodes->max,
                          new_meshes_text(summary), 100 * ledger.volume_error);
  if (ledger.volume_error_bodies) text += fmt::format(" ({:.2g} % of the hulls)", 100 * *ledger.volume_error_bodies);
  if (!(ledger.energy_scale > 0)) return text;  // nothing that a gain could be a share of
  const auto gain = ratio_of(ledger.energy_gain, 1);
  return text + fmt::format(", energy gain {} of {}", gain ? fmt::format("{:.2g} %", 100 * *gain) : "over 1000 %",
                            with_unit(ledger.energy_scale, summary.dimension == 2 ? "J/m" : "J"));
}

/// ANSI (ECMA-48, 8.3.117): 31 red, 33 yellow, 32 green, 1 bold.
const char* colour_of(Grade grade) {
  switch (grade) {
    case Grade::resolved:
      return "32";
    case Grade::doubtful:
    case Grade::unresolved:
      return "1;33";
    case Grade::unphysical:
      break;
  }
  return "1;31";
}

/// As many parts in a row as it holds; further rows stand below the text behind the `label`.
std::string folded(const std::string& label, const std::vector<std::string>& parts) {
  constexpr std::size_t wide = 110;
  std::string rows, row;
  const auto end_row = [&](const char* comma) {
    rows += closing_row("", (rows.empty() ? label : std::string(label.size(), ' ')) + row + comma);
    row.clear();
  };
  for (const auto& part : parts) {
    if (!row.empty() && row.size() + part.size() > wide) end_row(",");
    row += (row.empty() ? "" : ", ") + part;
  }
  end_row("");
  return rows;
}

std::string dimmed(const std::string& text, Ink ink) {
  return ink == Ink::colour ? fmt::format("\x1b[2m{}\x1b[0m", text) : text;
}

std::string verdict_rows(const Summary& summary, Ink ink) {
  const auto& verdict = summary.verdict;
  std::string name = name_of(verdict.grade);
  if (ink == Ink::colour) name = fmt::format("\x1b[{}m{}\x1b[0m", colour_of(verdict.grade), name);
  auto text = closing_row("verdict", name);
  text += verdict.trusted.empty() ? closing_row("", "trust: nothing") : folded("trust: ", grouped(verdict.trusted));
  if (!verdict.doubted.empty()) text += folded("doubt: ", grouped(verdict.doubted));
  for (const auto& advice : advice_of(summary)) text += closing_row("", "do:    " + advice);
  for (const auto& note : verdict.notes) text += closing_row("note", note);
  if (verdict.grade == Grade::resolved) return text;
  for (const auto& reason : verdict.because)
    text += closing_row(&reason == &verdict.because.front() ? "because" : "", dimmed(reason, ink));
  return text;
}

}  // namespace

std::string closing_text(const Summary& summary, const std::filesystem::path& directory, Ink ink) {
  auto text = fmt::format(
      "{}: {} {} in {} steps, {} of wall time\n", one_line(summary.scene), summary.status,
      with_unit(summary.simulated_time, "s"), summary.steps,
      summary.wall_seconds < 60 ? fmt::format("{:.3g} s", summary.wall_seconds) : clock_text(summary.wall_seconds));
  for (const auto& [name, body] : summary.bodies) text += body_rows(name, body, summary.dimension, !summary.ledger);
  for (const auto& [name, point] : summary.equipment) text += closing_row(name, equipment_text(point));
  for (const auto& [name, patch] : summary.patches)
    text += closing_row(name, fmt::format("peak pressure {}{}{}, mean over {:.3g} {}; impulse {}",
                                          with_unit(patch.pressure.value, "Pa"), at(patch.pressure),
                                          band_text(patch.grade ? &*patch.grade : nullptr), patch.area,
                                          summary.dimension == 2 ? "m" : "m^2", with_unit(patch.impulse, "Pa s")));
  if (summary.nodes && summary.ledger) text += closing_row("liquid", liquid_text(summary));
  for (const auto& goal : summary.goals)
    text += closing_row("goal", fmt::format("{} {}, error of the mesh {} by the adjoint ({:.2g} %)", goal.name,
                                            with_unit(goal.value, goal.unit), with_unit(goal.error, goal.unit),
                                            100 * std::abs(goal.error / goal.value)));
  if (summary.coupling) text += closing_row("coupling", coupling_text(*summary.coupling));
  if (summary.rejected_steps > 0) text += closing_row("refused", refused_text(summary));
  if (summary.wall_seconds > 0) text += closing_row("spent on", time_text(summary));
  text += closing_row("files", files_text(directory, summary.bodies));
  text += verdict_rows(summary, ink);
  for (const auto& limit : summary.limits) text += closing_row("limit", text_of(limit));
  return text;
}

}  // namespace splashdown::apps
