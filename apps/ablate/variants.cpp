#include "apps/ablate/variants.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "apps/advise/advise.hpp"
#include "apps/effects/symmetry/symmetry.hpp"
#include "apps/price/ladder.hpp"
#include "apps/scene/kinds/effect_kind.hpp"
#include "apps/scene/mirror.hpp"
#include "apps/scene/read/echo.hpp"

namespace splashdown::apps {
namespace {

/// --set arguments that take the tables of an effect away.
std::vector<std::string> removal(const EffectKind& kind, const toml::table& scene) {
  const std::string name(kind.name());
  switch (kind.place()) {
    case TablePlace::scene:
    case TablePlace::after_bodies:
    case TablePlace::array:
      return {name + "="};
    case TablePlace::fluid:
      return {"fluid." + name + "="};
    case TablePlace::body:
    case TablePlace::body_array:
      break;
  }
  std::vector<std::string> set;
  if (const auto* bodies = scene["body"].as_array())
    for (const auto& body : *bodies)
      if (const auto* table = body.as_table(); table && table->contains(name))
        set.push_back(fmt::format("body.{}.{}=", (*table)["name"].value_or(std::string()), name));
  return set;
}

/// What is advised first, then what is doubtful: with little time the runs that tell most are made.
void telling_first(std::vector<AdvisedEffect>& effects) {
  std::ranges::stable_sort(effects, std::ranges::greater(), [](const auto& effect) { return effect.advice.advised; });
}

void add_effects(const SceneToAblate& of, std::vector<Variant>& variants) {
  const auto tables = toml::parse(of.resolved);
  auto advice = advice_of(of.scene);
  telling_first(advice.effects);
  for (const auto& effect : advice.effects) {
    if (!effect.present) continue;
    auto set = removal(*effect.kind, tables);
    if (!set.empty())
      variants.push_back(
          {"without_" + effect.name, VariantKind::without, effect.name, std::move(set), effect.advice.advised});
  }
  for (const auto& effect : advice.effects) {
    if (!effect.available || effect.present || effect.advice.set.empty()) continue;
    if (!of.all && effect.advice.advised != Advised::on) continue;
    variants.push_back(
        {"with_" + effect.name, VariantKind::with, effect.name, effect.advice.set, effect.advice.advised});
  }
}

/// Water that sticks to walls and hulls has to be viscous.
void add_slip(const SceneToAblate& of, std::vector<Variant>& variants) {
  if (!of.scene.fluid) return;
  const auto tables = toml::parse(of.resolved);
  const auto walls = tables.at_path("fluid.viscosity.walls").value<std::string>();
  if (!walls)
    variants.push_back({"no_slip",
                        VariantKind::choice,
                        "walls",
                        {"fluid.viscosity.dynamic=0.001", "fluid.viscosity.walls=no_slip"},
                        {}});
  else if (*walls == "slip")
    variants.push_back({"no_slip", VariantKind::choice, "walls", {"fluid.viscosity.walls=no_slip"}, {}});
  else
    variants.push_back({"slip", VariantKind::choice, "walls", {"fluid.viscosity.walls=slip"}, {}});
}

/// All of them where some are held, else heave alone.
void add_freedoms(const SceneToAblate& of, std::vector<Variant>& variants) {
  Variant held{"held_in_heave", VariantKind::choice, "freedoms", {}, {}},
      free{"all_free", VariantKind::choice, "freedoms", {}, {}};
  const auto all = freedom_names(of.scene.dimension);
  const std::vector<std::string> heave = {of.scene.dimension == 2 ? "y" : "z"};
  for (const auto& body : of.scene.bodies) {
    if (body.motion != Motion::free) continue;
    auto& variant = body.free.size() == all.size() ? held : free;
    variant.set.push_back(fmt::format("body.{}.free={}", body.name, toml_list(&variant == &held ? heave : all)));
  }
  for (auto* variant : {&held, &free})
    if (!variant->set.empty()) variants.push_back(std::move(*variant));
}

void add_tank(const SceneToAblate& of, std::vector<Variant>& variants) {
  if (!of.scene.tank || !of.scene.fluid || of.scene.bodies.empty()) return;
  variants.push_back({"larger_tank", VariantKind::choice, "tank", larger_tank_of(of.scene, of.name), {}});
}

/// Half of a scene that is its own mirror image.
void add_half(const SceneToAblate& of, std::vector<Variant>& variants) {
  if (mirror_of(of.scene)) return;  // without_symmetry is there
  if (const auto mirror = mirror_of_whole(of.scene))
    variants.push_back(
        {"half",
         VariantKind::choice,
         "symmetry",
         {fmt::format("symmetry.normal={}", "xy"[mirror->axis]), fmt::format("symmetry.at={}", mirror->at)},
         {}});
}

}  // namespace

const char* word(VariantKind kind) {
  switch (kind) {
    case VariantKind::scene:
      return "scene";
    case VariantKind::without:
      return "without";
    case VariantKind::with:
      return "with";
    case VariantKind::choice:
      break;
  }
  return "choice";
}

std::vector<Variant> variants_of(const SceneToAblate& of) {
  std::vector<Variant> variants = {{"scene", VariantKind::scene, "scene", {}, {}}};
  add_effects(of, variants);
  add_slip(of, variants);
  add_freedoms(of, variants);
  add_tank(of, variants);
  add_half(of, variants);
  return variants;
}

}  // namespace splashdown::apps
