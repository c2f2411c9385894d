#include "apps/price/write.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/statistics/verdict/share.hpp"
#include "apps/statistics/verdict/statements.hpp"
#include "apps/text/number_text.hpp"
#include "apps/text/plain_text.hpp"

namespace splashdown::apps {
namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json json_of(const Rung& rung) {
  return {{"refine", rung.spec.refine},
          {"seconds", rung.seconds},
          {"node_steps", rung.node_steps},
          {"memory_mb", rung.memory_mb}};
}

Json json_of(const std::vector<std::pair<Rung, double>>& rungs, const PricedQuantity& quantity) {
  Json list = Json::array();
  for (const auto& [rung, value] : rungs) {
    Json entry = {{"refine", rung.spec.refine}, {"value", value}};
    entry.update(json_of(rung));
    const auto told = std::ranges::find(quantity.told, rung.spec.refine, &std::pair<double, double>::first);
    if (told != quantity.told.end() && rung.spec.role == Role::rung) entry["told_error"] = told->second;
    list.push_back(std::move(entry));
  }
  return list;
}

/// Numbers of runs by refine.
Json json_of(const std::vector<std::pair<double, int>>& runs) {
  Json list = Json::array();
  for (const auto& [refine, number] : runs) list.push_back({{"refine", refine}, {"runs", number}});
  return list;
}

Json json_of(const std::vector<PriceRow>& rows) {
  Json list = Json::array();
  for (const auto& row : rows)
    list.push_back({{"accuracy_percent", row.accuracy_percent},
                    {"seconds", number(row.seconds)},
                    {"refine", number(row.refine)},
                    {"extrapolated", row.extrapolated},
                    {"from", row.seconds ? Json(source_of(row)) : Json(nullptr)},
                    {"decided_by", row.decided_by},
                    {"runs", row.runs},
                    {"beside", json_of(row.beside)}});
  return list;
}

/// Of the sizes of mesh that have enough runs.
Json means_of(const PricedQuantity& quantity) {
  Json list = Json::array();
  for (const auto& [rung, value] : quantity.rungs) {
    const auto mean = quantity.mean(rung.spec.refine);
    if (mean)
      list.push_back({{"refine", rung.spec.refine},
                      {"runs", mean->runs},
                      {"value", mean->value},
                      {"band", mean->band},
                      {"deviation", mean->deviation}});
  }
  return list;
}

Json json_of(const PricedQuantity& quantity) {
  const auto band = quantity.band_of_finest();
  const auto& fit = quantity.fit;
  return {{"value", quantity.value},
          {"band", number(band)},
          {"order", fit ? number(fit->order()) : Json(nullptr)},
          {"scatter", number(quantity.scatter)},
          {"unit", quantity.what.unit},
          {"counts", quantity.what.counts},
          {"richardson", fit ? number(fit->extrapolated()) : Json(nullptr)},
          {"refused", fit                     ? fit->refusal()
                      : quantity.told.empty() ? "fewer than three meshes have a value"
                                              : "meshes tell their errors themselves"},
          {"path", quantity.what.path},
          {"expression", quantity.what.measured.quantity},
          {"from", quantity.what.measured.table},
          {"where", quantity.what.measured.where},
          {"resolution", quantity.what.resolution},
          {"least_resolution", quantity.what.least_resolution},
          {"rows", json_of(quantity.rows)},
          {"means", means_of(quantity)},
          {"told", quantity.what.told},
          {"rungs", json_of(quantity.rungs, quantity)},
          {"replicates", json_of(quantity.replicates, quantity)},
          {"tank", number(quantity.tank)},
          {"in_larger_tank", json_of(quantity.in_larger_tank, quantity)}};
}

Role role_of(const std::string& word) {
  for (const Role role : {Role::replicate, Role::larger_tank})
    if (word == word_of(role)) return role;
  return Role::rung;
}

Rung rung_of(const Json& json) {
  for (const char* key : {"refine", "seconds", "steps", "node_steps"})
    if (!(json.at(key).get<double>() > 0)) throw std::runtime_error(fmt::format("{} must be positive", key));
  return {.spec = {json.at("refine").get<double>(), role_of(json.at("role").get<std::string>())},
          .folder = json.value("folder", ""),
          .seconds = json.at("seconds").get<double>(),
          .steps = json.at("steps").get<double>(),
          .node_steps = json.at("node_steps").get<double>(),
          .memory_mb = json.at("memory_mb").get<double>(),
          .setup_seconds = json.value("setup_seconds", 0.),
          .output_seconds = json.value("output_seconds", 0.),
          .values = {}};
}

PriceQuantity quantity_of(const std::string& name, const Json& json) {
  PriceQuantity quantity{.name = name,
                         .unit = json.at("unit").get<std::string>(),
                         .counts = json.at("counts").get<bool>(),
                         .path = json.at("path").get<std::string>(),
                         .measured = {}};
  quantity.measured.name = name;
  quantity.measured.quantity = json.at("expression").get<std::string>();
  quantity.measured.table = json.at("from").get<std::string>();
  quantity.measured.where = json.at("where").get<std::string>();
  quantity.resolution = json.value("resolution", "");
  quantity.least_resolution = json.value("least_resolution", 0.);
  quantity.told = json.value("told", "");
  return quantity;
}

std::string listed_value(double value, const std::string& unit) {
  return unit == "-" ? fmt::format("{:.4g}", value) : with_unit(value, unit);  // without a unit no prefix
}

/// A band or a scatter over the value; "?" where there is nothing to hold it against.
std::string relative(const std::optional<double>& part, double whole) {
  const auto ratio = part ? ratio_of(*part, whole) : std::nullopt;
  return ratio ? fmt::format("{:.2g} %", 100 * *ratio) : "?";
}

/// With the prefix that its value has.
std::string band_text(double band, double value, const std::string& unit) {
  const double factor = unit == "-" ? 1 : prefix_of(value).factor;
  const auto ratio = ratio_of(band, value);
  return fmt::format("+- {:.2g} ({})", band / factor, ratio ? band_mark(*ratio, "") : "?");
}

const std::vector<std::pair<const char*, Role>> lists = {
    {"rungs", Role::rung}, {"replicates", Role::replicate}, {"in_larger_tank", Role::larger_tank}};

std::string row_text(const PriceRow& row) {
  std::string words = row.runs > 1 ? runs_text(row) : "";
  if (!row.measured) words += (words.empty() ? "" : "; ") + std::string(source_of(row));
  return fmt::format("  {:>5g} %  {:>8}  {:>6.3g}  {}{}\n", row.accuracy_percent, about_time(*row.seconds), *row.refine,
                     row.decided_by, words.empty() ? "" : "  (" + words + ")");
}

/// The first accuracy that refinement does not reach, and what is in its way.
std::string unreached_text(const Price& price, const PriceRow& row) {
  auto text = fmt::format("  {:>5g} %         -       -  {}: not by elements up to {:g} times smaller",
                          row.accuracy_percent, row.decided_by, farthest_extrapolation);
  for (const auto& quantity : price.quantities)
    if (quantity.what.name == row.decided_by && quantity.scatter)
      text += fmt::format("; meshes of equal size differ by {}", relative(quantity.scatter, quantity.value));
  return text + "\n";
}

std::string rows_text(const Price& price) {
  std::string text;
  for (const auto& row : price.rows) {
    text += row.seconds ? row_text(row) : unreached_text(price, row);
    if (!row.seconds) break;  // nor are the closer ones
  }
  return text;
}

/// Each quantity by itself, where the list alone does not say it.
std::string prices_text(const Price& price, std::size_t width) {
  const auto priced = [](const PricedQuantity& quantity) { return !quantity.rows.empty(); };
  if (std::ranges::count_if(price.quantities, priced) < 2) return {};
  std::string text = fmt::format("  {:<{}}", "each by itself", width);
  for (const double percent : price.percent) text += fmt::format("  {:>7}", fmt::format("{:g} %", percent));
  text += "\n";
  bool any_beyond = false, any_mean = false;
  for (const auto& quantity : price.quantities) {
    if (!priced(quantity)) continue;
    text += fmt::format("  {:<{}}", quantity.what.name, width);
    for (const double percent : price.percent) {
      const auto* row = row_for(quantity.rows, percent);
      const bool beyond = row && row->extrapolated;
      any_beyond |= beyond;
      any_mean |= row && row->runs > 1;
      text += fmt::format("  {:>7}", row ? about_time(*row->seconds) + (beyond ? "*" : row->runs > 1 ? "+" : "") : "-");
    }
    text += "\n";
  }
  return text + (any_beyond ? "  * extrapolated\n" : "") + (any_mean ? "  + mean of several runs\n" : "");
}

std::string counted(std::size_t number, const char* one, const char* many) {
  return fmt::format("{} {}", number, number == 1 ? one : many);
}

/// Of the finest mesh, as its column has it.
std::string finest_band_text(const PricedQuantity& quantity) {
  const auto band = quantity.band_of_finest();
  return band ? band_text(*band, quantity.value, quantity.what.unit) : "?";
}

/// Means of runs that are better known than the value on the finest mesh.
std::string means_text(const Price& price, std::size_t width, std::size_t band_width) {
  std::string text;
  for (const auto& quantity : price.quantities) {
    const auto finest = quantity.band_of_finest();
    const auto best = best_mean(quantity);
    if (!best || (finest && *finest <= best->second.band)) continue;
    const auto& [refine, mean] = *best;
    text += fmt::format("  {:<{}}  {:>12}  {:>{}}  mean of {} runs at refine {:.3g}, which scatter by {}\n",
                        quantity.what.name, width, listed_value(mean.value, quantity.what.unit),
                        band_text(mean.band, mean.value, quantity.what.unit), band_width, mean.runs, refine,
                        relative(mean.deviation, mean.value));
  }
  return text;
}

/// Why a quantity plays no part in the rows; empty: it does.
std::string not_counted(const PricedQuantity& quantity) {
  if (!quantity.told.empty())
    return quantity.what.counts ? "  (told by each mesh)" : "  (told by each mesh, not counted)";
  if (!quantity.fit) return fmt::format("  (on {}: too few)", counted(quantity.rungs.size(), "mesh", "meshes"));
  return quantity.what.counts ? "" : "  (not counted)";
}

/// Each reason once, with the quantities that have no order for it.
std::string refusals_text(const Price& price) {
  std::map<std::string, std::string> names;
  for (const auto& quantity : price.quantities)
    if (quantity.fit && !quantity.fit->order()) {
      auto& list = names[quantity.fit->refusal()];
      list += (list.empty() ? "" : ", ") + quantity.what.name;
    }
  std::string text;
  for (const auto& [reason, list] : names) text += fmt::format("  no order: {}: {}\n", list, reason);
  return text;
}

}  // namespace

