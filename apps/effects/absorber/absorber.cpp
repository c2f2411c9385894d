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
}

void AbsorberKind::check(const Scene& scene, Problems& problems) const {
  const auto* table = scene.effects.find<Absorber>();
  if (!table || problems.found_in("tank")) return;
  if (!scene.tank)
    problems.add("fluid.absorber", "needs a [tank]: it acts along the tank's ends", "Add [tank] or remove the table.");
  else if (2 * table->width > scene.tank->max.x() - scene.tank->min.x())
    problems.add("fluid.absorber.width", "must not exceed half the tank's length", "Make the tank longer.");
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

template <int d>
void AbsorberKind::build_in(const Scene& scene, const EffectParts<d>& parts) const {
  const auto* zone = scene.effects.find<Absorber>();
  parts.fluid.push_back(std::make_unique<fluid::Absorber<d>>(fluid::AbsorberSpec{
      .from = scene.tank->min.x(), .to = scene.tank->max.x(), .width = zone->width, .rate = zone->rate}));
}

template void AbsorberKind::build_in<2>(const Scene&, const EffectParts<2>&) const;
template void AbsorberKind::build_in<3>(const Scene&, const EffectParts<3>&) const;

}  // namespace splashdown::apps
