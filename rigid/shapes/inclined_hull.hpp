// A hull in one attitude and what it displaces at any height: what searches for equilibria ask for again and again.
// Internal to the rigid-body room.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "rigid/shapes/hollows.hpp"
#include "rigid/shapes/hydrostatics.hpp"

namespace splashdown::rigid {

/// A surface in the body frame, kept by reference, and whether its hollows are dry.
template <int d>
struct FloatingHull {
  const Surface<d>& surface;
  Hollows<d> hollows;
  double volume = 0;           ///< of the solid [m^2, m^3]
  double extent = 0;           ///< diagonal of its box [m]
  Hollow state = Hollow::dry;  ///< what is in its hollows

  /// `of`: closed, body frame, normals outward; must live longer.
  FloatingHull(const Surface<d>& of, Hollow hollow);
};

/// What a balance of volumes needs, at a fifth of the price of all integrals.
struct Displaced {
  double volume = 0, waterline = 0;
};

/// No hollow is flooded.
inline constexpr double no_rim = std::numeric_limits<double>::lowest();

/// Heights are those over the centre of mass. Hollows are flooded whose rim is at `flooded` or lower, the others are dry.
template <int d>
class InclinedHull {
 public:
  /// `attitude`: body frame to world; the hull must live longer.
  InclinedHull(const FloatingHull<d>& hull, const Mat<d>& attitude);

  /// Height of the lowest vertex over the centre of mass [m].
  double lowest() const { return lowest_; }
  /// Height of the highest vertex over the centre of mass [m].
  double highest() const { return highest_; }
  /// Of the solid [m^2, m^3].
  double volume() const { return hull_->volume; }
  /// Ascending heights of the rims of all hollows.
  const std::vector<double>& rims() const { return rims_; }
  /// Volume below `level` [m] and waterline there, with the dry hollows.
  Displaced displaced(double level, double flooded) const;
  /// Centres are relative to the centre of mass.
  Submerged<d> submerged(double level, double flooded) const;
  /// The lowest rim of a dry hollow with a part below the level; infinity without.
  double rim_above(double level, double flooded) const;

 private:
  template <class Visit>
  void each_wet_part(double level, double flooded, const Visit& visit) const;

  const FloatingHull<d>* hull_;
  Eigen::Matrix<double, d, Eigen::Dynamic> turned_;
  double lowest_ = 0, highest_ = 0;
  std::vector<double> reached_, rims_;
};

/// Water level over the centre of mass at which a hull displaces a volume, and the rims that came under water before.
struct Immersion {
  double level = 0, flooded = no_rim;
};

/// The first to which a hull that comes down on the water sinks; nothing if it goes under. `guess`: a level near it.
template <int d>
std::optional<Immersion> balanced(const InclinedHull<d>& hull, double volume, double guess);

/// Turns by a slope: a point at the horizontal distance p rises by slope . p. In space about ez x slope.
template <int d>
Mat<d> tilt(const Slope<d>& slope);
template <>
Mat<2> tilt<2>(const Slope<2>& slope);
template <>
Mat<3> tilt<3>(const Slope<3>& slope);

/// What describes a hull that floats like this.
template <int d>
Floating<d> assessed(const InclinedHull<d>& hull, const Isometry<d>& pose, const Immersion& at, double water_level);

/// The lever of the righting moment, centre of buoyancy over the ground beside that of mass [m].
template <int d>
Slope<d> lever(const Floating<d>& f) {
  return (f.submerged.centre - f.pose.translation()).template head<d - 1>();
}

/// |GM| of round bodies over the hull's extent: that of their facets (a 128-gon: 3e-4 radii).
inline constexpr double facets_share = 1e-4;

/// Descends in energy by tilting along the allowed slopes, orthonormal columns; nothing if the hull sinks on the way.
template <int d, int n>
std::optional<Floating<d>> settled(FloatingHull<d>& hull, const Isometry<d>& pose, double volume, double water_level,
                                   const Eigen::Matrix<double, d - 1, n>& allowed);

extern template struct FloatingHull<2>;
extern template struct FloatingHull<3>;
extern template class InclinedHull<2>;
extern template class InclinedHull<3>;

}  // namespace splashdown::rigid