std::string word_of(Role role) {
  return role == Role::rung ? "rung" : role == Role::replicate ? "replicate" : "larger tank";
}

std::string about_time(double seconds) {
  if (seconds < 100) return fmt::format("{:.2g} s", seconds);
  if (seconds < 6000) return fmt::format("{:.2g} min", seconds / 60);
  return fmt::format("{:.2g} h", seconds / 3600);
}

std::string runs_text(const PriceRow& row) {
  auto text = fmt::format("mean of {} runs", row.runs);
  for (const auto& [refine, number] : row.beside) text += fmt::format(", {} more at {:.3g}", number, refine);
  return text;
}

std::string price_json(const Price& price) {
  Json root;
  root["scene"] = price.scene;
  root["title"] = price.title;
  root["scene_digest"] = price.scene_digest;
  root["dimension"] = price.dimension;
  root["asked_percent"] = price.asked > 0 ? Json(100 * price.asked) : Json(nullptr);
  root["reached"] = price.asked > 0 && price.is_reached(price.asked);
  root["rows"] = json_of(price.rows);
  root["quantities"] = Json::object();
  for (const auto& quantity : price.quantities) root["quantities"][quantity.what.name] = json_of(quantity);
  root["runs"] = Json::array();
  for (const auto& rung : price.rungs) {
    root["runs"].push_back(json_of(rung));
    root["runs"].back()["steps"] = rung.steps;
    root["runs"].back()["setup_seconds"] = rung.setup_seconds;
    root["runs"].back()["output_seconds"] = rung.output_seconds;
    root["runs"].back()["role"] = word_of(rung.spec.role);
    root["runs"].back()["folder"] = rung.folder;
  }
  root["expected_nodes"] = price.expected_nodes;
  return root.dump(2) + "\n";
}

