#include <fmt/format.h>

#include <algorithm>

#include "apps/scene/numbers.hpp"
#include "apps/scene/read/parts.hpp"

namespace splashdown::apps {
namespace {

/// What a record's own limit is called, and what it is about.
struct LimitSubject {
  std::string name, quantity;
};
struct SubjectOf {
  const Scene& scene;
  std::optional<LimitSubject> operator()(const PatchEntry& patch) const {
    return {{patch.name, patch.name + ".peak_pressure"}};
  }
  std::optional<LimitSubject> operator()(const PressureEntry& point) const {
    return {{point.name, point.name + ".peak_pressure"}};
  }
  std::optional<LimitSubject> operator()(const AccelerationEntry& point) const {
    return {{point.name, point.name + ".peak_g"}};
  }
  std::optional<LimitSubject> operator()(const MaximumPressureEntry& map) const {
    const auto body = map.body < scene.bodies.size() ? scene.bodies[map.body].name : "";
    return {{"hull_" + body, body + ".maximum_pressure"}};
  }
  template <class Other>
  std::optional<LimitSubject> operator()(const Other&) const {
    return {};
  }
};
std::optional<LimitSubject> subject_of(const RecordEntry& record, const Scene& scene) {
  return std::visit(SubjectOf{scene}, record);
}

const char* const question_cure = "Use one of them, e.g. above = 20000: is it above that?";

/// The side that is asked for and its value; false if they could not be read.
bool read_side(Reader& reader, Limit& limit, const std::string& unit) {
  const Rule rule = any(unit, "Use a number in SI units, g for accelerations, e.g. above = 20000.");
  std::optional<double> above, below;
  reader.number("above", above, rule);
  reader.number("below", below, rule);
  auto& problems = reader.context().problems;
  if (problems.found_in(reader.key("above")) || problems.found_in(reader.key("below"))) return false;
  if (above && below)
    problems.add(reader.key("below"), "above and below exclude each other", "Remove one of them, or write two limits.");
  else if (!above && !below)
    problems.add_missing(reader.key("above"), "a limit asks whether its number is above or below a value",
                         question_cure);
  limit.above = above.has_value();
  limit.value = above ? *above : below.value_or(0);
  return above.has_value() != below.has_value();
}

}  // namespace

void read_limit(Reader& reader, Scene& scene) {
  Limit limit;
  read_name(reader, limit.name, "load");
  reader.text("quantity", limit.quantity,
              "Use the name of a number of the run, e.g. \"hull.peak_g\", or an expression in such names.",
              Need::required);
  const auto numbers = numbers_of(scene);
  const auto number = std::ranges::find(numbers, limit.quantity, &NamedNumber::name);
  const bool known = number != numbers.end();
  limit.unit = known ? number->unit : "-";
  reader.text("unit", limit.unit, "Use the quantity's unit, e.g. \"Pa\".");
  if (known && limit.unit != number->unit)
    reader.context().problems.add(reader.key("unit"), fmt::format("{} is in {}", limit.quantity, number->unit),
                                  "Give above or below in it, and remove unit.");
  if (read_side(reader, limit, limit.unit == "-" ? "" : limit.unit)) scene.limits.push_back(limit);
}

void read_limit_of_record(Reader& record, Scene& scene) {
  const auto asked = subject_of(scene.records.back(), scene);
  if (!asked)
    return record.refuse("limit", "this kind of record has no single number",
                         "Use it on a pressure, a patch or an acceleration.");
  auto reader = record.table("limit", Need::optional, "Write limit = {above = 20000} or limit = {below = 20000}.");
  if (!reader) return;
  const auto numbers = numbers_of(scene);
  const auto number = std::ranges::find(numbers, asked->quantity, &NamedNumber::name);
  Limit limit{.name = asked->name, .quantity = asked->quantity, .unit = number == numbers.end() ? "" : number->unit};
  if (read_side(*reader, limit, limit.unit) && number != numbers.end()) scene.limits.push_back(limit);
}

}  // namespace splashdown::apps
