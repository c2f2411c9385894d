#include "apps/simulation/wall_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/scene/kinds/joint_kinds.hpp"

namespace splashdown::apps {
namespace {

using rigid::Isometry;
using rigid::Surface;
using rigid::Vec;

constexpr double of_element = 0.1;
constexpr double of_extent = 1e-6;  // where there is no mesh: roundoff of long motions

template <int d>
Surface<d> placed(Surface<d> hull, const Isometry<d>& pose) {
  hull.vertices = pose * hull.vertices;
  return hull;
}

bool turns_about_the_world(const Scene& scene, const Joint& joint) {
  return kind_of(joint).turns && (!joint.other || scene.bodies[*joint.other].motion != Motion::free);
}

/// The place on a hinge's axis that a point turns about.
template <int d>
Vec<d> foot_on_axis(const Joint& joint, const Vec<d>& x) {
  const Vec<d> at = vec<d>(joint.point);
  if constexpr (d == 2) return at;
  const Vec<d> axis = vec<d>(joint.axis).normalized();
  return at + axis * axis.dot(x - at);
}

std::string named(const Body& body) { return "body." + body.name; }

}  // namespace

template <int d>
WallWatch<d>::WallWatch(const Scene& scene, const rigid::Bodies<d>& bodies) : scene_(scene) {
  if (scene.contact) return;
  sides_ = tank_sides<d>(scene);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto& spec = bodies.spec(b);
    Watched watched{.hull = spec.surface, .is_free = spec.becomes_free(), .allowed = {}};
    watched.reach = spec.surface.vertices.colwise().norm().maxCoeff();
    watched.tolerance = scene.fluid ? of_element * scene.bodies[b].size : of_extent * watched.reach;
    watched.allowed.assign(sides_.size(), watched.tolerance);
    watched_.push_back(std::move(watched));
  }
  for (const auto& joint : scene.joints)
    if (turns_about_the_world(scene, joint)) allow_feet(joint.body, joint, bodies.state(joint.body).pose);
  for (std::size_t a = 0; a < watched_.size(); ++a)
    for (std::size_t b = a + 1; b < watched_.size(); ++b)
      if (watched_[a].is_free || watched_[b].is_free) pairs_.emplace_back(a, b);
  let_pass(bodies);
}

// What touches a side and turns about an axis h above it on a radius r comes as far as r - h beyond it.
template <int d>
void WallWatch<d>::allow_feet(std::size_t body, const Joint& joint, const Isometry<d>& pose) {
  auto& watched = watched_[body];
  for (Eigen::Index v = 0; v < watched.hull.vertices.cols(); ++v) {
    const Vec<d> x = pose * Vec<d>(watched.hull.vertices.col(v)), foot = foot_on_axis<d>(joint, x);
    for (std::size_t s = 0; s < sides_.size(); ++s)
      if (sides_[s].depth(x) > -watched.tolerance)
        watched.allowed[s] =
            std::max(watched.allowed[s], (x - foot).norm() + sides_[s].depth(foot) + watched.tolerance);
  }
}

// Pairs that a joint ties; a body that turns about the world beside a wall that it touches.
template <int d>
void WallWatch<d>::let_pass(const rigid::Bodies<d>& bodies) {
  for (const auto& joint : scene_.joints) {
    if (joint.other)
      std::erase(pairs_, std::pair(std::min(joint.body, *joint.other), std::max(joint.body, *joint.other)));
    if (!turns_about_the_world(scene_, joint)) continue;
    std::erase_if(pairs_, [&](const auto& pair) {
      if (pair.first != joint.body && pair.second != joint.body) return false;
      const std::size_t other = pair.first == joint.body ? pair.second : pair.first;
      if (watched_[other].is_free) return false;
      const Solid<d> wall(placed<d>(watched_[other].hull, bodies.state(other).pose));
      const auto hull = placed<d>(watched_[joint.body].hull, bodies.state(joint.body).pose);
      const Solid<d> own(hull);
      const auto touches = [&](const auto& vertices, const Solid<d>& solid) {
        for (Eigen::Index v = 0; v < vertices.cols(); ++v)
          if (solid.distance(vertices.col(v)) < watched_[joint.body].tolerance) return true;
        return false;
      };
      return touches(hull.vertices, wall) || touches(wall.surface().vertices, own);
    });
  }
}

template <int d>
std::optional<Obstacle> WallWatch<d>::beyond_tank(std::size_t body, const Isometry<d>& pose, double time) const {
  const auto& watched = watched_[body];
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    if (sides_[s].depth(pose.translation()) + watched.reach <= watched.allowed[s]) continue;
    const Eigen::RowVectorXd depth = ((-sides_[s].normal.transpose() * (pose * watched.hull.vertices)).array() +
                                      sides_[s].normal.dot(sides_[s].point))
                                         .matrix();
    Eigen::Index deepest = 0;
    if (depth.maxCoeff(&deepest) <= watched.allowed[s]) continue;
    const Vec<d> at = pose * Vec<d>(watched.hull.vertices.col(deepest));
    return Obstacle{fmt::format("{} goes through {}: at {} m, t = {:.6g} s. Nothing holds it there without [contact]",
                                named(scene_.bodies[body]), sides_[s].name, text<d>(at, 4), time),
                    "Add [contact], so that bodies stop at the tank and at each other, or a larger tank, and run it "
                    "again."};
  }
  return {};
}

template <int d>
bool WallWatch<d>::overlaps(std::size_t a, std::size_t b, States states, double depth) const {
  const auto &first = states[a].pose, &second = states[b].pose;
  const double between = (first.translation() - second.translation()).norm();
  if (between > watched_[a].reach + watched_[b].reach) return false;
  const Solid<d> hull(placed<d>(watched_[a].hull, first)), other(placed<d>(watched_[b].hull, second));
  return overlap<d>(hull, other, depth);
}

template <int d>
std::optional<Obstacle> WallWatch<d>::crossed(States states, double time) const {
  for (std::size_t b = 0; b < watched_.size(); ++b)
    if (watched_[b].is_free)
      if (auto found = beyond_tank(b, states[b].pose, time)) return found;
  for (const auto& [a, b] : pairs_)
    if (overlaps(a, b, states, std::min(watched_[a].tolerance, watched_[b].tolerance)))
      return Obstacle{fmt::format("{} runs into {}: at {} m, t = {:.6g} s. Nothing holds them apart without [contact]",
                                  named(scene_.bodies[a]), named(scene_.bodies[b]),
                                  text<d>(Vec<d>(states[a].pose.translation()), 4), time),
                      "Add [contact], so that bodies stop at each other and at the tank, or start them farther apart, "
                      "and run it again."};
  return {};
}

template class WallWatch<2>;
template class WallWatch<3>;

}  // namespace splashdown::apps