Price read_price(const std::filesystem::path& file) {
  try {
    std::ifstream in(file);
    const auto root = Json::parse(in);
    Price price;
    price.scene = root.at("scene").get<std::string>();
    price.title = root.at("title").get<std::string>();
    price.scene_digest = root.at("scene_digest").get<std::string>();
    price.dimension = root.at("dimension").get<int>();
    std::vector<PriceQuantity> quantities;
    for (const auto& run : root.at("runs")) price.rungs.push_back(rung_of(run));
    for (auto& rung : price.rungs) {
      rung.values.assign(root.at("quantities").size(), NAN);
      rung.told = rung.values;
    }
    std::size_t q = 0;
    for (const auto& [name, entry] : root.at("quantities").items()) {
      quantities.push_back(quantity_of(name, entry));
      for (const auto& [list, role] : lists)
        for (const auto& measured : entry.at(list))
          for (auto& rung : price.rungs)
            if (rung.spec.refine == measured.at("refine").get<double>() && rung.spec.role == role) {
              rung.values[q] = measured.at("value").get<double>();
              rung.told[q] = measured.value("told_error", std::nan(""));
            }
      ++q;
    }
    std::vector<std::string> unused;
    auto whole = price_of(price.rungs, quantities, price.dimension, unused);
    whole.scene = price.scene;
    whole.title = price.title;
    whole.scene_digest = price.scene_digest;
    if (const auto asked = root.find("asked_percent"); asked != root.end() && asked->is_number())
      whole.asked = asked->get<double>() / 100;
    whole.expected_nodes = root.at("expected_nodes").get<std::vector<std::pair<double, double>>>();
    list_rows(whole);
    return whole;
  } catch (const std::exception& error) {
    throw std::runtime_error(
        fmt::format("{}: is not a price list. Make it anew with splashdown price. ({})", file.string(), error.what()));
  }
}

