// Where bodies may touch: conditions that keep hulls from crossing each other and planes within a step.
//
//   n . (v_vertex - v_foot) >= -gap / dt        gap: distance along n, n out of the touched hull
//
// for vertices near the hull of another body and for all vertices near a plane. A gap closes within the step at most;
// one that is negative opens.
//
// Bullet's contact points are not used: its closest points of plane outlines drawn as prisms give one point for two
// faces that touch, and normals that leave the plane as soon as they do.
#pragma once

#include <set>
#include <span>
#include <utility>
#include <vector>

#include "rigid/body.hpp"
#include "rigid/joint.hpp"

namespace splashdown::rigid {

/// The solid is where (x - point) . normal < 0.
template <int d>
struct Plane {
  Vec<d> point, normal;
};

template <int d>
struct ContactSpec {
  std::vector<Plane<d>> planes;
  /// Pairs of bodies that do not touch: those that a joint ties, which knows better where they are.
  std::set<std::pair<std::size_t, std::size_t>> apart = {};
};

template <int d>
std::vector<Condition<d>> contacts_between(const ContactSpec<d>& spec, std::span<const BodySpec<d>> bodies,
                                           std::span<const BodyState<d>> states, double dt);

}  // namespace splashdown::rigid
