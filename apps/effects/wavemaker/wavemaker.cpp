#include "apps/effects/wavemaker/wavemaker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/effects/absorber/absorber.hpp"
#include "apps/effects/waves/waves.hpp"
#include "apps/scene/geometry.hpp"
#include "apps/scene/read/reader.hpp"
#include "apps/scene/scales.hpp"
#include "fluid/effects/waves/dispersion.hpp"
#include "fluid/effects/waves/wavemaker.hpp"

namespace splashdown::apps {
namespace {

using std::numbers::pi;

fluid::Paddle paddle_of(const Wavemaker& table) {
  return table.type == "piston" ? fluid::Paddle::piston : fluid::Paddle::flap;
}

/// The water that the paddle moves: a box from the paddle's face at rest to the tank's other end.
struct Flume {
  double face = 0;     ///< of the paddle at rest, along x [m]
  double inward = 1;   ///< 1: the water is at larger x; -1: at smaller
  double behind = 0;   ///< dry length of the tank [m]
  double depth = 0;    ///< [m]
  double free = 0;     ///< height of the tank above the still level [m]
  double gravity = 0;  ///< [m/s^2]
};

/// Nothing where the scene has no such box, or no gravity straight down.
std::optional<Flume> flume_of(const Scene& scene, const Wavemaker& table) {
  const auto gravity = straight_pull(scene);
  if (!scene.fluid || !scene.tank || !gravity) return {};
  const int up = scene.dimension - 1;
  constexpr double roundoff = 1e-9;
  const auto& tank = *scene.tank;
  const double slack = roundoff * (tank.max - tank.min).norm();
  for (const auto& region : scene.fluid->regions) {
    const auto* box = std::get_if<BoxRegion>(&region.shape);
    if (!box || box->surface_amplitude != 0 || !region.velocity.isZero(0)) continue;
    const auto reaches_floor = box->min[up] <= tank.min[up] + slack;
    bool across = true;
    for (int k = 1; k < up; ++k)
      across = across && box->min[k] <= tank.min[k] + slack && box->max[k] >= tank.max[k] - slack;
    const bool at_lower = table.end == "lower";
    const bool to_end = at_lower ? box->max.x() >= tank.max.x() - slack : box->min.x() <= tank.min.x() + slack;
    if (!reaches_floor || !across || !to_end) continue;
    Flume flume;
    flume.face = at_lower ? box->min.x() : box->max.x();
    flume.inward = at_lower ? 1 : -1;
    flume.behind = at_lower ? flume.face - tank.min.x() : tank.max.x() - flume.face;
    flume.depth = box->max[up] - tank.min[up];
    flume.free = tank.max[up] - box->max[up];
    flume.gravity = *gravity;
    if (flume.depth > 0) return flume;
  }
  return {};
}

/// What the theory says of the table's waves.
struct Forecast {
  double wave_number = 0;  ///< [1/m]
  double height = 0;       ///< far away [m]
  double stroke = 0;       ///< at the still level, from end to end [m]
  double length() const { return 2 * pi / wave_number; }
};

Forecast forecast(const Wavemaker& table, const Flume& flume) {
  Forecast of;
  of.wave_number = fluid::wave_number(2 * pi / table.period, flume.depth, flume.gravity);
  const double ratio = fluid::height_over_stroke(paddle_of(table), of.wave_number * flume.depth);
  of.stroke = table.stroke ? *table.stroke : table.height.value_or(0) / ratio;
  of.height = of.stroke * ratio;
  return of;
}

constexpr double share_of_freeboard = 0.9;  // that the paddle fills

/// Of the paddle from the floor up [m].
double paddle_height(const Flume& flume) { return flume.depth + share_of_freeboard * flume.free; }

/// Of its back, so that it stays a body with a face of its own behind [m].
double paddle_thickness(const Flume& flume) { return 0.15 * paddle_height(flume); }

/// Dry tank that the paddle needs behind its face [m].
double room_behind(const Wavemaker& table, const Flume& flume) {
  const double at_top = table.type == "flap" ? paddle_height(flume) / flume.depth : 1;
  return 0.5 * forecast(table, flume).stroke * at_top + 1.01 * paddle_thickness(flume);
}

double ramp_of(const Wavemaker& table) { return table.ramp.value_or(2 * table.period); }

/// Of the paddle's face at the still level from its place at rest, towards the water [m].
double displacement(const Wavemaker& table, double stroke, double time) {
  const double ramp = ramp_of(table), s = ramp > 0 ? std::min(time / ramp, 1.) : 1, share = s * s * (3 - 2 * s);
  return share * 0.5 * stroke * std::sin(2 * pi * time / table.period);
}

std::vector<Waypoint> path_of(const Wavemaker& table, const Flume& flume, double stroke, double end) {
  constexpr int rows_a_period = 100;  // the velocity of the middle of a row within 2e-4 of its amplitude
  std::vector<Waypoint> path;
  const double dt = table.period / rows_a_period;
  const auto rows = static_cast<std::size_t>(std::ceil(end / dt)) + 2;
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = dt * static_cast<double>(i), x = displacement(table, stroke, t);
    Waypoint point;
    point.time = t;
    point.position.x() = flume.face;
    if (table.type == "piston")
      point.position.x() += flume.inward * x;
    else
      point.attitude.pitch_deg = -std::atan2(flume.inward * x, flume.depth) / radians;
    path.push_back(point);
  }
  return path;
}

/// The hull, its reference point on the still face: on the floor in the plane, in space its middle.
Shape hull_of(const Scene& scene, const Wavemaker& table, const Flume& flume) {
  const double high = paddle_height(flume), back = -flume.inward * paddle_thickness(flume);
  if (scene.dimension == 3) {
    BoxShape box;
    box.size = {std::abs(back), scene.tank->max.y() - scene.tank->min.y(), high};
    return box;
  }
  PolygonShape polygon;
  if (table.type == "piston")
    polygon.points = {{0, 0, 0}, {0, high, 0}, {back, high, 0}, {back, 0, 0}};
  else
    polygon.points = {{0, 0, 0}, {0, high, 0}, {back, high, 0}};
  return polygon;
}

Body paddle(const Scene& scene, const Wavemaker& table, const Flume& flume) {
  Body body;
  body.name = "wavemaker";
  body.makes_waves = true;
  body.motion = Motion::prescribed;
  body.free = freedom_names(scene.dimension);
  body.shape = hull_of(scene, table, flume);
  body.size = scene.fluid->size.surface;
  body.path = path_of(table, flume, forecast(table, flume).stroke, scene.time.end);
  const int up = scene.dimension - 1;
  for (auto& point : body.path) {
    point.position[up] = scene.tank->min[up];
    if (scene.dimension == 2) continue;
    point.position += Point(-0.5 * flume.inward * paddle_thickness(flume),
                            0.5 * (scene.tank->min.y() + scene.tank->max.y()), 0.5 * paddle_height(flume));
  }
  body.position = body.path.front().position;
  return body;
}

/// The absorber's zone stands where the paddle does.
bool is_damped(const Absorber& zone, const Wavemaker& table) { return zone.ends == "both" || zone.ends == table.end; }

}  // namespace

