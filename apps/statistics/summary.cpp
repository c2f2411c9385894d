#include "apps/statistics/summary.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/files/csv.hpp"
#include "apps/statistics/foreseen_json.hpp"
#include "apps/statistics/verdict/next_step.hpp"
#include "apps/statistics/verdict/share.hpp"
#include "apps/statistics/verdict/statements.hpp"

namespace splashdown::apps {

namespace {

using Json = nlohmann::ordered_json;

/// JSON has no nan or infinity; null says that there is no number.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json time_or_null(double time) { return time < 0 ? Json(nullptr) : number(time); }

Json json_of(const Peak& peak) {
  if (peak.time < 0) return nullptr;
  return {{"value", number(peak.value)}, {"time", number(peak.time)}};
}

/// `change`: what the channel's integral is called.
Json json_of(const Pulse& pulse, const char* change) {
  Json json = json_of(static_cast<const Peak&>(pulse));
  if (json.is_null()) return json;
  json["begin"] = number(pulse.begin);
  json["rise_time"] = number(pulse.rise_time);
  json["duration"] = number(pulse.duration);
  json[change] = number(pulse.change);
  return json;
}

Json json_of(const std::map<int, Pulse>& classes, const char* change) {
  Json json = Json::object();
  for (const auto& [cfc, pulse] : classes) json["cfc" + std::to_string(cfc)] = json_of(pulse, change);
  return json;
}

Json json_of_acceleration(const PulseSummary& acceleration) {
  Json json;
  json["raw"] = json_of(acceleration.raw, "delta_v");
  json.update(json_of(acceleration.cfc, "delta_v"));
  return json;
}

Json json_of(const std::vector<double>& values) {
  Json json = Json::array();
  for (const double value : values) json.push_back(number(value));
  return json;
}

Json json_of(const Verdict& verdict) {
  return {{"grade", name_of(verdict.grade)}, {"reasons", verdict.reasons}, {"about", verdict.about},
          {"notes", verdict.notes},          {"trusted", verdict.trusted}, {"doubted", verdict.doubted}};
}

Json json_of(const NextStep& next) {
  Json json;
  for (const auto& [key, value] : {std::pair{"refine", next.refine}, {"dt_max", next.dt_max}, {"end", next.end}})
    if (value > 0) json[key] = number(value);
  json["seconds"] = number(next.seconds);
  json["promises"] = next.promises;
  json["command"] = next.command;
  json["text"] = text_of(next);
  return json;
}

Json json_of(const Evidence& evidence) {
  Json json = Json::object();
  const auto put = [&](const char* key, double value) {
    if (!std::isnan(value)) json[key] = number(value);
  };
  put("elements", evidence.elements);
  put("growing_share", evidence.growing);
  put("repair_share", evidence.repair);
  put("step_share", evidence.step);
  put("sideways_share", evidence.sideways);
  put("patch_elements", evidence.pressed);
  put("sampling_share", evidence.sampling);
  put("stress_share", evidence.stress);
  return json;
}

Json json_of(const NumberGrade& grade) {
  return {{"grade", name_of(grade.grade)},
          {"band_percent", number(100 * grade.band)},
          {"reasons", grade.reasons},
          {"evidence", json_of(grade.evidence)}};
}

Json json_of_classes(const std::map<int, NumberGrade>& classes) {
  Json json = Json::object();
  for (const auto& [cfc, grade] : classes) json["cfc" + std::to_string(cfc)] = json_of(grade);
  return json;
}

Json json_of(const PulseGrades& grades) {
  Json json = json_of_classes(grades.cfc);
  if (grades.raw) json["raw"] = json_of(*grades.raw);
  return json;
}

/// Under the keys of the numbers themselves.
Json json_of_grades(const BodySummary& body) {
  Json json = Json::object();
  json["peak_acceleration_g"] = json_of(body.acceleration_grades);
  if (body.force_grades.raw) json["peak_force"] = json_of(*body.force_grades.raw);
  json["peak_force_filtered"] = json_of_classes(body.force_grades.cfc);
  if (body.maximum_pressure_grade) json["maximum_pressure"] = json_of(*body.maximum_pressure_grade);
  if (body.stress && body.stress->grade) json["peak_von_mises"] = json_of(*body.stress->grade);
  return json;
}

Json json_of(const RangeCount& count) {
  return {{"initial", count.initial}, {"max", count.max}, {"final", count.final}};
}

Json json_of(const LandingSummary& landing) {
  Json json;
  json["first_contact_time"] = time_or_null(landing.first_contact);
  for (const auto& [name, angle] : landing.attitude)
    json["attitude_deg"][name] = {
        {"end", number(angle.end)}, {"minimum", json_of(angle.lowest)}, {"maximum", json_of(angle.highest)}};
  json["maximum_tilt_deg"] = json_of(landing.maximum_tilt);
  json["capsized"] = landing.capsized_since >= 0;
  json["capsized_time"] = time_or_null(landing.capsized_since);
  json["settled_time"] = time_or_null(landing.settled);
  json["settled_below"] = number(landing.settled_below);
  json["settled_window"] = number(landing.settled_window);
  json["skips"] = landing.dry_intervals.size();
  json["dry_intervals"] = Json::array();
  for (const auto& [from, to] : landing.dry_intervals)
    json["dry_intervals"].push_back({time_or_null(from), time_or_null(to)});
  return json;
}

Json json_of(const BodySummary& body) {
  Json json = {{"peak_acceleration_g", json_of_acceleration(body.acceleration)},
               {"peak_force", json_of(body.force.raw, "impulse")},
               {"peak_force_filtered", json_of(body.force.cfc, "impulse")},
               {"impulse", json_of(body.impulse)},
               {"impulse_repair", json_of(body.impulse_repair)},
               {"repair_share", number(repair_share(body).value_or(NAN))},
               {"rising", body.rising},
               {"maximum_submergence", json_of(body.submergence)},
               {"maximum_wetted", json_of(body.wetted)}};
  json.update(json_of(body.landing));
  if (body.maximum_pressure) {
    json["maximum_pressure"] = json_of(body.maximum_pressure->peak);
    json["maximum_pressure"]["point"] = json_of(body.maximum_pressure->point);
  }
  if (body.stress) {
    json["peak_von_mises"] = json_of(body.stress->peak);
    json["peak_von_mises"]["point"] = json_of(body.stress->point);
    if (!body.stress->part.empty()) json["peak_von_mises"]["part"] = body.stress->part;
  }
  json["verdict"] = json_of(body.verdict);
  json["grades"] = json_of_grades(body);
  return json;
}

Json json_of(const LedgerSummary& ledger) {
  return {{"volume_initial", number(ledger.volume_initial)},
          {"volume_final", number(ledger.volume_final)},
          {"volume_error", number(ledger.volume_error)},
          {"volume_error_bodies", ledger.volume_error_bodies ? number(*ledger.volume_error_bodies) : Json(nullptr)},
          {"volume_time_integration", number(ledger.time_integration)},
          {"volume_remesh_created", number(ledger.remesh_created)},
          {"volume_remesh_deleted", number(ledger.remesh_deleted)},
          {"volume_returned", number(ledger.returned)},
          {"volume_spray", number(ledger.spray)},
          {"kinetic_energy", number(ledger.kinetic_energy)},
          {"potential_energy", number(ledger.potential_energy)},
          {"energy_remesh", number(ledger.energy_remesh)},
          {"energy_repair", number(ledger.energy_repair)},
          {"work_on_walls", number(ledger.work_on_walls)},
          {"energy_gain", number(ledger.energy_gain)},
          {"energy_gain_joule", number(ledger.energy_gain_joule)},
          {"energy_gain_time", time_or_null(ledger.energy_gain_time)},
          {"energy_gain_since", time_or_null(ledger.energy_gain_since)},
          {"energy_scale", number(ledger.energy_scale)},
          {"energy_scale_from", ledger.energy_scale_from}};
}

Json json_of(const std::map<std::string, long>& counts) {
  Json json = Json::object();
  for (const auto& [name, count] : counts) json[name] = count;
  return json;
}

Json json_of(const CouplingSummary& coupling) {
  return {{"scheme", coupling.scheme},
          {"interface_term", coupling.interface_term},
          {"passes_mean", number(coupling.passes_mean)},
          {"passes_max", coupling.passes_max},
          {"rejected_steps", coupling.rejected_steps},
          {"rejected_causes", json_of(coupling.rejected_causes)}};
}

Json json_of_effects(const Summary& summary) {
  Json active = Json::object(), inactive = Json::object();
  for (const auto& effect : summary.effects) {
    active[effect.name] = {{"seconds", number(effect.seconds)},
                           {"share", number(summary.wall_seconds > 0 ? effect.seconds / summary.wall_seconds : 0)}};
    if (!effect.reason.empty()) active[effect.name]["reason"] = effect.reason;
  }
  for (const auto& effect : summary.inactive_effects) inactive[effect.name] = effect.reason;
  return {{"active", active}, {"inactive", inactive}};
}

}  // namespace

const char* name_of(Grade grade) {
  switch (grade) {
    case Grade::resolved:
      return "resolved";
    case Grade::doubtful:
      return "doubtful";
    case Grade::unresolved:
      return "unresolved";
    case Grade::unphysical:
      break;
  }
  return "unphysical";
}

bool Peak::offer(double v, double t) {
  if (time >= 0 && !(v > value)) return false;
  value = v;
  time = t;
  return true;
}

nlohmann::ordered_json json_of(const LimitAnswer& limit) {
  Json json = {{"answer", limit.answer},
               {"quantity", limit.quantity},
               {limit.above ? "above" : "below", number(limit.limit)},
               {"value", number(limit.value)},
               {"band", number(limit.band)},
               {"unit", limit.unit}};
  if (limit.runs > 0) json["runs"] = limit.runs;
  if (!limit.reason.empty()) json["reason"] = limit.reason;
  return json;
}

std::string to_json(const Summary& summary) {
  Json json;
  json["scene"] = summary.scene;
  if (!summary.command.empty()) json["command"] = summary.command;
  json["dimension"] = summary.dimension;
  json["status"] = summary.status;
  if (!summary.cause.empty()) json["cause"] = summary.cause;
  json["verdict"] = json_of(summary.verdict);
  json["verdict"]["advice"] = advice_of(summary);
  if (summary.next) json["next"] = json_of(*summary.next);
  json["simulated_time"] = number(summary.simulated_time);
  json["steps"] = summary.steps;
  json["wall_seconds"] = number(summary.wall_seconds);
  json["processor_seconds"] = number(summary.processor_seconds);
  json["memory_mb"] = number(summary.memory_mb);
  json["rejected_steps"] = summary.rejected_steps;
  json["released_fragments"] = summary.released_fragments;
  json["rejected_causes"] = json_of(summary.rejected_causes);
  json["phases"] = Json::object();
  for (const auto& [name, seconds] : summary.phases) json["phases"][name] = number(seconds);
  json["effects"] = json_of_effects(summary);
  if (summary.nodes) json["nodes"] = json_of(*summary.nodes);
  if (summary.elements) json["elements"] = json_of(*summary.elements);
  if (summary.coupling) json["coupling"] = json_of(*summary.coupling);
  if (summary.ledger) json["ledger"] = json_of(*summary.ledger);
  if (const auto& fluid = summary.fluid) {
    json["fluid"] = {{"max_speed", number(fluid->max_speed)}, {"max_speed_peak", number(fluid->max_speed_peak)}};
    if (fluid->remeshings) json["fluid"]["remeshings"] = *fluid->remeshings;
    if (fluid->remeshings_missed) json["fluid"]["remeshings_missed"] = *fluid->remeshings_missed;
  }
  for (const auto& goal : summary.goals) {
    const auto dot = goal.name.rfind('.');  // "BODY.x", "POINT.uy", "BODY.f1"
    json["goals"][goal.name.substr(0, dot)][goal.name.substr(dot + 1)] = {
        {"value", number(goal.value)}, {"error", number(goal.error)}, {"unit", goal.unit}};
  }
  if (const auto& water = summary.still_water)
    json["still_water"] = {{"density", water->density}, {"gravity", water->gravity}, {"level", water->level}};
  if (!summary.not_foreseen.empty()) json["not_foreseen"] = summary.not_foreseen;
  json["bodies"] = Json::object();
  for (const auto& [name, body] : summary.bodies) {
    json["bodies"][name] = json_of(body);
    if (const auto found = summary.foreseen.find(name); found != summary.foreseen.end())
      json["bodies"][name].update(foreseen_json(found->second));
  }
  for (const auto& [name, point] : summary.equipment) {
    json["equipment"][name] = json_of_acceleration(point);
    json["equipment"][name]["grades"] = json_of(point.grades);
  }
  for (const auto& [name, point] : summary.probes) {
    json["probes"][name]["peak_pressure"] = json_of(point.pressure);
    if (point.grade) json["probes"][name]["grades"]["peak_pressure"] = json_of(*point.grade);
  }
  for (const auto& [name, patch] : summary.patches) {
    json["patches"][name] = {{"peak_pressure", json_of(patch.pressure)},
                             {"area", number(patch.area)},
                             {"impulse", number(patch.impulse)},
                             {"impulse_repair", number(patch.impulse_repair)}};
    if (patch.grade) json["patches"][name]["grades"]["peak_pressure"] = json_of(*patch.grade);
  }
  for (const auto& [name, section] : summary.sections) {
    auto& entry = json["section_loads"][name] = {{"body", section.body}, {"axis", section.axis}};
    for (const auto& [key, peak] :
         {std::pair{"shear", section.shear}, {"hogging", section.hogging}, {"sagging", section.sagging}})
      entry[key] = {
          {"value", number(peak.value)}, {"time", time_or_null(peak.time)}, {"station", number(peak.station)}};
  }
  for (const auto& limit : summary.limits) json["limits"][limit.name] = json_of(limit);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_summary(const std::filesystem::path& directory, const Summary& summary) {
  std::filesystem::create_directories(directory);
  write_file_atomically(directory / "summary.json", to_json(summary));
}

}  // namespace splashdown::apps
