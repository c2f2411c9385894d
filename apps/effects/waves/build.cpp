// From [waves] to the water at t = 0, the effect that keeps the sea, and what gauges would see without bodies.
#include <cmath>
#include <memory>

#include "apps/effects/waves/region.hpp"
#include "apps/effects/waves/sea.hpp"
#include "apps/effects/waves/waves.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/scales.hpp"
#include "fluid/effects/waves/waves.hpp"
#include "fluid/pfem/spec.hpp"

namespace splashdown::apps {
namespace {

// Chords of 1/200 of a wavelength miss it by 1.2e-4 of its amplitude; in space facets are corners of an exact arithmetic.
template <int d>
constexpr int pieces_a_wave = d == 2 ? 200 : 40;

template <int d>
Eigen::Matrix<int, d - 1, 1> pieces(const Scene& scene, const BoxRegion& box, const fluid::WaveField<d>& sea) {
  const auto& table = *scene.effects.find<Waves>();
  const double chord =
      std::max(sea.shortest() / pieces_a_wave<d> * (table.type == "regular" ? 1 : 4), 0.25 * scene.fluid->size.surface);
  Eigen::Matrix<int, d - 1, 1> out;
  for (int k = 0; k < d - 1; ++k) {
    const double turn = table.direction_deg * radians, along = std::abs(k == 0 ? std::cos(turn) : std::sin(turn));
    constexpr double roundoff = 1e-9;
    const bool varies = table.spreading > 0 || along > roundoff;
    out[k] = varies ? std::max(1, static_cast<int>(std::ceil((box.max[k] - box.min[k]) / chord))) : 1;
  }
  return out;
}

/// What a gauge without bodies would see.
template <int d>
KnownSignal undisturbed(const Scene& scene, const ElevationEntry& gauge, std::shared_ptr<const fluid::WaveField<d>> sea,
                        double ramp_end) {
  const double level = still_water_level<d>(scene).value_or(0);
  fluid::WaveZones<d> growth;
  growth.ramp = ramp_end;
  const Vec<d> at = vec<d>(Point(gauge.x, d == 3 ? gauge.y : 0, 0));
  return {gauge.name + ".undisturbed", [=](double t) { return level + growth.share_at(t) * sea->elevation(at, t); }};
}

template <int d>
std::vector<KnownSignal> signals_of(const Scene& scene) {
  std::vector<KnownSignal> list;
  std::shared_ptr<const fluid::WaveField<d>> sea;
  for (const auto& record : scene.records) {
    const auto* gauge = std::get_if<ElevationEntry>(&record);
    if (!gauge) continue;
    if (!sea) sea = sea_of<d>(scene);
    list.push_back(undisturbed<d>(scene, *gauge, sea, scene.effects.find<Waves>()->ramp));
  }
  return list;
}

}  // namespace

template <int d>
void WavesKind::prepare_in(const Scene& scene, fluid::FluidSpec<d>& spec) const {
  if (scene.effects.find<Waves>()->ramp > 0) return;
  const auto number = static_cast<std::size_t>(wavy_region(scene));
  const auto& box = std::get<BoxRegion>(scene.fluid->regions[number].shape);
  const std::shared_ptr<const fluid::WaveField<d>> sea = sea_of<d>(scene);
  auto& liquid = spec.liquids[number];
  liquid.boundary =
      wavy_box<d>(box, {pieces<d>(scene, box, *sea), [&](const Vec<d>& x) { return sea->elevation(x, 0); }});
  liquid.velocity = [sea](const Vec<d>& x) { return sea->velocity(x, 0); };
}

template <int d>
void WavesKind::build_in(const Scene& scene, const EffectParts<d>& parts) const {
  auto sea = sea_of<d>(scene);
  const auto zones = zones_of<d>(scene, *sea);
  parts.fluid.push_back(std::make_unique<fluid::Waves<d>>(std::move(sea), zones));
}

std::vector<KnownSignal> WavesKind::signals(const Scene& scene) const {
  return scene.dimension == 2 ? signals_of<2>(scene) : signals_of<3>(scene);
}

template void WavesKind::prepare_in<2>(const Scene&, fluid::FluidSpec<2>&) const;
template void WavesKind::prepare_in<3>(const Scene&, fluid::FluidSpec<3>&) const;
template void WavesKind::build_in<2>(const Scene&, const EffectParts<2>&) const;
template void WavesKind::build_in<3>(const Scene&, const EffectParts<3>&) const;

}  // namespace splashdown::apps