void WavemakerKind::read(Reader& reader, Scene& scene) const {
  auto& table = scene.effects.table<Wavemaker>();
  using Names = std::vector<std::string>;
  const bool known = reader.choice("type", table.type, scene.dimension == 2 ? Names{"piston", "flap"} : Names{"piston"},
                                   Need::required);
  reader.choice("end", table.end, {"lower", "upper"});
  reader.number("period", table.period, positive("s", "Use the time from crest to crest."), Need::required);
  reader.number("height", table.height, positive("m", "Use that of a crest above a trough, or give the stroke."));
  reader.number("stroke", table.stroke,
                positive("m", "Use the paddle's way at the still level from end to end, or give the height."));
  reader.number("ramp", table.ramp, not_negative("s", "Use two periods."));
  auto& problems = reader.context().problems;
  if (table.height.has_value() == table.stroke.has_value())
    problems.add(reader.key(table.stroke ? "stroke" : "height"), "the waves have a height, or the paddle has a stroke",
                 table.stroke ? "Remove one of them." : "Give one of them.");
  if (!known || problems.found_in(reader.path()) || !(scene.time.end > 0)) return;
  if (const auto flume = flume_of(scene, table)) scene.bodies.push_back(paddle(scene, table, *flume));
}

void WavemakerKind::check(const Scene& scene, Problems& problems) const {
  const auto* table = scene.effects.find<Wavemaker>();
  if (!table) return;
  for (const char* key : {"wavemaker", "tank", "fluid", "gravity", "time"})
    if (problems.found_in(key)) return;
  if (scene.effects.find<Waves>())
    return problems.add("wavemaker", "the sea of [waves] is there without it", "Remove one of the two tables.");
  const auto flume = flume_of(scene, *table);
  if (!flume)
    return problems.add("wavemaker",
                        fmt::format("needs [gravity] straight down and a fluid.region of shape box, at rest with a "
                                    "flat top, from the tank's floor up "
                                    "and from the paddle to the tank's {} end{}",
                                    table->end == "lower" ? "upper" : "lower",
                                    scene.dimension == 3 ? ", over the tank's whole breadth" : ""),
                        "The region begins at the face of the paddle; behind it the tank is dry.");
  const auto of = forecast(*table, *flume);
  const double room = room_behind(*table, *flume), limit = fluid::breaking_height(of.length(), flume->depth);
  const char* given = table->stroke ? "wavemaker.stroke" : "wavemaker.height";
  if (of.height >= limit)
    problems.add(given,
                 fmt::format("waves of {:.3g} m, {:.3g} m long on {:.3g} m of water, break: they end at {:.3g} m",
                             of.height, of.length(), flume->depth, limit),
                 fmt::format("Use at most {:.2g} m{}.", 0.8 * limit * (table->stroke ? of.stroke / of.height : 1),
                             table->stroke ? "" : ", or a longer period"));
  else if (flume->free * share_of_freeboard < of.height)
    problems.add("tank.max",
                 fmt::format("the tank ends {:.3g} m above the still level: waves of {:.3g} m run over the paddle",
                             flume->free, of.height),
                 fmt::format("Let it reach {:.3g} m above.", 2 * of.height));
  if (flume->behind < room)
    problems.add(
        table->end == "lower" ? "tank.min" : "tank.max",
        fmt::format("the paddle needs {:.3g} m of dry tank behind its face at x = {:.4g} m, there are {:.3g} m", room,
                    flume->face, flume->behind),
        fmt::format("Let the tank {} at x = {:.4g}; the region stays where it is.",
                    table->end == "lower" ? "begin" : "end", flume->face - flume->inward * 1.1 * room));
  if (const auto* zone = scene.effects.find<Absorber>(); zone && is_damped(*zone, *table))
    problems.add("fluid.absorber.ends", fmt::format("its zone at the {} end damps what the paddle makes", table->end),
                 fmt::format("Use ends = \"{}\".", table->end == "lower" ? "upper" : "lower"));
}

