// Where bodies may touch: conditions that keep hulls from crossing each other and planes within a step.
//
//   n . (v_a - v_b) >= -gap / dt        gap: distance along n, n out of hull b
//
// for vertices of a near facets and edges of b, in 3D for convex edges of a that cross convex edges of b, and for all vertices
// near a plane. A gap closes within the step at most; one that is negative opens. A vertex on a curve stands for its arc: the
// circle or sphere through it and its neighbours touches, where -n lies between the normals of the facets there. A polygon of N
// sides that rolls would lose 4 pi/3N of its energy in each radian, or twice its turn of a step if that is more.
//
// Friction and restitution are laws of closed ones: `rubbing` are the rates along which they slide, `rebound` the least rate with
// which they open again.
//
// Bullet's contact points are not used: its closest points of plane outlines drawn as prisms give one point for two
// faces that touch, and normals that leave the plane as soon as they do.
#pragma once

#include <array>
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
  Vec<d> point;   ///< any of the plane, world frame [m]
  Vec<d> normal;  ///< unit, out of the solid
};

/// What may touch, and how it rubs and rebounds.
template <int d>
struct ContactSpec {
  std::vector<Plane<d>> planes;  ///< fixed, that all bodies may touch
  /// Pairs of bodies that do not touch: those that a joint ties, which knows better where they are.
  std::set<std::pair<std::size_t, std::size_t>> apart = {};
  double friction = 0;     ///< mu: |tangential impulse| <= mu normal impulse (Coulomb)
  double restitution = 0;  ///< e: speed of leaving over speed of approach (Newton), 0 to 1
};

/// A place that may be touched, and the condition that hulls do not cross there.
template <int d>
struct Contact : Condition<d> {
  Vec<d> point;   ///< halfway between both, world frame
  Vec<d> normal;  ///< out of `other`
};

/// A hull and its search trees (rigid/contact/hull.hpp).
template <int d>
class Hull;

/// Finds the contacts that a step may close.
template <int d>
class Contacts {
 public:
  /// Refers to the bodies.
  Contacts(ContactSpec<d> spec, std::span<const BodySpec<d>> bodies);
  ~Contacts();
  /// Takes all over.
  Contacts(Contacts&&) noexcept;

  /// As it was made.
  const ContactSpec<d>& spec() const { return spec_; }
  /// Those that may close within a step dt from these states.
  std::vector<Contact<d>> within_reach(std::span<const BodyState<d>> states, double dt) const;

 private:
  ContactSpec<d> spec_;
  std::span<const BodySpec<d>> bodies_;
  std::vector<Hull<d>> hulls_;
};

/// Rates of sliding at a contact, along one direction of its plane or two.
template <int d>
std::array<Condition<d>, d - 1> rubbing(const Contact<d>& contact, std::span<const BodyState<d>> states);

/// first . s_body + second . s_other
template <int d>
double rate_of(const Condition<d>& condition, std::span<const BodyState<d>> states);

/// Newton's law of impact: the rate of a contact that the speed of approach closes within the step is at least e times that; else
/// -infinity.
template <int d>
double rebound(const Condition<d>& contact, std::span<const BodyState<d>> states, double restitution);

extern template class Contacts<2>;
extern template class Contacts<3>;

}  // namespace splashdown::rigid
