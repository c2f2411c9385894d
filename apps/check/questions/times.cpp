// How long the run lasts, beside what happens in it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/check/questions/prepared_scene.hpp"
#include "apps/scene/outlook/motion_guess.hpp"
#include "apps/scene/scales.hpp"
#include "apps/text/number_text.hpp"

namespace splashdown::apps {
namespace {

/// Lowest point of a hull over still water where the guess has it at that time [m].
template <int d>
double guessed_height(const PreparedScene<d>& prepared, const PreparedBody<d>& of, double time) {
  double lowest = of.box.min()[d - 1] + guessed_motion<d>(prepared.scene, *of.body, time)[d - 1];
  for (const auto& point : of.body->path)
    if (point.time <= time) {
      Body there = *of.body;
      there.position = point.position;
      there.attitude = point.attitude;
      lowest = std::min(lowest, extents<d>(outline<d>(there)).min()[d - 1]);
    }
  return lowest - *prepared.level;
}

/// Nothing is wet at any time.
template <int d>
void about_end_before_contact(const PreparedScene<d>& prepared, Questions& list) {
  const double end = prepared.scene.time.end;
  if (!prepared.level || prepared.bodies.empty()) return;
  double nearest = INFINITY;
  const PreparedBody<d>* first = nullptr;
  for (const auto& of : prepared.bodies) {
    const double at_end = guessed_height<d>(prepared, of, end), tolerance = 1e-9 * of.box.sizes().maxCoeff();
    if (of.wet > 0 || at_end <= tolerance) return;
    if (of.body->motion != Motion::fixed && at_end < nearest) nearest = at_end, first = &of;
  }
  if (!first || first->body->velocity[d - 1] > 0) return;  // upward: another question
  double later = end;                                      // when it does
  for (int i = 0; i < 40 && guessed_height<d>(prepared, *first, later) > 0; ++i) later *= 1.25;
  list.push_back(
      fmt::format("time.end = {:g} s: body.{} is {} above the water then, and nothing is wetted: did you mean {}?", end,
                  first->body->name, with_unit(nearest, "m"),
                  guessed_height<d>(prepared, *first, later) <= 0
                      ? fmt::format("{:.2g} s or more, or a lower position", 1.5 * later)
                      : "a velocity downward, or [gravity]"));
}

/// An impact of a flat bottom and a release under water are over in one step: their loads are impulses, or those of t = 0.
template <int d>
bool is_sudden(const PreparedScene<d>& prepared, const PreparedBody<d>& of) {
  constexpr double flat = 1 * radians, all = 0.999;
  const auto angle = deadrise<d>(*of.body);
  return of.wet > all || (angle && *angle < flat && of.box.min()[d - 1] <= *prepared.level);
}

/// Nothing has moved by a tenth of an element.
template <int d>
void about_end_at_once(const PreparedScene<d>& prepared, Questions& list) {
  const double share = 0.1;
  if (!prepared.scene.fluid) return;
  double element = prepared.scene.fluid->size.surface;
  for (const auto& of : prepared.bodies) {
    if (is_sudden<d>(prepared, of)) return;
    element = std::min(element, of.body->size);
  }
  const auto s = scales<d>(prepared.scene);
  const double end = prepared.scene.time.end;
  if (s.speed == 0 || s.speed * end >= share * element) return;
  list.push_back(
      fmt::format("time.end = {:g} s: by then nothing has moved by a tenth of an element ({}): did you mean {:g} s?",
                  end, with_unit(element, "m"), end * 1000));
}

/// Where all begins at rest in the surface, a fiftieth of a swing shows nothing.
template <int d>
void about_end_before_motion(const PreparedScene<d>& prepared, Questions& list) {
  const double share = 0.02;
  if (!prepared.scene.fluid || prepared.pull <= 0) return;
  const auto is_still = [&](const PreparedBody<d>& of) {
    return of.body->velocity.isZero(0) && of.body->path.empty() && of.wet > 0 && !is_sudden<d>(prepared, of);
  };
  if (!std::ranges::all_of(prepared.bodies, is_still)) return;
  const double period = 2 * std::numbers::pi * std::sqrt(scales<d>(prepared.scene).length / prepared.pull);
  const double end = prepared.scene.time.end;
  if (end >= share * period) return;
  list.push_back(
      fmt::format("time.end = {:g} s: all begins at rest, and a swing of its size takes {}: did you mean {:g} s?", end,
                  with_unit(period, "s"), end * 1000));
}

/// How far a body goes through a fluid between sides at most [m]: free ones without drag, by their weight, buoyancy and added mass, and
/// no farther than the box is long.
template <int d>
double way_between_sides(const Scene& scene, const PreparedBody<d>& of) {
  constexpr int instants = 100;
  const Body& body = *of.body;
  const double end = scene.time.end;
  double way = 0;
  if (body.motion == Motion::prescribed) {
    const auto guess = guessed_body<d>(scene, body);
    for (int k = 1; k <= instants; ++k) way = std::max(way, guessed_motion<d>(scene, guess, end * k / instants).norm());
  } else if (body.motion == Motion::free && (body.mass || body.density)) {
    const double mass = mass_properties<d>(body).mass, pushed = scene.ale->density * of.uniform.mass;
    const double pull = scene.gravity ? scene.gravity->acceleration.norm() : 0;
    way = vec<d>(body.velocity).norm() * end + 0.5 * pull * std::abs(mass - pushed) / (mass + pushed) * end * end;
  }
  return std::min(way, (scene.ale->max - scene.ale->min).template head<2>().norm());
}

/// A mesh that keeps its cells bears some of a body's own size and a radian or so.
template <int d>
void about_way_on_one_mesh(const PreparedScene<d>& prepared, Questions& list) {
  constexpr double most_lengths = 1, most_turn = 60;  // [deg]
  const auto& scene = prepared.scene;
  if (!scene.ale || scene.ale->remesh != "never") return;
  for (const auto& of : prepared.bodies) {
    if (of.body->deforms) continue;
    const double lengths = way_between_sides<d>(scene, of) / of.box.sizes().maxCoeff();
    const double turn = of.body->motion == Motion::fixed ? 0 : of.body->spin_deg.norm() * scene.time.end;
    if (lengths <= most_lengths && turn <= most_turn) continue;
    list.push_back(fmt::format(
        "fluid.ale.remesh = \"never\": body.{} {}, and the cells around it fold: did you mean \"automatic\"?",
        of.body->name,
        lengths > most_lengths ? fmt::format("goes up to {:.2g} of its lengths", lengths)
                               : fmt::format("turns by {:.3g} deg", turn)));
  }
}

template <int d>
constexpr Question<d> questions_of_times[] = {about_end_before_contact<d>, about_end_at_once<d>,
                                              about_end_before_motion<d>, about_way_on_one_mesh<d>};

}  // namespace

template <int d>
void ask_about_times(const PreparedScene<d>& prepared, Questions& list) {
  for (const auto question : questions_of_times<d>) question(prepared, list);
}

template void ask_about_times<2>(const PreparedScene<2>&, Questions&);
template void ask_about_times<3>(const PreparedScene<3>&, Questions&);

}  // namespace splashdown::apps
