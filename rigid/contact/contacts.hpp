// Where bodies may touch: conditions that keep hulls from crossing each other and planes within a step.
//
//   n . (v_a - v_b) >= -gap / dt        gap: distance along n, n out of hull b
//
// for vertices of a near facets and edges of b, in space for convex edges of a that cross convex edges of b, and for all vertices
// near a plane. A gap closes within the step at most; one that is negative opens.
//
// Bullet's contact points are not used: its closest points of plane outlines drawn as prisms give one point for two
// faces that touch, and normals that leave the plane as soon as they do.
#pragma once

#include <memory>
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
class Hull;

template <int d>
class Contacts {
 public:
  /// Refers to the bodies.
  Contacts(ContactSpec<d> spec, std::span<const BodySpec<d>> bodies);
  ~Contacts();
  Contacts(Contacts&&) noexcept;

  /// Those that may close within a step dt from these states.
  std::vector<Condition<d>> within_reach(std::span<const BodyState<d>> states, double dt) const;

 private:
  ContactSpec<d> spec_;
  std::span<const BodySpec<d>> bodies_;
  std::vector<Hull<d>> hulls_;
};

extern template class Contacts<2>;
extern template class Contacts<3>;

}  // namespace splashdown::rigid