void WavemakerKind::ask(const AskedScene& asked, std::vector<std::string>& questions) const {
  const auto* table = asked.scene.effects.find<Wavemaker>();
  const auto flume = table ? flume_of(asked.scene, *table) : std::nullopt;
  if (!flume) return;
  constexpr double shallow = 0.3, steep = 0.05;
  const auto of = forecast(*table, *flume);
  const double kd = of.wave_number * flume->depth;
  if (kd < shallow && of.height > steep * flume->depth)
    questions.push_back(
        fmt::format("wavemaker.period = {:g} s: waves of {:.3g} m, {:.3g} m long on {:.3g} m of water, change their "
                    "form as they run (kd = {:.2g}): "
                    "did you mean a shorter period?",
                    table->period, of.height, of.length(), flume->depth, kd));
}

std::optional<EffectNote> WavemakerKind::note(const Scene& scene, const Scales&) const {
  const auto* table = scene.effects.find<Wavemaker>();
  const auto flume = table ? flume_of(scene, *table) : std::nullopt;
  if (!flume) return {};
  const auto of = forecast(*table, *flume);
  const double speed = fluid::group_velocity(of.wave_number, flume->depth, flume->gravity);
  const double length = scene.tank->max.x() - scene.tank->min.x() - flume->behind;
  auto words = fmt::format(
      "{}, stroke {:.3g} m: waves of {:.3g} m, {:.4g} m long, H/L = {:.3g}, kd = {:.3g}, {:.2g} elements a wave; they "
      "reach the other end "
      "in {:.3g} s",
      table->type, of.stroke, of.height, of.length(), of.height / of.length(), of.wave_number * flume->depth,
      of.length() / scene.fluid->size.surface, length / speed);
  if (!scene.effects.find<Absorber>() && scene.time.end > length / speed)
    words += ", and come back: [fluid.absorber] lets them out";
  return EffectNote{"wavemaker", true, std::move(words)};
}

std::optional<WantedSize> WavemakerKind::surface_size(const Scene& scene) const {
  constexpr double a_wave = 40;  // heights within 2 %: docs/waves.md
  const auto* table = scene.effects.find<Wavemaker>();
  const auto flume = table ? flume_of(scene, *table) : std::nullopt;
  if (!flume) return {};
  const double length = forecast(*table, *flume).length();
  return WantedSize{length / a_wave, fmt::format("{:g} elements on waves of {:.3g} m", a_wave, length)};
}

}  // namespace splashdown::apps
