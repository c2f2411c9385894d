#include "apps/statistics/verdict/grades.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "apps/statistics/verdict/missing.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {

namespace {

/// An error that falls as 1/n from what was measured at n elements.
struct FirstOrder {
  double error, elements;
  double operator()(double n) const { return error * elements / n; }
};
constexpr FirstOrder entering_plane{0.05, 25}, entering_space{0.13, 17}, staying{0.03, 17};
constexpr double point_factor = 2;  // of the mesh's error at a point, besides the load's own
constexpr double mostly = 0.5;      // impulse
constexpr double widest_band = 10;  // that says anything
constexpr double at_rest_g = 0.02;  // doubtful_above of a g

enum class Kind { acceleration, force, pressure, stress };

/// One error with its words.
struct Share {
  double error;
  std::string words, plain;
  double BandParts::*part = &BandParts::rest;
};

/// What a share must reach to be told: a quarter of the band of resolved numbers adds 3 % to it.
constexpr double worth_telling = resolved_band / 4;

/// Two digits, without an exponent.
std::string rounded(double value) { return value < 10 ? fmt::format("{:.2g}", value) : fmt::format("{:.0f}", value); }
std::string percent_text(double share) {
  return share > widest_band ? fmt::format("over {:g} %", 100 * widest_band) : rounded(100 * share) + " %";
}

/// "1 element", "4.1 elements".
std::string elements_text(double count) {
  const auto number = rounded(count);
  return number + (number == "1" ? " element" : " elements");
}

/// "only 3 elements across it": twice what is on half of the width.
std::string coarse_words(const Evidence& e) {
  if (!(e.elements > 0)) return "no wet elements there";
  const bool on_patch = e.pressed < e.elements;
  const double count = std::round(2 * (on_patch ? e.pressed : e.elements));
  const char* place = on_patch ? "across it" : "across its wet part";
  constexpr double few = 20;
  if (count < 1) return fmt::format("less than one element {}", place);
  return fmt::format("{}{:.0f} element{} {}", count <= few ? "only " : "", count, count == 1 ? "" : "s", place);
}

/// What a number is of.
struct Of {
  int dimension;
  Kind kind;
  bool raw = true;
};

/// Of the load: no mesh gives its peak a value.
bool is_impulse(const Evidence& e) { return e.repair >= mostly; }

std::vector<Share> shares(const Of& of, const Evidence& e, double inertial) {
  const auto [dimension, kind, raw] = of;
  std::vector<Share> list;
  if (std::isfinite(e.stress))
    list.push_back({e.stress, fmt::format("the solid's elements disagree by {} there", percent_text(e.stress)),
                    "the solid's elements are coarse for its stress", &BandParts::mesh});
  if (kind == Kind::stress && !(e.elements > 0)) return list;  // no fluid acts
  const double near = std::isfinite(e.pressed) ? 1 + point_factor / (1 + e.pressed) : 1;
  const double mesh = mesh_band(dimension, e) * (kind == Kind::pressure ? near : kind == Kind::force ? inertial : 1);
  list.push_back(
      {mesh,
       fmt::format("{} on half of the wetted width{}{}: {}",
                   std::isnan(e.elements) ? "no elements" : elements_text(e.elements),
                   e.growing > mostly ? ", which grows" : "",
                   std::isfinite(e.pressed) ? fmt::format(", {} on half of the patch", rounded(e.pressed)) : "",
                   percent_text(mesh)),
       coarse_words(e), &BandParts::mesh});
  if (!std::isnan(e.step))
    list.push_back({e.step,
                    fmt::format("it stands {} off the {} around it", percent_text(e.step),
                                kind == Kind::pressure && !std::isfinite(e.pressed) ? "points" : "steps"),
                    kind == Kind::pressure && !std::isfinite(e.pressed) ? "it jumps from point to point"
                                                                        : "it jumps from step to step",
                    &BandParts::step});
  if (std::isfinite(e.sampling))
    list.push_back(
        {e.sampling,
         fmt::format("means over its steps may take {} of what the filter lets through", percent_text(e.sampling)),
         "its steps are long for the filter", &BandParts::sampling});
  if (std::isfinite(e.sideways))
    list.push_back({e.sideways,
                    fmt::format("{} of the load acts sideways, which symmetry forbids", percent_text(e.sideways)),
                    "part of the load acts sideways, which symmetry forbids"});
  if (std::isfinite(e.repair) && (kind == Kind::pressure || (raw && is_impulse(e))))
    list.push_back({e.repair,
                    fmt::format("{} of the load is impulse of repairs, {}", percent_text(e.repair),
                                kind == Kind::pressure ? "which pressures lack and impulses hold"
                                                       : "whose peak goes as 1/dt: the impulse has a value"),
                    kind == Kind::pressure ? "part of the load came as impulses, which pressures lack"
                                           : "the load is an impulse"});
  return list;
}

void grade(NumberGrade& number, const Of& of, const BodySummary& body) {
  auto list = shares(of, number.evidence, body.inertial);
  double squared = 0;
  number.reasons.clear();
  number.causes.clear();
  number.parts = {};
  for (const auto& share : list) {
    squared += share.error * share.error;
    number.parts.*share.part = std::hypot(number.parts.*share.part, share.error);
  }
  number.band = squared <= widest_band * widest_band ? std::sqrt(squared) : std::numeric_limits<double>::infinity();
  number.grade = grade_of_band(number.band);
  const auto largest = std::ranges::max_element(list, {}, &Share::error);
  if (number.grade != Grade::resolved)
    for (const auto& share : list)
      if (share.error >= worth_telling || &share == &*largest) number.reasons.push_back(share.words);
  std::ranges::stable_sort(list, std::greater(), &Share::error);
  for (const auto& share : list)
    if (share.error >= worth_telling || &share == &list.front()) number.causes.push_back(share.plain);
  if (body.of_water > number.grade || (body.of_water == number.grade && number.grade != Grade::resolved)) {
    number.grade = body.of_water;
    number.reasons.emplace_back("the water's energy or volume, see the verdict");
  }
}

void grade(PulseGrades& grades, const PulseSummary& pulses, double least, Of of, const BodySummary& body) {
  if (grades.raw && !(pulses.raw.value >= least)) grades.raw.reset();
  std::erase_if(grades.cfc, [&](const auto& one) { return !(pulses.cfc.at(one.first).value >= least); });
  if (grades.raw) grade(*grades.raw, of, body);
  of.raw = false;
  for (auto& [cfc, number] : grades.cfc) grade(number, of, body);
}

/// What was measured is no peak.
void is_to_come(NumberGrade& number) {
  number.grade = std::max(number.grade, Grade::unresolved);
  number.reasons.emplace_back("it still rises when the run ends");
}
void is_to_come(PulseGrades& grades) {
  if (grades.raw) is_to_come(*grades.raw);
  for (auto& [cfc, number] : grades.cfc) is_to_come(number);
}

/// Of the class that a body's verdict goes by; without it the raw one.
const NumberGrade* headline_of(const PulseGrades& grades) {
  const auto found = grades.cfc.find(structures_class);
  if (found != grades.cfc.end()) return &found->second;
  return grades.raw ? &*grades.raw : nullptr;
}

bool is_impulse(const PulseGrades& grades) {
  return !grades.cfc.contains(structures_class) && grades.raw && is_impulse(grades.raw->evidence);
}

std::string class_text(const PulseGrades& grades) {
  return grades.cfc.contains(structures_class) ? fmt::format("CFC {}", structures_class) : "raw";
}

Headline headline(const std::string& what, const std::string& filter, const std::string& value,
                  const NumberGrade* grade, bool is_impulse) {
  return {what + (filter.empty() ? "" : ", ") + filter, value, what, filter, grade, is_impulse};
}

double value_of(const PulseSummary& pulses, const PulseGrades& grades) {
  return grades.cfc.contains(structures_class) ? pulses.cfc.at(structures_class).value : pulses.raw.value;
}

/// Not a wavemaker, which is a part of the tank.
bool is_asked_for(const Summary& summary, const std::string& body) {
  return !summary.expected || summary.expected->bodies.contains(body);
}

}  // namespace

