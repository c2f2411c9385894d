#include "apps/ablate/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/ablate/variants.hpp"
#include "apps/price/ladder.hpp"
#include "apps/scene/choose/refine.hpp"
#include "apps/scene/read/read.hpp"
#include "apps/scene/scales.hpp"

namespace splashdown::apps {
namespace {

Axis variant_axis(const std::vector<Variant>& variants) {
  Axis axis;
  axis.name = axis.label = "variant";
  for (const auto& variant : variants) axis.values.push_back({variant.name, {}, variant.set, {}});
  return axis;
}

/// The scene's mesh and two beside it; a scene without a fluid has none to scatter by.
Axis mesh_axis(const Scene& scene) {
  Axis axis;
  axis.name = axis.label = "refine";
  axis.leader = 1;
  if (!scene.has_fluid()) {
    axis.values.push_back({"no_mesh", {}, {}, {}});
    return axis;
  }
  for (const double sign : {0., -1., 1.}) {
    const double refine = refine_of(scene) * (1 + sign * replicate_offset);
    const auto text = digits_of(refine);
    axis.values.push_back({text, refine, {fmt::format("{}={}", refine_key, text)}, {}});
  }
  return axis;
}

PriceQuantity measured(const std::string& name, const std::string& unit, const std::string& table,
                       const std::string& expression) {
  PriceQuantity quantity{.name = name, .unit = unit, .path = {}, .measured = {}};
  quantity.measured.name = name;
  quantity.measured.table = table;
  quantity.measured.quantity = expression;
  return quantity;
}

/// Bodies' loads and motions, gauges' ranges; where there is neither the energy of the water.
std::vector<PriceQuantity> headline(const Scene& scene) {
  auto quantities = default_quantities(scene);
  for (const auto& record : scene.records)
    if (const auto* gauge = std::get_if<ElevationEntry>(&record))
      quantities.push_back(
          measured(gauge->name + ".range", "m", "probes.csv:" + gauge->name, "max(value) - min(value)"));
  if (scene.fluid && std::ranges::none_of(quantities, &PriceQuantity::counts)) {
    const std::string unit = scene.dimension == 2 ? "J/m" : "J";
    quantities.push_back(measured("water.kinetic_energy", unit, "fluid.csv", "max(kinetic_energy)"));
  }
  return quantities;
}

void scale(AblationPlan& plan, const Scene& scene) {
  const auto s = scene.dimension == 2 ? scales<2>(scene) : scales<3>(scene);
  plan.length = s.length;
  plan.speed = s.speed;
  plan.load = s.density * std::max(s.gravity * s.length, s.speed * s.speed) * std::pow(s.length, scene.dimension - 1);
}

/// Those that can be read, beside the scene itself.
std::vector<Variant> readable(const AblationOrder& order, std::vector<Variant> variants,
                              std::vector<std::string>& notes) {
  std::erase_if(variants, [&](const Variant& variant) {
    auto set = order.set;
    set.insert(set.end(), variant.set.begin(), variant.set.end());
    try {
      read_scene(order.scene, set);
      return false;
    } catch (const SceneError& error) {
      notes.push_back(fmt::format("{} is left out: {}", variant.name, error.messages().front()));
      return true;
    }
  });
  return variants;
}

void keep_only(const std::vector<std::string>& only, std::vector<Variant>& variants) {
  std::vector<std::string> valid;
  for (const auto& variant : variants)
    if (variant.kind != VariantKind::scene) valid.push_back(variant.what);
  for (const auto& name : only)
    if (std::ranges::find(valid, name) == valid.end()) {
      const auto near = nearest(name, valid);
      throw SceneError({fmt::format("--only {}: is no effect or choice of this ablation. {}", name,
                                    near.empty() ? "Use " + listing(valid) + "." : "Did you mean '" + near + "'?")});
    }
  if (only.empty()) return;
  std::erase_if(variants, [&](const Variant& variant) {
    return variant.kind != VariantKind::scene && std::ranges::find(only, variant.what) == only.end();
  });
}

}  // namespace

AblationPlan plan_ablation(const AblationOrder& order) {
  const auto file = read_scene(order.scene, order.set);
  AblationPlan plan;
  plan.title = file.scene.title;
  plan.dimension = file.scene.dimension;
  scale(plan, file.scene);
  auto variants = variants_of({.scene = file.scene,
                               .resolved = file.resolved,
                               .name = order.scene.string(),
                               .all = order.all || !order.only.empty()});
  keep_only(order.only, variants);
  plan.variants = readable(order, std::move(variants), plan.notes);
  for (const auto& argument : order.quantities) plan.quantities.push_back(parsed_quantity(argument));
  for (auto& quantity : headline(file.scene)) {
    quantity.counts &= order.quantities.empty();
    plan.quantities.push_back(std::move(quantity));
  }
  check_price_quantities(plan.quantities, file.scene);
  if (plan.variants.size() < 2 || plan.quantities.empty())
    throw SceneError({fmt::format(
        "{}: has {}. Name what matters, e.g. --quantity \"level=last(value) from "
        "probes.csv:gauge\", or add a table.",
        order.scene.string(),
        plan.quantities.empty() ? "no body and no record to measure" : "no effect that could be taken away or added")});
  plan.study.file = plan.study.scene = std::filesystem::absolute(order.scene);
  plan.study.title = file.scene.title;
  plan.study.set = order.set;
  plan.study.reports = false;
  plan.study.axes = {variant_axis(plan.variants), mesh_axis(file.scene)};
  plan.runs = expand(plan.study);
  resolve(plan.study, plan.runs);
  return plan;
}

}  // namespace splashdown::apps
