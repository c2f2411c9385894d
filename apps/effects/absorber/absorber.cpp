#include "apps/effects/absorber/absorber.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/scene/read/reader.hpp"
#include "fluid/effects/absorber/absorber.hpp"

namespace splashdown::apps {

void AbsorberKind::read(Reader& reader, Scene& scene) const {
  auto& table = scene.effects.table<Absorber>();
  reader.number("width", table.width, positive("m", "Use one to two of the longest wavelengths."), Need::required);
  reader.number("rate", table.rate, positive("1/s", "Use about the wave's angular frequency."), Need::required);
  reader.choice("ends", table.ends, {"both", "lower", "upper"});
}

void AbsorberKind::check(const Scene& scene, Problems& problems) const {
  const auto* table = scene.effects.find<Absorber>();
  if (!table || problems.found_in("tank")) return;
  if (!scene.tank)
    problems.add("fluid.absorber", "needs a [tank]: it acts along the tank's ends", "Add [tank] or remove the table.");
  else if ((table->ends == "both" ? 2 : 1) * table->width > scene.tank->max.x() - scene.tank->min.x())
    problems.add("fluid.absorber.width",
                 fmt::format("must not exceed {}the tank's length", table->ends == "both" ? "half " : ""),
                 "Make the tank longer.");
}

// The best rate is about the angular frequency of the waves that the zone is as long as.
void AbsorberKind::ask(const AskedScene& asked, std::vector<std::string>& questions) const {
  const double shortest = 0.01, slowest = 0.3, fastest = 3;  // of the tank; of sqrt(2 pi g / width)
  const auto* zone = asked.scene.effects.find<Absorber>();
  if (!zone || !asked.scene.tank) return;
  const double length = asked.scene.tank->max.x() - asked.scene.tank->min.x();
  if (zone->width < shortest * length)
    questions.push_back(
        fmt::format("fluid.absorber.width = {:g} m at the ends of a tank of {:g} m: too short for any wave: did "
                    "you mean {:g} m?",
                    zone->width, length, length / 8));
  if (asked.pull <= 0 || zone->width < shortest * length) return;
  const double wave = std::sqrt(2 * std::numbers::pi * asked.pull / zone->width), ratio = zone->rate / wave;
  if (ratio >= slowest && ratio <= fastest) return;
  questions.push_back(
      fmt::format("fluid.absorber.rate = {:g} 1/s: waves as long as the zone, {:g} m, have {:.3g} rad/s, and {}: did "
                  "you mean {:.2g}?",
                  zone->rate, zone->width, wave,
                  ratio > fastest ? "a faster one throws them back" : "a slower one lets them through", wave));
}

std::optional<EffectNote> AbsorberKind::note(const Scene& scene, const Scales& s) const {
  if (!scene.fluid) return {};
  EffectNote note{"absorber", present(scene), "no tank, no ends that reflect waves"};
  if (!scene.tank || s.gravity == 0) {
    if (scene.tank) note.reason = "no gravity, no waves to absorb";
    return note;
  }
  const double depth = std::max(0., s.level - scene.tank->min[scene.dimension - 1]);
  const double there_and_back = (scene.tank->max.x() - scene.tank->min.x()) / std::sqrt(s.gravity * depth);
  note.reason =
      fmt::format("the fastest waves cross the tank in {:.3g} s, the run lasts {:.3g} s: {}", there_and_back,
                  scene.time.end, there_and_back > scene.time.end ? "no echo returns" : "echoes return from the ends");
  return note;
}

/// Waves go out with the speed of their group, half of sqrt(g lambda/2 pi), and come back from the ends.
std::optional<Advice> AbsorberKind::advise(const Outlook& look) const {
  using std::numbers::pi;
  if (!look.scene.fluid) return {};
  Advice advice;
  advice.source = "group speed of deep water, fastest waves sqrt(g depth) (Lamb 1932)";
  const bool moves = look.mover && look.mover->moves;
  if (!look.scene.tank || look.pull <= 0 || look.depth == 0 || !moves) {
    advice.reason = !look.scene.tank ? "without a tank there are no ends that reflect waves"
                    : look.pull <= 0
                        ? "without gravity there are no waves"
                        : "nothing makes waves that would have to leave: the walls are a part of the scene";
    return advice;
  }
  const double fastest = std::sqrt(look.pull * look.depth);
  const double group = std::min(fastest, 0.5 * std::sqrt(look.pull * look.wave_length / (2 * pi)));
  const double begins = look.entry ? look.entry->time : 0, lasts = look.scene.time.end - begins;
  advice.numbers.push_back({"run over the time of the fastest echo", lasts * fastest / look.tank_length});
  advice.numbers.push_back({"run over the time of its own waves' echo", lasts * group / look.tank_length});
  if (look.has_load()) advice.change.peak = 0;
  const bool starts_calm = !look.entry && look.starts_at_rest();
  advice.advised = lasts * fastest < look.tank_length                ? Advised::off
                   : lasts * group < look.tank_length || starts_calm ? Advised::doubtful
                                                                     : Advised::on;
  advice.reason = advice.advised == Advised::off        ? "the run is over before an echo returns"
                  : advice.advised == Advised::doubtful ? "an echo returns, of waves that may be small"
                                                        : "its own waves return from the ends within the run";
  if (advice.advised == Advised::off) advice.change.motion = 0;
  if (!present(look.scene)) {
    const double width = std::min(look.wave_length, look.tank_length / 4);
    advice.set = {fmt::format("fluid.absorber.width={:.3g}", width),
                  fmt::format("fluid.absorber.rate={:.3g}", std::sqrt(2 * pi * look.pull / width))};
  }
  return advice;
}

template <int d>
void AbsorberKind::build_in(const Scene& scene, const EffectParts<d>& parts) const {
  const auto* zone = scene.effects.find<Absorber>();
  parts.fluid.push_back(std::make_unique<fluid::Absorber<d>>(fluid::AbsorberSpec{.from = scene.tank->min.x(),
                                                                                 .to = scene.tank->max.x(),
                                                                                 .width = zone->width,
                                                                                 .rate = zone->rate,
                                                                                 .lower = zone->ends != "upper",
                                                                                 .upper = zone->ends != "lower"}));
}

template void AbsorberKind::build_in<2>(const Scene&, const EffectParts<2>&) const;
template void AbsorberKind::build_in<3>(const Scene&, const EffectParts<3>&) const;

}  // namespace splashdown::apps
