#include "apps/ablate/write.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/text/number_text.hpp"
#include "apps/text/plain_text.hpp"

namespace splashdown::apps {
namespace {

using Json = nlohmann::ordered_json;

Json json_number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json json_number(const std::optional<double>& value) { return value ? json_number(*value) : Json(nullptr); }

std::string csv_cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); }
std::string csv_cell(const std::optional<double>& value) { return value ? csv_cell(*value) : std::string(); }

/// Quoted where RFC 4180 asks for it.
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted(1, '"');
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

Json json_of(const PriceQuantity& quantity, const Change& change) {
  return {{"quantity", quantity.name},
          {"unit", quantity.unit},
          {"counts", quantity.counts},
          {"value", json_number(change.value)},
          {"change", json_number(change.relative)},
          {"band", json_number(change.band)},
          {"meaning", word(change.meaning)}};
}

/// Columns of quantities that say something in any variant.
std::vector<std::size_t> shown_quantities(const Ablation& ablation) {
  std::vector<std::size_t> shown;
  for (std::size_t q = 0; q < ablation.quantities.size(); ++q)
    if (std::ranges::any_of(ablation.variants,
                            [q](const VariantResult& v) { return std::isfinite(v.changes[q].relative); }))
      shown.push_back(q);
  return shown;
}

/// A sign of two bytes is one character wide.
std::string padded(const std::string& text, std::size_t width) {
  const auto wide = static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
  return std::string(width > wide ? width - wide : 0, ' ') + text;
}

std::string table_text(const AblationPlan& plan, const Ablation& ablation) {
  const auto shown = shown_quantities(ablation);
  std::string text;
  for (const std::size_t q : shown) {
    const auto& quantity = ablation.quantities[q];
    text += fmt::format("  {:<34} {:>14}", quantity.name + (quantity.counts ? "" : " (not counted)"),
                        with_unit(ablation.base[q], quantity.unit == "-" ? "" : quantity.unit));
    for (std::size_t v = 1; v < plan.variants.size(); ++v)
      text += "  " + padded(change_text(ablation.variants[v].changes[q]), 20);
    text += '\n';
  }
  const auto& own = ablation.variants.front();
  text += fmt::format("  {:<34} {:>14}", "seconds", own.seconds ? with_unit(*own.seconds, "s") : "-");
  for (std::size_t v = 1; v < plan.variants.size(); ++v) {
    const auto& time = ablation.variants[v].time_change;
    text += "  " + padded(time ? fmt::format("{}{:.0f} %", *time >= 0 ? "+" : "", 100 * *time) : "-", 20);
  }
  std::string head = fmt::format("  {:<34} {:>14}", "", "scene");
  for (std::size_t v = 1; v < plan.variants.size(); ++v) {
    const auto& variant = plan.variants[v];
    head += "  " + padded(variant.kind == VariantKind::choice ? variant.name : variant.what, 20);
  }
  return head + "\n" + text + "\n";
}

}  // namespace

std::string ablation_csv(const AblationPlan& plan, const Ablation& ablation) {
  std::string text =
      "variant,kind,what,quantity,unit,counts,scene,value,change,band,meaning,verdict,advice,agrees,seconds,"
      "time_change,cause\n";
  for (std::size_t v = 0; v < plan.variants.size(); ++v) {
    const auto& variant = plan.variants[v];
    const auto& result = ablation.variants[v];
    for (std::size_t q = 0; q < ablation.quantities.size(); ++q) {
      const auto& quantity = ablation.quantities[q];
      const auto& change = result.changes[q];
      text +=
          fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_cell(variant.name),
                      word(variant.kind), csv_cell(variant.what), csv_cell(quantity.name), csv_cell(quantity.unit),
                      quantity.counts ? "yes" : "no", csv_cell(ablation.base[q]), csv_cell(change.value),
                      csv_cell(change.relative), csv_cell(change.band), word(change.meaning), result.verdict,
                      variant.advised ? word(*variant.advised) : "", result.agrees ? *result.agrees ? "yes" : "no" : "",
                      csv_cell(result.seconds), csv_cell(result.time_change), csv_cell(result.cause));
    }
  }
  return text;
}

std::string ablation_json(const AblationPlan& plan, const Ablation& ablation, double least) {
  Json root = {{"title", plan.title},
               {"scene", plan.study.scene.string()},
               {"set", plan.study.set},
               {"matters_above", least},
               {"meshes", plan.replicates()}};
  root["variants"] = Json::array();
  for (std::size_t v = 0; v < plan.variants.size(); ++v) {
    const auto& variant = plan.variants[v];
    const auto& result = ablation.variants[v];
    Json entry = {
        {"variant", variant.name}, {"kind", word(variant.kind)}, {"what", variant.what}, {"set", variant.set}};
    entry["advice"] = variant.advised ? Json(word(*variant.advised)) : Json(nullptr);
    entry["verdict"] = result.verdict;
    entry["line"] = variant.kind == VariantKind::scene ? std::string() : verdict_line(plan, ablation, v);
    entry["agrees"] = result.agrees ? Json(*result.agrees) : Json(nullptr);
    entry["cause"] = result.cause;
    entry["seconds"] = json_number(result.seconds);
    entry["time_change"] = json_number(result.time_change);
    entry["deciding"] = result.deciding ? Json(ablation.quantities[*result.deciding].name) : Json(nullptr);
    entry["changes"] = Json::array();
    for (std::size_t q = 0; q < ablation.quantities.size(); ++q)
      entry["changes"].push_back(json_of(ablation.quantities[q], result.changes[q]));
    root["variants"].push_back(std::move(entry));
  }
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string ablation_text(const AblationPlan& plan, const Ablation& ablation) {
  std::string text;
  for (std::size_t v = 1; v < plan.variants.size(); ++v) text += verdict_line(plan, ablation, v) + "\n";
  return text + "\nwhat each effect adds to the numbers of the scene, and each choice changes\n" +
         table_text(plan, ablation);
}

}  // namespace splashdown::apps
