// A plane of symmetry: what lies beyond it is the mirror image of what lies before it.
#pragma once

#include "core/types.hpp"

namespace splashdown {

/// The plane x[axis] = at in the world; what is simulated lies where x[axis] >= at.
struct Mirror {
  int axis = 0;   ///< across the plane
  double at = 0;  ///< [m]

  /// How far a point lies before the plane [m]; negative beyond it.
  template <int d>
  double distance(const Vec<d>& x) const {
    return x[axis] - at;
  }
  /// The closest point of the plane, to the bit.
  template <int d>
  Vec<d> onto(Vec<d> x) const {
    x[axis] = at;
    return x;
  }
  /// The mirror image of a point.
  template <int d>
  Vec<d> image(Vec<d> x) const {
    x[axis] = 2 * at - x[axis];
    return x;
  }
  /// Of (V, w) or (F, M), the entries that a motion or a load has which is its own mirror image: the velocity along the plane
  /// and the turn about the axis across it.
  template <int d>
  Twist<d> kept() const {
    Twist<d> kept = Twist<d>::Zero();
    kept.template head<d>().setOnes();
    kept[axis] = 0;
    if constexpr (d == 3) kept[3 + axis] = 1;
    return kept;
  }
};

}  // namespace splashdown
