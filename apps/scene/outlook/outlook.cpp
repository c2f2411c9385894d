#include "apps/scene/outlook/outlook.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "apps/scene/geometry.hpp"
#include "apps/scene/outlook/motion_guess.hpp"

namespace splashdown::apps {
namespace {

using rigid::Vec;
using std::numbers::pi;

constexpr double flattest = 1 * radians;

double seen_from_above(const Extents<2>& box) { return box.sizes().x(); }
/// Of an ellipse in that box.
double seen_from_above(const Extents<3>& box) { return pi / 4 * box.sizes().x() * box.sizes().y(); }

/// Mass of water on a flat plate of this breadth or area: half of what moves with it in the whole space.
template <int d>
double plate_mass(double density, double plan) {
  if constexpr (d == 2) return density * pi / 8 * plan * plan;
  return density * 4. / 3 * std::pow(plan / pi, 1.5);
}

template <int d>
constexpr double raised = d == 2 ? 1.25 : 1;

/// What of the hull is below a height, seen from above: breadth or area.
template <int d>
double plan_below(const rigid::Surface<d>& hull, double height) {
  Extents<d> below;
  for (Eigen::Index f = 0; f < hull.facets.cols(); ++f)
    for (int k = 0; k < d; ++k) {
      const Vec<d> a = hull.vertices.col(hull.facets(k, f)), b = hull.vertices.col(hull.facets((k + 1) % d, f));
      if (a[d - 1] <= height) below.extend(a);
      if ((a[d - 1] <= height) != (b[d - 1] <= height))
        below.extend(Vec<d>(a + (height - a[d - 1]) / (b[d - 1] - a[d - 1]) * (b - a)));
    }
  return below.isEmpty() ? 0 : seen_from_above(below);
}

template <int d>
double lowest(const rigid::Surface<d>& hull) {
  return hull.vertices.row(d - 1).minCoeff();
}

/// When the guess has the body at the water first; nothing: not within the run, or it is in it from the start.
template <int d>
std::optional<double> contact_time(const Scene& scene, const Body& body, double over) {
  const double tolerance = 1e-9 * std::max(1., std::abs(over));
  const auto is_there = [&](double t) { return over + guessed_motion<d>(scene, body, t)[d - 1] <= tolerance; };
  if (over < -tolerance) return {};
  if (is_there(0)) return 0.;
  double late = scene.time.end;
  for (const auto& point : body.path)
    if (point.time < late && is_there(point.time)) late = point.time;
  if (!is_there(late)) return {};
  double early = 0;
  for (int i = 0; i < 60; ++i) (is_there(0.5 * (early + late)) ? late : early) = 0.5 * (early + late);
  return late;
}

/// Downward speed of the guess before a time [m/s].
template <int d>
double sinking(const Scene& scene, const Body& body, double time) {
  const double start = body.path.empty() ? -body.velocity[d - 1] : 0;
  if (body.motion == Motion::free) {
    const double g = scene.gravity ? -scene.gravity->acceleration[d - 1] : 0;
    return start + g * time;
  }
  if (body.path.empty()) return start;
  const double dt = 1e-4 * scene.time.end;
  return (guessed_motion<d>(scene, body, time)[d - 1] - guessed_motion<d>(scene, body, time + dt)[d - 1]) / dt;
}

/// The highest load of von Karman's over the depths of penetration.
template <int d>
void find_peak(const rigid::Surface<d>& hull, double mass, double density, Entry& entry) {
  const int steps = 200;
  const auto box = extents<d>(hull);
  const double bottom = box.min()[d - 1], deepest = box.sizes()[d - 1] / raised<d>, step = deepest / steps;
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
  const auto time = contact_time<d>(scene, body, over);
  if (!time) return {};
  Entry entry{.body = index, .time = *time, .speed = sinking<d>(scene, body, *time), .deadrise = deadrise<d>(body)};
  entry.start_speed = sinking<d>(scene, body, 0);
  entry.height = std::max(0., over);
  if (entry.speed <= 0) return {};
  find_peak<d>(hull, mass, scene.fluid->density, entry);
  return entry;
}

template <int d>
double mass_of(const Body& body) {
  if (body.motion != Motion::free) return std::numeric_limits<double>::infinity();
  return mass_properties<d>(body).mass;
}

template <int d>
Mover mover_of(const Scene& scene, std::size_t index, const std::optional<Entry>& entry) {
  const auto& body = scene.bodies[index];
  const auto hull = outline<d>(body);
  const auto box = extents<d>(hull);
  Mover mover;
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
  mover.way = (guessed_motion<d>(scene, body, end) - guessed_motion<d>(scene, body, from)).norm();
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

template <int d>
Outlook outlook(const Scene& scene) {
  Outlook look{.scene = scene, .scales = scales<d>(scene), .mover = {}, .entry = {}};
  if (scene.gravity) look.pull = -scene.gravity->acceleration[d - 1];
  const auto level = still_water_level<d>(scene);
  if (level)
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const auto entry = entry_of<d>(scene, i, outline<d>(scene.bodies[i]), mass_of<d>(scene.bodies[i]), *level);
      if (entry && (!look.entry || entry->speed > look.entry->speed)) look.entry = entry;
    }
  if (!scene.bodies.empty()) look.mover = mover_of<d>(scene, look.entry ? look.entry->body : 0, look.entry);
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