double mesh_band(int dimension, const Evidence& evidence) {
  if (!(evidence.elements > 0)) return std::numeric_limits<double>::infinity();
  const double growing = std::isfinite(evidence.growing) ? evidence.growing : 1;
  const auto& entering = dimension == 2 ? entering_plane : entering_space;
  return growing * entering(evidence.elements) + (1 - growing) * staying(evidence.elements);
}

Grade grade_of_band(double band) {
  if (band <= resolved_band) return Grade::resolved;
  return band <= doubtful_band ? Grade::doubtful : Grade::unresolved;
}

void grade_numbers(Summary& summary) {
  const int d = summary.dimension;
  for (auto& [name, body] : summary.bodies) {
    const bool rises = peak_is_to_come(summary, name);
    const bool touched = body.landing.first_contact >= 0 && is_asked_for(summary, name);
    if (!touched) body.acceleration_grades = body.force_grades = {};
    grade(body.acceleration_grades, body.acceleration, at_rest_g, {d, Kind::acceleration}, body);
    grade(body.force_grades, body.force, 0, {d, Kind::force}, body);
    if (rises) is_to_come(body.acceleration_grades), is_to_come(body.force_grades);
    if (body.stress && body.stress->peak.value > 0) {
      body.stress->grade.emplace().evidence = body.stress->evidence;
      grade(*body.stress->grade, {d, Kind::stress}, body);
    }
    body.maximum_pressure_grade.reset();
    if (!body.maximum_pressure) continue;
    body.maximum_pressure_grade.emplace().evidence = body.maximum_pressure->evidence;
    grade(*body.maximum_pressure_grade, {d, Kind::pressure}, body);
  }
  for (auto& [name, point] : summary.equipment) {
    const auto body = summary.bodies.find(point.body);
    if (body == summary.bodies.end() || body->second.landing.first_contact < 0)
      point.grades = {};
    else
      grade(point.grades, point, at_rest_g, {d, Kind::acceleration}, body->second);
  }
  const auto grade_pressure = [&](auto& place) {
    place.grade.reset();
    const auto body = summary.bodies.find(place.body);
    if (body == summary.bodies.end() || !(place.pressure.value > 0)) return;
    place.grade.emplace().evidence = place.evidence;
    grade(*place.grade, {d, Kind::pressure}, body->second);
  };
  for (auto& [name, patch] : summary.patches) grade_pressure(patch);
  for (auto& [name, point] : summary.probes) grade_pressure(point);
}

