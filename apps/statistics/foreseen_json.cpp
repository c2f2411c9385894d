#include "apps/statistics/foreseen_json.hpp"

#include <cmath>
#include <utility>

namespace splashdown::apps {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json json_of(const AtRest& rest) {
  if (rest.sinks) return {{"sinks", true}, {"held", rest.held}};
  Json json = {{"sinks", false}, {"draft", or_null(rest.draft)}, {"trim_deg", or_null(rest.trim)}};
  for (const auto& [key, value] :
       {std::pair{"heel_deg", rest.heel}, {"gm_roll", rest.gm_roll}, {"gm_pitch", rest.gm_pitch}})
    if (std::isfinite(value)) json[key] = value;
  if (!rest.heels.empty())
    json["righting"] = {{"heel_deg", rest.heels}, {"gz", rest.levers}, {"up_to_deg", or_null(rest.rights_up_to)}};
  if (!rest.held.empty()) json["held"] = rest.held;
  return json;
}

}  // namespace

Json foreseen_json(const Foreseen& foreseen) {
  Json json = Json::object();
  if (foreseen.mass) json["mass"] = *foreseen.mass;
  if (foreseen.load)
    json["load_by_theory"] = {
        {"time", foreseen.load->time}, {"karman", foreseen.load->low}, {"wagner", foreseen.load->high}};
  if (foreseen.rest) json["at_rest"] = json_of(*foreseen.rest);
  return json;
}

}  // namespace splashdown::apps
