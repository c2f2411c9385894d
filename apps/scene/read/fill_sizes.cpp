#include "apps/scene/read/fill_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "apps/scene/choose/sizes.hpp"
#include "apps/scene/kinds/formulation_kinds.hpp"

namespace splashdown::apps {
namespace {

toml::table* table_of(toml::table& root, const ChosenSize& chosen) {
  if (chosen.table != "body") {
    auto& fluid = *root["fluid"].as_table();
    if (!fluid.contains("size")) fluid.insert("size", toml::table{});
    return fluid["size"].as_table();
  }
  auto* bodies = root["body"].as_array();
  return bodies && chosen.index < bodies->size() ? bodies->get(chosen.index)->as_table() : nullptr;
}

}  // namespace

bool sizes_are_open(const toml::table& root) {
  const auto* fluid = root["fluid"].as_table();
  if (!fluid) return false;
  const auto name = root["fluid"]["formulation"].value_or(formulation_kinds().front().name);
  const auto kinds = formulation_kinds();
  const auto kind = std::ranges::find(kinds, name, &FormulationKind::name);
  return (kind == kinds.end() || kind->medium == FluidMedium::particles) &&
         (!fluid->contains("size") || (fluid->get("size")->is_table() && !root["fluid"]["size"]["surface"]));
}

std::vector<std::string> fill_sizes(toml::table& root, const Scene& read) {
  std::vector<std::string> lines;
  std::vector<ChosenSize> rules;
  try {
    rules = read.dimension == 2 ? size_rules<2>(read) : size_rules<3>(read);
  } catch (const std::invalid_argument&) {  // a shape that is none: the reader will say so
    return lines;
  }
  for (const auto& chosen : rules) {
    auto* table = table_of(root, chosen);
    if (!table || table->contains(chosen.key)) continue;
    table->insert(chosen.key, chosen.value);
    const auto name = chosen.table == "body" ? "body." + read.bodies[chosen.index].name : chosen.table;
    lines.push_back(fmt::format("{}.{} = {:g}{}: {}", name, chosen.key, chosen.value, chosen.unit, chosen.why));
  }
  if (!lines.empty() && read.fluid->size.refine != 1)
    lines.push_back(fmt::format("all lengths divided by fluid.size.refine = {:g}", read.fluid->size.refine));
  return lines;
}

}  // namespace splashdown::apps
