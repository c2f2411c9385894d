#include "apps/cli/schema.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/scene/read/read.hpp"
#include "apps/scene/sketch.hpp"
#include "apps/study/study.hpp"

namespace splashdown::apps {
namespace {

using Json = nlohmann::ordered_json;
using Visits = std::vector<const Sketch::Visit*>;

Json object_of(const Sketch& sketch, const std::string& header);

/// "Must be positive (kg/m^3). Use e.g. 1000 for water."
std::string hint_of(const Wanted& wanted) {
  using enum Wanted::Type;
  if (wanted.type != number && wanted.type != whole && wanted.type != list && wanted.type != rows) return wanted.hint;
  std::string hint = wanted.rule.law() + ". " + wanted.rule.cure;
  hint.front() = 'M';  // each law says what must be
  return hint;
}

Json number_of(const Rule& rule, const char* type) {
  Json json{{"type", type}};
  if (std::isfinite(rule.low)) json[rule.low_open ? "exclusiveMinimum" : "minimum"] = rule.low;
  if (std::isfinite(rule.high)) json["maximum"] = rule.high;
  return json;
}

Json list_of(Json items, std::size_t length) {
  Json json{{"type", "array"}, {"items", std::move(items)}};
  if (length > 0) json["minItems"] = json["maxItems"] = length;
  return json;
}

Json json_of(const Sketch& sketch, const Wanted& wanted) {
  using enum Wanted::Type;
  Json json = Json::object();
  switch (wanted.type) {
    case anything:
      break;
    case number:
      json = number_of(wanted.rule, "number");
      break;
    case whole:
      json = number_of(wanted.rule, "integer");
      break;
    case text:
      json["type"] = "string";
      break;
    case texts:
      json = list_of({{"type", "string"}}, 0);
      break;
    case word:
      json["enum"] = wanted.words;
      break;
    case words:
      json = list_of({{"enum", wanted.words}}, 0);
      json["uniqueItems"] = true;
      break;
    case list:
      json = list_of(number_of(wanted.rule, "number"), wanted.length);
      break;
    case rows:
      json = list_of(list_of(number_of(wanted.rule, "number"), wanted.length), 0);
      break;
    case table:
      json = object_of(sketch, wanted.header);
      break;
    case tables:
      json = list_of(object_of(sketch, wanted.header), 0);
      break;
  }
  if (const auto hint = hint_of(wanted); !hint.empty()) json["description"] = hint;
  return json;
}

/// What some looks at a table say together.
struct Together {
  std::vector<std::string> order;
  std::map<std::string, std::vector<Wanted>> any_of;  ///< keys that may be there; empty: whatever they hold
  std::set<std::string> required;
};

Together together(const Sketch& sketch, const Visits& visits);

/// A table that is read even if it is absent has to be there if one of its keys has to.
bool is_needed(const Sketch& sketch, const std::vector<Wanted>& any_of) {
  return std::ranges::any_of(any_of, [&](const Wanted& wanted) {
    if (!wanted.even_absent) return false;
    Visits visits;
    for (const auto& visit : sketch.visits(wanted.header)) visits.push_back(&visit);
    return !together(sketch, visits).required.empty();
  });
}

Together together(const Sketch& sketch, const Visits& visits) {
  Together all;
  for (const auto* visit : visits)
    for (const auto& name : visit->order) {
      const auto& key = visit->keys.at(name);
      if (key.refused) continue;
      const auto [known, fresh] = all.any_of.try_emplace(name);
      if (fresh) all.order.push_back(name);
      for (const auto& wanted : key.any_of)
        if (std::ranges::find(known->second, wanted) == known->second.end()) known->second.push_back(wanted);
    }
  for (const auto& name : all.order)
    if (std::ranges::all_of(visits, [&](const auto* visit) {
          const auto found = visit->keys.find(name);
          return found != visit->keys.end() && (found->second.required || is_needed(sketch, found->second.any_of));
        }))
      all.required.insert(name);
  return all;
}

Json value_of(const Sketch& sketch, const std::vector<Wanted>& any_of) {
  if (any_of.size() == 1) return json_of(sketch, any_of.front());
  Json json = Json::object();
  for (const auto& wanted : any_of) json["anyOf"].push_back(json_of(sketch, wanted));
  return json;
}

/// What the word of one key makes of the others.
Json consequence(const Sketch& sketch, const Together& all, const Together& with_word, const std::string& key) {
  Json then = Json::object();
  for (const auto& name : all.order) {
    if (name == key) continue;
    const auto found = with_word.any_of.find(name);
    if (found == with_word.any_of.end())
      then["properties"][name] = false;
    else if (!found->second.empty() && found->second != all.any_of.at(name))
      then["properties"][name] = value_of(sketch, found->second);
  }
  for (const auto& name : with_word.required)
    if (!all.required.contains(name)) then["required"].push_back(name);
  return then;
}

/// That a key has the word that it has in all these looks, and so have other keys that never have another word beside it: where the word is in
/// force without its key, they alone tell whether it is there.
Json condition_of(const Visits& looks, const std::string& key) {
  Json condition = Json::object();
  for (const auto& pick : looks.front()->picked) {
    const bool always = std::ranges::all_of(looks, [&](const auto* look) {
      const auto found = look->picked.find(pick.first);
      return found != look->picked.end() && found->second == pick.second;
    });
    if (pick.first != key && !always) continue;
    condition["properties"][pick.first]["const"] = pick.second;
    if (!looks.front()->usual.at(pick.first)) condition["required"].push_back(pick.first);
  }
  return condition;
}

Json object_of(const Sketch& sketch, const std::string& header) {
  Visits visits;
  std::map<std::string, std::map<std::string, Visits>> by_word;  // key -> word -> looks
  for (const auto& visit : sketch.visits(header)) {
    visits.push_back(&visit);
    for (const auto& [key, word] : visit.picked) by_word[key][word].push_back(&visit);
  }
  const auto all = together(sketch, visits);
  Json json{{"type", "object"}, {"properties", Json::object()}};
  for (const auto& name : all.order) json["properties"][name] = value_of(sketch, all.any_of.at(name));
  for (const auto& name : all.order)
    if (all.required.contains(name)) json["required"].push_back(name);
  const auto others = std::ranges::find_if(visits, [](const auto* visit) { return visit->others.has_value(); });
  json["additionalProperties"] = others == visits.end() ? Json(false) : json_of(sketch, *(*others)->others);
  for (const auto& [key, words] : by_word)
    for (const auto& [word, looks] : words) {
      const auto then = consequence(sketch, all, together(sketch, looks), key);
      if (then.empty()) continue;
      json["allOf"].push_back({{"if", condition_of(looks, key)}, {"then", then}});
    }
  return json;
}

std::string text_of(const Json& schema, const std::string& title) {
  Json json{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  json.update(schema);
  return json.dump(1) + "\n";
}

}  // namespace

std::string scene_schema() {
  Sketch plane, space;
  sketch_scene(plane, 2);
  sketch_scene(space, 3);
  Json json = object_of(plane, ""), of_plane = Json::object(), of_space = Json::object();
  const Json spatial = object_of(space, "");
  for (auto& [key, value] : json["properties"].items()) {
    if (value == spatial["properties"][key]) continue;
    of_plane[key] = value;
    of_space[key] = spatial["properties"][key];
    value = {{"anyOf", {of_plane[key], of_space[key]}}};  // editors complete from what stands here
  }
  json["if"] = {{"properties", {{"dimension", {{"const", 3}}}}}, {"required", {"dimension"}}};
  json["then"] = {{"properties", of_space}};
  json["else"] = {{"properties", of_plane}};
  return text_of(json, "Splashdown scene");
}

std::string study_schema() {
  Sketch sketch;
  sketch_study(sketch);
  return text_of(object_of(sketch, ""), "Splashdown study");
}

}  // namespace splashdown::apps
