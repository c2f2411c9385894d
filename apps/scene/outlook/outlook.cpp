#include "apps/scene/outlook/outlook.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "apps/scene/geometry.hpp"
#include "apps/scene/outlook/motion_guess.hpp"
#include "core/geometry.hpp"

namespace splashdown::apps {
namespace {

using rigid::Vec;
using std::numbers::pi;

constexpr double flattest = 1 * radians;

double seen_from_above(const Extents<2>& box) { return box.sizes().x(); }
/// Of an ellipse in that box.
double seen_from_above(const Extents<3>& box) { return pi / 4 * box.sizes().x() * box.sizes().y(); }

template <int d>
constexpr double raised = d == 2 ? 1.25 : 1;

/// Share of a straight facet that is below a height: exact for segments and triangles.
double share_below(std::array<double, 2> z, double height) {
  std::ranges::sort(z);
  return height >= z[1] ? 1 : height <= z[0] ? 0 : (height - z[0]) / (z[1] - z[0]);
}
double share_below(std::array<double, 3> z, double height) {
  std::ranges::sort(z);
  if (height >= z[2]) return 1;
  if (height <= z[0]) return 0;
  if (height <= z[1]) return std::pow(height - z[0], 2) / ((z[1] - z[0]) * (z[2] - z[0]));
  return 1 - std::pow(z[2] - height, 2) / ((z[2] - z[1]) * (z[2] - z[0]));
}

/// What of the hull is below a height, seen from below: breadth or area of facets that look down.
template <int d>
double plan_below(const rigid::Surface<d>& hull, double height) {
  double plan = 0;
  for (Eigen::Index f = 0; f < hull.facets.cols(); ++f) {
    std::array<Vec<d>, d> corners;
    std::array<double, d> heights;
    for (int k = 0; k < d; ++k) {
      corners[static_cast<std::size_t>(k)] = hull.vertices.col(hull.facets(k, f));
      heights[static_cast<std::size_t>(k)] = corners[static_cast<std::size_t>(k)][d - 1];
    }
    plan += std::max(0., -area_vector(corners)[d - 1]) * share_below(heights, height);
  }
  return plan;
}

template <int d>
double lowest(const rigid::Surface<d>& hull) {
  return hull.vertices.row(d - 1).minCoeff();
}

/// When the guess has the body at the water first; nothing: not within the run, or more than its bottom is in it from the start.
template <int d>
std::optional<double> contact_time(const Scene& scene, const GuessedBody<d>& guessed, double over, double height) {
  const Body& body = *guessed.body;
  const double tolerance = 1e-6 * height, bottom = 0.05 * height;
  const auto is_there = [&](double t) { return over + guessed_motion<d>(scene, guessed, t)[d - 1] <= tolerance; };
  if (over < -bottom) return {};
  if (is_there(0)) return 0.;
  double late = scene.time.end;
  for (const auto& point : body.path)
    if (point.time < late && is_there(point.time)) late = point.time;
  if (!is_there(late) && !guessed.fall.sunk.empty())
    late = guessed.fall.begins + guessed.fall.arrival;  // and out again
  if (!is_there(late)) return {};
  double early = 0;
  for (int i = 0; i < 60; ++i) (is_there(0.5 * (early + late)) ? late : early) = 0.5 * (early + late);
  return late;
}

/// Downward speed of the guess before a time [m/s].
template <int d>
double sinking(const Scene& scene, const GuessedBody<d>& guessed, double time) {
  const Body& body = *guessed.body;
  const double start = body.path.empty() ? -body.velocity[d - 1] : 0;
  if (body.motion == Motion::free) {
    const double g = scene.gravity ? -scene.gravity->acceleration[d - 1] : 0;
    return start + g * time;
  }
  if (body.path.empty()) return start;
  const double dt = 1e-4 * scene.time.end;
  return (guessed_motion<d>(scene, guessed, time)[d - 1] - guessed_motion<d>(scene, guessed, time + dt)[d - 1]) / dt;
}

/// The highest load of von Karman's over the depths of penetration that are reached in a time.
template <int d>
void find_peak(const rigid::Surface<d>& hull, double mass, double density, double time, Entry& entry) {
  const int steps = 200;
  const auto box = extents<d>(hull);
  const double bottom = box.min()[d - 1], deepest = std::min(box.sizes()[d - 1] / raised<d>, entry.speed * time),
               step = deepest / steps;
  double before = 0, plan_before = 0;
  for (int i = 1; i <= steps; ++i) {
    const double plan = plan_below<d>(hull, bottom + raised<d> * i * step), added = plate_mass<d>(density, plan);
    const double grows = (added - before) / step, share = 1 + 0.5 * (added + before) / mass;
    const double load = entry.speed * entry.speed * grows / (share * share * share);
    const auto half = [](double of) { return d == 2 ? of / 2 : std::sqrt(of / pi); };
    if (load > entry.peak_load) {
      entry.peak_load = load;
      entry.peak_depth = (i - 0.5) * step;
      entry.contact_speed = entry.speed * (half(plan) - half(plan_before)) / step;
      entry.wetted = plan;
    }
    before = added;
    plan_before = plan;
  }
  if (entry.flat()) entry.peak_load = std::numeric_limits<double>::infinity();
}

template <int d>
std::optional<Entry> entry_of(const Scene& scene, std::size_t index, const rigid::Surface<d>& hull, double mass,
                              double level) {
  const auto& body = scene.bodies[index];
  if (body.motion == Motion::fixed) return {};
  const double over = lowest<d>(hull) - level;
  const auto guessed = guessed_body<d>(scene, body);
  const auto time = contact_time<d>(scene, guessed, over, extents<d>(hull).sizes()[d - 1]);
  if (!time) return {};
  Entry entry{.body = index, .time = *time, .speed = sinking<d>(scene, guessed, *time), .deadrise = deadrise<d>(body)};
  entry.start_speed = sinking<d>(scene, guessed, 0);
  entry.height = std::max(0., over);
  if (entry.speed <= 0) return {};
  find_peak<d>(hull, mass, scene.fluid->density, scene.time.end - *time, entry);
  return entry;
}

template <int d>
double mass_of(const Body& body) {
  if (body.motion != Motion::free) return std::numeric_limits<double>::infinity();
  return mass_properties<d>(body).mass;
}

/// The way that a free body under water sinks or rises until the end, without drag: what is left of its weight moves it and the water
/// around it, to the floor or to the surface. Nothing for others [m].
template <int d>
Vec<d> sunk(const Scene& scene, const Body& body, const Extents<d>& box, const Mover& mover, double displaced) {
  const auto level = still_water_level<d>(scene);
  if (body.motion != Motion::free || !scene.gravity || !scene.tank || !level || box.max()[d - 1] > *level)
    return Vec<d>::Zero();
  const double up = (mover.mass - displaced) / (mover.mass + mover.added) * scene.gravity->acceleration[d - 1],
               time = mover.time_in_water;
  const double room = up > 0 ? *level - box.max()[d - 1] : box.min()[d - 1] - scene.tank->min[d - 1];
  return std::copysign(std::min(0.5 * std::abs(up) * time * time, std::max(0., room)), up) * Vec<d>::Unit(d - 1);
}

template <int d>
Mover mover_of(const Scene& scene, std::size_t index, const std::optional<Entry>& entry) {
  const auto& body = scene.bodies[index];
  const auto hull = outline<d>(body);
  const auto box = extents<d>(hull);
  Mover mover{.body = index};
  mover.length = box.sizes().maxCoeff();
  mover.breadth = box.sizes().template head<d - 1>().mean();
  mover.height = box.sizes()[d - 1];
  mover.plan = seen_from_above(box);
  mover.mass = mass_of<d>(body);
  if (scene.fluid) mover.added = plate_mass<d>(scene.fluid->density, mover.plan);
  mover.forward = body.velocity.head(d - 1).norm();
  mover.moves = body.motion != Motion::fixed;
  const double from = entry ? entry->time : 0, end = scene.time.end;
  mover.time_in_water = std::max(0., end - from);
  const auto guessed = guessed_body<d>(scene, body);
  Vec<d> way = guessed_motion<d>(scene, guessed, end) - guessed_motion<d>(scene, guessed, from);
  const double displaced = scene.fluid ? scene.fluid->density * shape_of<d>(body.shape).at_unit_density.mass : 0;
  if (body.velocity.isZero() && body.path.empty() && scene.fluid)
    if (const Vec<d> alone = sunk<d>(scene, body, box, mover, displaced); !alone.isZero(0)) way = alone;
  mover.way = way.norm();
  mover.climb = way[d - 1];
  // Of a side what is under water as long as it floats.
  const double wet = scene.fluid ? std::min(1., mover.mass / displaced) : 1;
  const double side = wet * mover.height * (d == 2 ? 1 : mover.breadth);
  if (mover.way > 0)
    mover.facing = (mover.plan * std::abs(way[d - 1]) + side * way.template head<d - 1>().norm()) / mover.way;
  return mover;
}

double given_wave(const Scene& scene) {
  for (const auto& region : scene.fluid->regions)
    if (const auto* box = std::get_if<BoxRegion>(&region.shape); box && box->surface_amplitude != 0)
      return box->surface_wavelength;
  return 0;
}

}  // namespace

bool Entry::flat() const { return deadrise && *deadrise < flattest; }
bool Outlook::has_load() const { return entry && std::isfinite(entry->peak_load) && entry->peak_load > 0; }

bool Outlook::starts_at_rest() const {
  const auto rests = [](const auto& of) { return of.velocity.isZero(0); };
  const bool bodies = std::ranges::all_of(
      scene.bodies, [&](const Body& body) { return rests(body) && body.spin_deg.isZero(0) && body.path.empty(); });
  return bodies && (!scene.fluid || std::ranges::all_of(scene.fluid->regions, [&](const Region& region) {
           return rests(region) && region.velocity_gradient.isZero(0);
         }));
}

template <int d>
Outlook outlook(const Scene& scene) {
  Outlook look{.scene = scene, .scales = scales<d>(scene), .mover = {}, .entry = {}};
  if (scene.gravity) look.pull = -scene.gravity->acceleration[d - 1];
  const auto level = still_water_level<d>(scene);
  if (level)
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      if (scene.bodies[i].makes_waves) continue;
      const auto entry = entry_of<d>(scene, i, outline<d>(scene.bodies[i]), mass_of<d>(scene.bodies[i]), *level);
      if (entry && (!look.entry || entry->speed > look.entry->speed)) look.entry = entry;
    }
  const auto first = std::ranges::find(scene.bodies, false, &Body::makes_waves);
  if (first != scene.bodies.end())
    look.mover = mover_of<d>(
        scene, look.entry ? look.entry->body : static_cast<std::size_t>(first - scene.bodies.begin()), look.entry);
  if (scene.tank) {
    look.tank_length = scene.tank->max.x() - scene.tank->min.x();
    if (level) look.depth = std::max(0., *level - scene.tank->min[d - 1]);
  }
  if (scene.fluid) look.wave_length = given_wave(scene);
  if (look.wave_length == 0) look.wave_length = 2 * look.scales.length;
  return look;
}

template Outlook outlook<2>(const Scene&);
template Outlook outlook<3>(const Scene&);

}  // namespace splashdown::apps
