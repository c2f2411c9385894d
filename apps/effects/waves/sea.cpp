#include "apps/effects/waves/sea.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "apps/scene/geometry.hpp"
#include "apps/scene/scales.hpp"
#include "fluid/effects/waves/dispersion.hpp"
#include "fluid/effects/waves/waves.hpp"

namespace splashdown::apps {
namespace {

using fluid::SeaFrame;
using fluid::WaveField;
using rigid::Vec;
using std::numbers::pi;

/// A sea wherever its origin is.
template <int d>
using Laid = std::function<std::unique_ptr<WaveField<d>>(const SeaFrame<d>&)>;

fluid::SpectrumSpec spectrum_of(const Waves& table) {
  return {.significant_height = table.significant_height,
          .peak_period = table.peak_period,
          .gamma = table.gamma,
          .spreading = table.spreading,
          .seed = static_cast<std::uint64_t>(table.seed),
          .repeat = table.repeat};
}

// The same wave, seen from the water that the current carries.
fluid::SteadyWave steady_wave(const Waves& table, double depth, double gravity) {
  const auto solve = table.theory == "linear" ? fluid::airy_wave : fluid::stream_function_wave;
  fluid::SteadyWaveSpec spec{.height = table.height,
                             .period = table.period.value_or(0),
                             .length = table.length.value_or(0),
                             .depth = depth,
                             .gravity = gravity,
                             .transport = table.current};
  if (spec.period > 0 && table.current != 0) {
    spec.length = solve(spec).length();
    spec.period = 0;
  }
  spec.transport = 0;
  return solve(spec);
}

template <int d>
Laid<d> laid(const Waves& table, double depth, double gravity) {
  if (table.type == "regular")
    return [wave = steady_wave(table, depth, gravity)](const SeaFrame<d>& frame) {
      return std::make_unique<fluid::RegularWave<d>>(wave, frame);
    };
  const bool focused = table.type == "focused";
  // The highest of the hundred waves that repeat: sqrt(ln(100) / 2) H_s (Longuet-Higgins 1952).
  const double highest = focused ? table.crest : 1.5 * table.significant_height;
  const auto waves =
      focused ? fluid::focused_waves(spectrum_of(table), table.crest) : fluid::sea_waves(spectrum_of(table));
  return [=, &table](const SeaFrame<d>& frame) {
    return std::make_unique<fluid::LinearSea<d>>(waves, frame, table.peak_period, table.current, highest);
  };
}

template <int d>
SeaFrame<d> frame_of(const Scene& scene, const Waves& table) {
  SeaFrame<d> frame;
  frame.origin = vec<d>(0.5 * (scene.tank->min + scene.tank->max));
  if (table.type == "focused") frame.origin = vec<d>(table.focus), frame.time = table.focus_time;
  frame.origin[d - 1] = still_water_level<d>(scene).value_or(0);
  frame.direction = Vec<d>::Zero();
  frame.direction[0] = std::cos(table.direction_deg * radians);
  if (d == 3) frame.direction[1] = std::sin(table.direction_deg * radians);
  frame.depth = frame.level() - scene.tank->min[d - 1];
  frame.gravity = scene.gravity->acceleration.norm();
  return frame;
}

// Moves the sea until the body touches it at the phase that is wanted: each time it comes a little earlier or later.
template <int d>
SeaFrame<d> met(const Scene& scene, const Waves& table, const Laid<d>& laid, SeaFrame<d> frame) {
  constexpr int most = 30;
  constexpr double close = 1e-3;  // of a wavelength
  const auto& body = scene.bodies[table.touchdown->body];
  const double wanted = table.touchdown->phase_deg / 360;
  double best = 1;
  SeaFrame<d> found = frame;
  for (int pass = 0; pass < most && best > close; ++pass) {
    const auto sea = laid(frame);
    const auto contact = first_contact<d>(scene, body, *sea, frame.level(), scene.time.end);
    if (!contact) break;
    const double turns = sea->phase(contact->place, contact->time) / (2 * pi) - wanted;
    const double off = std::abs(turns - std::round(turns));
    if (off < best) best = off, found = frame;
    frame.origin.template head<d - 1>() = contact->place.template head<d - 1>();
    frame.time = contact->time - wanted * sea->period();
  }
  constexpr double enough = 0.02;
  if (best > enough)
    throw std::invalid_argument(
        best == 1 ? fmt::format("'{}' does not touch the water between t = 0 and time.end = {:g} s", body.name,
                                scene.time.end)
                  : fmt::format("'{}' is too wide for this wave: no phase lets it touch the water first where it shall",
                                body.name));
  return found;
}

}  // namespace

int wavy_region(const Scene& scene) {
  if (!scene.fluid || !scene.tank) return -1;
  const int d = scene.dimension;
  constexpr double roundoff = 1e-9;
  for (std::size_t i = 0; i < scene.fluid->regions.size(); ++i) {
    const auto* box = std::get_if<BoxRegion>(&scene.fluid->regions[i].shape);
    if (!box || box->surface_amplitude != 0) continue;
    const double slack = roundoff * (scene.tank->max - scene.tank->min).norm();
    const bool from_wall = ((box->min - scene.tank->min).head(d).array() <= slack).all();
    const bool to_wall = ((scene.tank->max - box->max).head(d - 1).array() <= slack).all();
    if (from_wall && to_wall) return static_cast<int>(i);
  }
  return -1;
}

template <int d>
std::unique_ptr<WaveField<d>> sea_of(const Scene& scene) {
  const auto& table = *scene.effects.find<Waves>();
  auto frame = frame_of<d>(scene, table);
  const auto sea = laid<d>(table, frame.depth, frame.gravity);
  if (table.type == "regular") frame.time = -table.phase_deg / 360 * sea(frame)->period();
  if (table.touchdown) frame = met<d>(scene, table, sea, frame);
  return sea(frame);
}

template <int d>
fluid::WaveZones<d> zones_of(const Scene& scene, const WaveField<d>& sea) {
  constexpr double wavelengths = 1.5, passages = 36;  // measured: docs/waves.md
  const auto& table = *scene.effects.find<Waves>();
  fluid::WaveZones<d> zones{.min = vec<d>(scene.tank->min), .max = vec<d>(scene.tank->max)};
  const double width = table.zone.value_or(wavelengths * sea.length());
  const double along[] = {std::abs(std::cos(table.direction_deg * radians)),
                          std::abs(std::sin(table.direction_deg * radians))};
  for (int k = 0; k < d - 1; ++k) {
    constexpr double oblique = 0.1;
    const bool runs = along[k] > oblique || table.spreading > 0;
    zones.width[k] = runs ? width : table.side_zone.value_or(0);
  }
  const auto frame = frame_of<d>(scene, table);
  const double speed = fluid::group_velocity(2 * pi / sea.length(), frame.depth, frame.gravity);
  zones.rate = table.rate.value_or(passages * speed / sea.length());
  zones.ramp = table.ramp;
  return zones;
}

template std::unique_ptr<WaveField<2>> sea_of<2>(const Scene&);
template std::unique_ptr<WaveField<3>> sea_of<3>(const Scene&);
template fluid::WaveZones<2> zones_of<2>(const Scene&, const WaveField<2>&);
template fluid::WaveZones<3> zones_of<3>(const Scene&, const WaveField<3>&);

}  // namespace splashdown::apps
