#include "apps/statistics/verdict/missing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/text/number_text.hpp"

namespace splashdown::apps {

namespace {

bool is_wet(const Summary& summary, const std::string& name) {
  const auto found = summary.bodies.find(name);
  return found != summary.bodies.end() && found->second.landing.first_contact >= 0;
}

bool any_wet(const Summary& summary) {
  return std::ranges::any_of(summary.bodies, [](const auto& body) { return body.second.landing.first_contact >= 0; });
}

/// Seconds until the lowest point of a dry body is at the water's level, as it moves at the end; nothing: it does not come there.
std::optional<double> until_contact(const Summary& summary, const std::string& name) {
  const auto& landing = summary.bodies.at(name).landing;
  const double g = summary.expected->bodies.at(name).free ? summary.expected->gravity : 0, v = landing.sinking;
  if (!(landing.height > 0)) return {};
  const double squared = v * v + 2 * g * landing.height;
  if (g > 0) return (std::sqrt(squared) - v) / g;
  return v > 0 ? std::optional(landing.height / v) : std::nullopt;
}

constexpr const char* mind = "mind its place, velocity and freedom";

std::string where(const Summary& summary, const std::string& name) {
  const auto& landing = summary.bodies.at(name).landing;
  if (!(landing.height > 0)) return " Mind its place, velocity and freedom.";
  const auto wait = until_contact(summary, name);
  const auto gap = fmt::format(" It is {} above the water", digits_with_unit(landing.height, "m", 3));
  return wait ? fmt::format("{} and gets there at about t = {:.3g} s: let the run last longer (time.end).", gap,
                            summary.simulated_time + *wait)
              : fmt::format("{} and does not come nearer: {}.", gap, mind);
}

bool is_carried(const Summary& summary, const std::string& name) {
  const auto& tied = summary.expected->bodies.at(name).tied;
  return (summary.expected->contact && any_wet(summary)) ||
         std::ranges::any_of(tied, [&](const auto& other) { return is_wet(summary, other); });
}

void add_dry_bodies(const Summary& summary, std::vector<Missing>& list) {
  for (const auto& [name, asked] : summary.expected->bodies) {
    if (is_wet(summary, name) || !summary.bodies.contains(name)) continue;
    const auto until = fmt::format("{} stayed dry until the run ended, at t = {:.4g} s", name, summary.simulated_time);
    if (asked.moves && !is_carried(summary, name))
      list.push_back(
          {Grade::unresolved, until + ": there is no load on it to judge." + where(summary, name), name,
           fmt::format("the load on {} (it stayed dry)", name),
           until_contact(summary, name) ? "let the run last longer (time.end)" : fmt::format("{}: {}", name, mind)});
    else
      list.push_back({Grade::resolved, until + ".", name, {}, {}});
  }
}

void add_rising(const Summary& summary, std::vector<Missing>& list) {
  for (const auto& [name, body] : summary.bodies) {
    if (!body.rising || !summary.expected->bodies.contains(name)) continue;
    const auto rises =
        fmt::format("The load on {} still rises when the run ends, at t = {:.4g} s", name, summary.simulated_time);
    if (peak_is_to_come(summary, name))
      list.push_back({Grade::unresolved,
                      rises + ": its peak comes later. Let the run last longer (time.end).",
                      name,
                      {},
                      "let the run last longer (time.end)"});
    else
      list.push_back({Grade::resolved, rises + ": the largest one is of that instant and no peak.", name, {}, {}});
  }
}

void add_dry_records(const Summary& summary, std::vector<Missing>& list) {
  if (summary.dry_records.empty()) return;
  const bool nothing_else = summary.expected->bodies.empty() && summary.dry_records.size() == summary.wettable_records;
  list.push_back(
      {nothing_else ? Grade::unresolved : Grade::resolved,
       fmt::format("No water met {} until t = {:.4g} s.", fmt::join(summary.dry_records, ", "), summary.simulated_time),
       {},
       fmt::format("{} (met no water)", fmt::join(summary.dry_records, ", ")),
       "mind the places of its records, or let the run last longer (time.end)"});
}

void add_early_end(const Summary& summary, std::vector<Missing>& list) {
  const auto& asked = *summary.expected;
  if (summary.status == "interrupted")
    list.push_back({Grade::resolved,
                    fmt::format("The run was stopped at t = {:.4g} s of {:.4g} s: what comes later is in no number. "
                                "--resume goes on.",
                                summary.simulated_time, asked.end),
                    {},
                    {},
                    {}});
  else if (summary.status == "done" && asked.path_ends_at > summary.simulated_time * (1 + 1e-9))
    list.push_back({Grade::resolved,
                    fmt::format("The prescribed path goes on until t = {:.4g} s, the run ended at {:.4g} s.",
                                asked.path_ends_at, summary.simulated_time),
                    {},
                    {},
                    {}});
}

/// Behind a hull that has gone a length under water the flow is separated; one that swings afloat loses energy to its edges in each
/// of its periods, about 2 pi (L/g)^(1/2).
void add_form_drag(const Summary& summary, std::vector<Missing>& list) {
  constexpr double deep = 1.25, periods = 3, tilted = 10;  // lengths to the lowest point; deg
  if (std::ranges::none_of(summary.inactive_effects, [](const auto& e) { return e.name == "form_drag"; })) return;
  for (const auto& [name, body] : summary.bodies) {
    const auto asked = summary.expected->bodies.find(name);
    if (asked == summary.expected->bodies.end() || !asked->second.free || !is_wet(summary, name)) continue;
    const double length = asked->second.length, g = summary.expected->gravity;
    if (!(length > 0)) continue;
    const char* cure = "Without the drag of separated flow";
    const double afloat = summary.simulated_time - body.landing.first_contact;
    if (body.submergence.value > deep * length)
      list.push_back(
          {Grade::resolved,
           fmt::format("{} went {:.2g} of its lengths under water. {} it goes too deep and leaps too far: add "
                       "[fluid.form_drag] where that counts.",
                       name, body.submergence.value / length, cure),
           name,
           {},
           {}});
    else if (g > 0 && afloat > periods * 2 * std::numbers::pi * std::sqrt(length / g) &&
             body.landing.maximum_tilt.value > tilted)
      list.push_back(
          {Grade::resolved,
           fmt::format("{} swung afloat for {:.3g} s. {} its motion decays too slowly: add [fluid.form_drag] "
                       "where that counts.",
                       name, afloat, cure),
           name,
           {},
           {}});
  }
}

/// The mesh of the fluid was worn, and there was no other.
void add_missed_meshes(const Summary& summary, std::vector<Missing>& list) {
  const long count = summary.fluid ? summary.fluid->remeshings_missed.value_or(0) : 0;
  if (count == 0) return;
  list.push_back(
      {Grade::resolved,
       fmt::format("A new mesh around the bodies was wanted {} time{} and could not be had: cells stayed that "
                   "bodies had squeezed or sheared. Use a smaller body.NAME.size where bodies come near each "
                   "other or a side, or bend; or end the run earlier.",
                   count, count == 1 ? "" : "s"),
       {},
       {},
       {}});
}

}  // namespace

bool peak_is_to_come(const Summary& summary, const std::string& name) {
  if (!summary.expected) return false;
  const auto asked = summary.expected->bodies.find(name);
  const auto body = summary.bodies.find(name);
  return asked != summary.expected->bodies.end() && body != summary.bodies.end() && asked->second.free &&
         body->second.rising;
}

std::vector<Missing> missing(const Summary& summary) {
  std::vector<Missing> list;
  if (!summary.expected || !summary.ledger || summary.status == "failed") return list;
  add_dry_bodies(summary, list);
  add_rising(summary, list);
  add_dry_records(summary, list);
  add_early_end(summary, list);
  add_form_drag(summary, list);
  add_missed_meshes(summary, list);
  std::ranges::stable_sort(list, std::greater(), &Missing::grade);
  return list;
}

std::optional<double> end_to_ask_for(const Summary& summary) {
  std::optional<double> end;
  const auto ask = [&](double time) { end = std::max(end.value_or(0), time); };
  for (const auto& one : missing(summary)) {
    if (one.grade == Grade::resolved || one.body.empty()) continue;
    const double contact = summary.bodies.at(one.body).landing.first_contact, now = summary.simulated_time;
    if (contact >= 0)
      ask(now + (now - contact));
    else if (const auto wait = until_contact(summary, one.body))
      ask(1.5 * (now + *wait));
  }
  return end;
}

}  // namespace splashdown::apps