std::vector<Headline> headlines(const Summary& summary, const std::string& name) {
  std::vector<Headline> list;
  if (!is_asked_for(summary, name)) return list;
  const auto& body = summary.bodies.at(name);
  if (const auto* a = headline_of(body.acceleration_grades))
    list.push_back(headline("peak acceleration", class_text(body.acceleration_grades),
                            fmt::format("{:.3g} g", value_of(body.acceleration, body.acceleration_grades)), a,
                            is_impulse(body.acceleration_grades)));
  if (const auto* f = headline_of(body.force_grades))
    list.push_back(headline("peak force", class_text(body.force_grades),
                            digits_with_unit(value_of(body.force, body.force_grades), force_unit(summary.dimension), 3),
                            f, is_impulse(body.force_grades)));
  for (const auto& [point_name, point] : summary.equipment)
    if (const auto* a = point.body == name ? headline_of(point.grades) : nullptr)
      list.push_back(headline("peak acceleration at " + point_name, class_text(point.grades),
                              fmt::format("{:.3g} g", value_of(point, point.grades)), a, is_impulse(point.grades)));
  for (const auto& [patch_name, patch] : summary.patches)
    if (patch.body == name && patch.grade)
      list.push_back(headline("peak pressure on " + patch_name, "", digits_with_unit(patch.pressure.value, "Pa", 3),
                              &*patch.grade, is_impulse(patch.grade->evidence)));
  return list;
}

}  // namespace splashdown::apps
