#include "apps/effects/wavemaker/flume.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/scene/geometry.hpp"
#include "apps/scene/scales.hpp"
#include "fluid/effects/waves/dispersion.hpp"
#include "fluid/effects/waves/wavemaker.hpp"

namespace splashdown::apps {
namespace {

using std::numbers::pi;

fluid::Paddle paddle_of(const Wavemaker& table) {
  return table.type == "piston" ? fluid::Paddle::piston : fluid::Paddle::flap;
}

/// Of its back, so that it stays a body with a face of its own behind [m].
double paddle_thickness(const Wavemaker& table, const Flume& flume) { return 0.15 * paddle_height(table, flume); }

double ramp_of(const Wavemaker& table) {
  return table.ramp.value_or(2 * (table.significant_height ? table.peak_period : table.period));
}

/// Of the paddle's face at the still level from its place at rest, towards the water [m].
double displacement(const Wavemaker& table, double stroke, double time) {
  const double ramp = ramp_of(table), s = ramp > 0 ? std::min(time / ramp, 1.) : 1, share = s * s * (3 - 2 * s);
  return share * 0.5 * stroke * std::sin(2 * pi * time / table.period);
}

Waypoint waypoint(const Wavemaker& table, const Flume& flume, double time, double x) {
  Waypoint point;
  point.time = time;
  point.position.x() = flume.face;
  if (table.type == "piston")
    point.position.x() += flume.inward * x;
  else
    point.attitude.pitch_deg = -std::atan2(flume.inward * x, flume.depth - table.hinge) / radians;
  return point;
}

std::vector<Waypoint> path_of(const Wavemaker& table, const Flume& flume, double end) {
  constexpr int rows_a_period = 100;    // the velocity of the middle of a row within 2e-4 of its amplitude
  constexpr int rows_of_shortest = 40;  // within 1e-3 for the shortest wave of a sea
  const auto sea = sea_of(table, flume);
  const double dt = sea ? sea->shortest_period() / rows_of_shortest : table.period / rows_a_period;
  const double stroke = forecast(table, flume).stroke;
  const auto rows = static_cast<std::size_t>(std::ceil(end / dt)) + 2;
  std::vector<Waypoint> path;
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = dt * static_cast<double>(i);
    path.push_back(waypoint(table, flume, t, sea ? sea->displacement(t) : displacement(table, stroke, t)));
  }
  return path;
}

/// Of the top of the sill before the paddle [m]: a fiftieth of a wavelength leaves waves within a percent of the theory, and the mesh
/// has to see it.
double ledge_of(const Scene& scene, const Wavemaker& table, const Flume& flume) {
  constexpr double of_a_wave = 0.02, of_an_element = 0.8;
  return std::max(of_a_wave * forecast(table, flume).length(), of_an_element * scene.fluid->size.surface);
}

/// The hull, its reference point on the still face: at its foot in the plane, in space its middle.
Shape hull_of(const Scene& scene, const Wavemaker& table, const Flume& flume) {
  const double high = paddle_height(table, flume), back = -flume.inward * paddle_thickness(table, flume);
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

Body part_of_tank(const Scene& scene, const char* name) {
  Body body;
  body.name = name;
  body.makes_waves = true;
  body.free = freedom_names(scene.dimension);
  body.size = scene.fluid->size.surface;
  return body;
}

/// The wall below the hinge. The paddle stands on its top as on a floor, behind a ledge: at a corner nothing would keep the
/// water from going round.
Body sill(const Scene& scene, const Wavemaker& table, const Flume& flume) {
  Body body = part_of_tank(scene, "sill");
  body.motion = Motion::fixed;
  const double ledge = flume.inward * ledge_of(scene, table, flume),
               back = -flume.inward * paddle_thickness(table, flume);
  PolygonShape polygon;
  polygon.points = {{back, 0, 0}, {ledge, 0, 0}, {ledge, table.hinge, 0}, {back, table.hinge, 0}};
  body.shape = polygon;
  body.position = {flume.face, scene.tank->min.y(), 0};
  return body;
}

}  // namespace

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

double Forecast::length() const { return 2 * pi / wave_number; }

std::shared_ptr<const fluid::PaddleSea> sea_of(const Wavemaker& table, const Flume& flume) {
  if (!table.significant_height) return {};
  const auto waves = fluid::sea_waves({.significant_height = *table.significant_height,
                                       .peak_period = table.peak_period,
                                       .gamma = table.gamma,
                                       .seed = static_cast<std::uint64_t>(table.seed),
                                       .repeat = table.repeat});
  return std::make_shared<fluid::PaddleSea>(waves, fluid::PaddleSpec{.type = paddle_of(table),
                                                                     .hinge = table.hinge,
                                                                     .depth = flume.depth,
                                                                     .gravity = flume.gravity,
                                                                     .ramp = ramp_of(table)});
}

Forecast forecast(const Wavemaker& table, const Flume& flume) {
  Forecast of;
  const double period = table.significant_height ? table.peak_period : table.period;
  of.wave_number = fluid::wave_number(2 * pi / period, flume.depth, flume.gravity);
  const double ratio =
      fluid::height_over_stroke(paddle_of(table), of.wave_number * flume.depth, table.hinge / flume.depth);
  if (table.significant_height) {
    // The highest of the hundred waves that repeat: sqrt(ln(100) / 2) H_s (Longuet-Higgins 1952).
    of.height = *table.significant_height;
    of.highest = 1.5 * of.height;
    of.stroke = of.height / ratio;
    return of;
  }
  of.stroke = table.stroke ? *table.stroke : table.height.value_or(0) / ratio;
  of.height = of.highest = of.stroke * ratio;
  return of;
}

double paddle_height(const Wavemaker& table, const Flume& flume) {
  return flume.depth - table.hinge + share_of_freeboard * flume.free;
}

double room_behind(const Wavemaker& table, const Flume& flume, const std::vector<Waypoint>& path) {
  double back = 0;  // farthest from the water, at its top
  for (const auto& point : path)
    back = std::max(back, table.type == "piston" ? flume.inward * (flume.face - point.position.x())
                                                 : flume.inward * std::tan(point.attitude.pitch_deg * radians) *
                                                       paddle_height(table, flume));
  return back + 1.01 * paddle_thickness(table, flume);
}

std::vector<Body> paddle_and_sill(const Scene& scene, const Wavemaker& table, const Flume& flume) {
  Body body = part_of_tank(scene, "wavemaker");
  body.motion = Motion::prescribed;
  body.shape = hull_of(scene, table, flume);
  body.path = path_of(table, flume, scene.time.end);
  const int up = scene.dimension - 1;
  for (auto& point : body.path) {
    point.position[up] = scene.tank->min[up] + table.hinge;
    if (scene.dimension == 2) continue;
    point.position += Point(-0.5 * flume.inward * paddle_thickness(table, flume),
                            0.5 * (scene.tank->min.y() + scene.tank->max.y()), 0.5 * paddle_height(table, flume));
  }
  body.position = body.path.front().position;
  std::vector<Body> parts{std::move(body)};
  if (table.hinge > 0) parts.push_back(sill(scene, table, flume));
  return parts;
}

}  // namespace splashdown::apps
