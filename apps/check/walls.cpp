#include "apps/check/walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "apps/scene/outlook/motion_guess.hpp"
#include "apps/scene/scales.hpp"
#include "apps/scene/solid.hpp"
#include "apps/scene/tank_sides.hpp"

namespace splashdown::apps {
namespace {

using rigid::Vec;

constexpr int guessed_steps = 400;   // of a run; a body crosses a tank in some of them
constexpr double into_a_wall = 0.1;  // of an element: what a run ends for

/// A body on its guessed way.
template <int d>
class Traveller {
 public:
  Traveller(const Scene& scene, const Body& body)
      : scene_(scene), body_(body), hull_(outline<d>(body)), box_(extents<d>(hull_)) {
    is_tied_ = std::ranges::any_of(scene.joints, [&](const Joint& joint) {
      return &scene.bodies[joint.body] == &body || (joint.other && &scene.bodies[*joint.other] == &body);
    });
    if (body.motion == Motion::prescribed && !body.release) path_ = guessed_body<d>(scene, body);
    if (body.motion != Motion::free) return;
    const auto names = freedom_names(d);
    for (int k = 0; k < d; ++k)
      moves_[k] = std::ranges::find(body.free, names[static_cast<std::size_t>(k)]) != body.free.end() ? 1 : 0;
    const double volume = shape_of<d>(body.shape).at_unit_density.mass;
    mass_ = body.mass ? *body.mass : body.density.value_or(0) * volume;
    if (scene.gravity) gravity_ = vec<d>(scene.gravity->acceleration);
    velocity_ = vec<d>(body.velocity).cwiseProduct(moves_);
    if (!scene.fluid) return;
    level_ = still_water_level<d>(scene);
    displaced_ = scene.fluid->density * volume;
    added_ = 2 * impact_mass(scene.fluid->density, hull_);
  }

  bool is_free() const { return body_.motion == Motion::free && !is_tied_ && !body_.deforms; }  // clamps may hold it
  bool is_tied() const { return is_tied_; }
  const Body& body() const { return body_; }
  const Vec<d>& moved() const { return moved_; }
  Extents<d> box() const { return box_.translated(moved_); }
  Solid<d> solid() const {
    auto hull = hull_;
    hull.vertices.colwise() += moved_;
    return Solid<d>(hull);
  }

  void advance(double time, double dt) {
    if (path_) moved_ = guessed_motion<d>(scene_, *path_, time + dt);
    if (!is_free()) return;
    const double share = wetted_share(), inertia = mass_ + added_ * share;
    if (inertia <= 0) return;
    const Vec<d> force = (mass_ - displaced_ * share) * gravity_;
    velocity_ += dt / inertia * force.cwiseProduct(moves_);
    moved_ += dt * velocity_;
    // What it takes with it when it gets deeper; what it leaves behind keeps its speed.
    if (const double more = added_ * (wetted_share() - share); more > 0) velocity_ *= inertia / (inertia + more);
  }

 private:
  /// Of its height.
  double wetted_share() const {
    if (!level_) return 0;
    const double low = box_.min()[d - 1] + moved_[d - 1], height = box_.sizes()[d - 1];
    return std::clamp((*level_ - low) / height, 0., 1.);
  }

  const Scene& scene_;
  const Body& body_;
  rigid::Surface<d> hull_;
  Extents<d> box_;
  std::optional<GuessedBody<d>> path_;  // of what goes where it is told to
  bool is_tied_ = false;
  double mass_ = 0, displaced_ = 0, added_ = 0;
  std::optional<double> level_;
  Vec<d> gravity_ = Vec<d>::Zero(), velocity_ = Vec<d>::Zero(), moved_ = Vec<d>::Zero(), moves_ = Vec<d>::Zero();
};

/// Of two that were apart at t = 0; ties and what goes where it is told to are nobody's mistake.
template <int d>
bool run_into_each_other(const Traveller<d>& a, const Traveller<d>& b) {
  if (a.is_tied() || b.is_tied() || !(a.is_free() || b.is_free())) return false;
  if (!a.box().intersects(b.box())) return false;
  return overlap<d>(a.solid(), b.solid(), into_a_wall * std::min(a.body().size, b.body().size));
}

}  // namespace

template <int d>
std::optional<WallMeeting> guessed_meeting(const Scene& scene) {
  if (scene.contact) return {};
  std::vector<Traveller<d>> travellers;
  for (const auto& body : scene.bodies) travellers.emplace_back(scene, body);
  const auto sides = tank_sides<d>(scene);
  const double dt = scene.time.end / guessed_steps;
  for (int i = 0; i < guessed_steps; ++i) {
    const double after = (i + 1) * dt;
    for (auto& traveller : travellers) traveller.advance(i * dt, dt);
    for (std::size_t b = 0; b < travellers.size(); ++b) {
      if (!travellers[b].is_free()) continue;
      const auto box = travellers[b].box();
      for (const auto& side : sides)
        if (std::max(side.depth(box.min()), side.depth(box.max())) > into_a_wall * scene.bodies[b].size)
          return WallMeeting{b, side.name, after};
    }
    for (std::size_t b = 0; b < travellers.size(); ++b)
      for (std::size_t a = 0; a < b; ++a)
        if (run_into_each_other(travellers[a], travellers[b]))
          return WallMeeting{a, "body." + scene.bodies[b].name, after};
  }
  return {};
}

template <int d>
std::vector<std::string> questions_about_walls(const Scene& scene) {
  const auto meeting = guessed_meeting<d>(scene);
  if (!meeting) return {};
  const bool is_tank = meeting->wall.starts_with("the tank");
  return {fmt::format(
      "body.{} may reach {} at about t = {:.2g} s, and without [contact] the run ends there: did you mean to add "
      "[contact], {}, or time.end = {:.2g}?",
      scene.bodies[meeting->body].name, meeting->wall, meeting->time,
      is_tank ? "a larger tank" : "to start them farther apart", 0.9 * meeting->time)};
}

template std::optional<WallMeeting> guessed_meeting<2>(const Scene&);
template std::optional<WallMeeting> guessed_meeting<3>(const Scene&);
template std::vector<std::string> questions_about_walls<2>(const Scene&);
template std::vector<std::string> questions_about_walls<3>(const Scene&);

}  // namespace splashdown::apps
