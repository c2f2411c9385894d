#include "apps/advise/advise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/check/rest.hpp"
#include "apps/effects/theory/theory.hpp"
#include "apps/scene/kinds/effect_kind.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {
namespace {

constexpr double in_degrees = 180 / std::numbers::pi;
constexpr double standard_gravity = 9.80665;

std::string entry_text(const Outlook& look) {
  if (!look.entry) return {};
  const auto& entry = *look.entry;
  const auto& mover = *look.mover;
  std::string text = fmt::format("{} enters at {:.3g} m/s", look.scene.bodies[entry.body].name, entry.speed);
  if (entry.time > 1e-6 * look.scene.time.end) text += fmt::format(", {} after the start", with_unit(entry.time, "s"));
  text += entry.deadrise ? fmt::format(", deadrise {:.3g} deg", *entry.deadrise * in_degrees) : ", round";
  if (!look.has_load()) return text + ": a flat bottom, whose load is an impulse";
  text += fmt::format("; peak load about {}", with_unit(entry.peak_load, force_unit(look.dimension())));
  if (std::isfinite(mover.mass)) text += fmt::format(", {:.3g} g", entry.peak_load / mover.mass / standard_gravity);
  return text + fmt::format(", {} after contact", with_unit(entry.peak_time(), "s"));
}

void add_entry_numbers(const Outlook& look, std::vector<AdviceNumber>& numbers) {
  const auto& entry = *look.entry;
  numbers.push_back({"speed of entry", entry.speed, "m/s"});
  if (entry.deadrise) numbers.push_back({"deadrise", *entry.deadrise * in_degrees, "deg"});
  if (!look.has_load()) return;
  numbers.push_back({"peak load", entry.peak_load, force_unit(look.dimension())});
  if (std::isfinite(look.mover->mass))
    numbers.push_back({"peak acceleration", entry.peak_load / look.mover->mass / standard_gravity, "g"});
  numbers.push_back({"peak pressure", dynamic_pressure(look.scales.density, entry.contact_speed), "Pa"});
  numbers.push_back({"time of the peak", entry.time + entry.peak_time(), "s"});
}

template <int d>
std::vector<AdviceNumber> numbers_of(const Outlook& look) {
  std::vector<AdviceNumber> numbers = {{"L", look.scales.length, "m"}, {"U", look.scales.speed, "m/s"}};
  if (!look.scene.fluid) return numbers;
  if (look.entry) add_entry_numbers(look, numbers);
  if (!look.mover) return numbers;
  const auto& mover = *look.mover;
  if (std::isfinite(mover.mass) && mover.mass > 0)
    numbers.push_back({"added mass over mass", mover.added / mover.mass});
  numbers.push_back({"height over breadth", mover.height / mover.breadth});
  if (look.tank_length > 0) numbers.push_back({"breadth over the tank's", mover.breadth / look.tank_length});
  const auto resting = at_rest<d>(look.scene);
  const auto& rest = resting[look.entry ? look.entry->body : 0];
  if (rest && rest->floats) numbers.push_back({"GM afloat", rest->floats->metacentric_height, "m"});
  return numbers;
}

/// What a note of `check` says, as advice.
std::optional<Advice> advice_of_note(const EffectKind& kind, const Outlook& look) {
  const auto note = kind.note(look.scene, look.scales);
  if (!note) return {};
  Advice advice;
  advice.advised = Advised::doubtful;
  advice.reason = note->reason;
  return advice;
}

AdvisedEffect advised(const EffectKind& kind, const Outlook& look) {
  const std::string name(kind.name());
  AdvisedEffect effect{.name = name, .present = kind.present(look.scene), .kind = &kind, .advice = {}};
  auto advice = kind.advise(look);
  const auto* theory = theory_of(name);
  if (!advice && theory && look.scene.fluid) advice = theory->advise(look);
  if (!advice) advice = advice_of_note(kind, look);
  if (advice)
    effect.advice = std::move(*advice);
  else
    effect.name.clear();
  return effect;
}

}  // namespace

template <int d>
SceneAdvice advice_of(const Scene& scene) {
  const auto look = outlook<d>(scene);
  SceneAdvice all{.numbers = numbers_of<d>(look), .entry = entry_text(look), .effects = {}};
  for (const auto* kind : effect_kinds()) {
    const auto listed = std::ranges::find(all.effects, kind->name(), &AdvisedEffect::name);
    if (listed != all.effects.end()) continue;
    if (auto effect = advised(*kind, look); !effect.name.empty()) all.effects.push_back(std::move(effect));
  }
  if (scene.fluid && look.scales.speed > 0)
    for (const auto* row : theory_of_what_is_missing())
      all.effects.push_back({.name = std::string(row->name), .available = false, .advice = row->advise(look)});
  return all;
}

SceneAdvice advice_of(const Scene& scene) { return scene.dimension == 2 ? advice_of<2>(scene) : advice_of<3>(scene); }

template SceneAdvice advice_of<2>(const Scene&);
template SceneAdvice advice_of<3>(const Scene&);

}  // namespace splashdown::apps