std::string price_line(const Price& price) {
  std::string line;
  for (const auto& row : price.rows)
    if (row.seconds)
      line += fmt::format("{}{:g} %: {}{}", line.empty() ? "" : "; ", row.accuracy_percent, about_time(*row.seconds),
                          row.runs > 1       ? fmt::format(", {} runs", row.runs)
                          : row.extrapolated ? ", extrapolated"
                                             : "");
  return line;
}

std::string price_text(const Price& price) {
  const auto number_of = [&](Role role) {
    return static_cast<std::size_t>(
        std::ranges::count_if(price.rungs, [=](const Rung& rung) { return rung.spec.role == role; }));
  };
  std::string text = fmt::format(
      "{}: {} and {}{}, the finest at refine {:.3g}\n", one_line(price.title.empty() ? price.scene : price.title),
      counted(number_of(Role::rung), "mesh", "meshes"), counted(number_of(Role::replicate), "replicate", "replicates"),
      number_of(Role::larger_tank) > 0 ? ", one in a larger tank" : "", price.finest());
  if (!price.rows.empty()) text += "  accuracy      time  refine  decided by\n";
  text += rows_text(price);
  std::size_t width = 14, band_width = 20;
  for (const auto& quantity : price.quantities) {
    width = std::max(width, quantity.what.name.size());
    band_width = std::max(band_width, finest_band_text(quantity).size());
  }
  text += fmt::format("  {:<{}}  {:>12}  {:>{}}  {:>5}  {:>7}\n", "quantity", width, "value", "band", band_width,
                      "order", "scatter");
  for (const auto& quantity : price.quantities) {
    const auto order = quantity.fit ? quantity.fit->order() : std::nullopt;
    text += fmt::format("  {:<{}}  {:>12}  {:>{}}  {:>5}  {:>7}{}\n", quantity.what.name, width,
                        listed_value(quantity.value, quantity.what.unit), finest_band_text(quantity), band_width,
                        order ? fmt::format("{:.2f}", *order) : "-", relative(quantity.scatter, quantity.value),
                        not_counted(quantity));
  }
  return text + means_text(price, width, band_width) + prices_text(price, width) + refusals_text(price);
}

}  // namespace splashdown::apps
