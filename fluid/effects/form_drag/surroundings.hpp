// The water around a hull: with what velocity it would pass if the hull were not there, and where the hull's wake goes.
//
// Nodes in the shell R < |x - c| < 2 R around the centre c of a hull that a sphere of radius R holds. The components of the
// velocity that a body makes in water at rest are harmonic beyond it and vanish far away: their means over spheres are zero, and
// of a dipole's those over the front half and the rear half, too. By reciprocity (Green) a force on the water with such a density
// puts no pressure on the hull: what is taken from the hull does not come back to it.
#pragma once

#include <optional>
#include <vector>

#include "core/mirror.hpp"
#include "fluid/effects/effect.hpp"

namespace splashdown::fluid {

/// The sphere around a hull, in the wall's frame.
template <int d>
struct HullSphere {
  Vec<d> centre = Vec<d>::Zero();  ///< [m]
  double radius = 0;               ///< [m]
  double breadth = 0;              ///< diameter of the circle or sphere that holds as much [m]
};
/// Centre: of the surface's extents. Hulls reach across a plane of symmetry whole.
template <int d>
HullSphere<d> sphere_around(const Surface<d>& surface);

/// Made for one step and one hull.
template <int d>
class Surroundings {
 public:
  /// `centre` world frame [m]. With a mirror, on its plane, motions are their own mirror images, and impulses act on one half.
  Surroundings(const StepView<d>& step, const Vec<d>& centre, double radius, int wall,
               const std::optional<Mirror>& mirror);
  /// Turns the weights towards `direction`, of the hull through the water, any length; zero: both are even.
  void face(const Vec<d>& direction);
  /// Motion of the water ahead, about the centre [m/s, rad/s]: the rigid one that is nearest to it.
  Twist<d> ahead(std::span<const Vec<d>> v) const;
  /// Changes of velocity behind, of the nodes in the shell, that an impulse on the water about the centre makes. Largest one in
  /// `fastest` [m/s].
  std::vector<std::pair<int, Vec<d>>> behind(const Wrench<d>& impulse, double& fastest) const;
  /// Whether there is so much water that it has a motion.
  bool empty() const { return around_.size() < 2 * d; }

 private:
  struct Around {
    int node;
    Vec<d> arm;             // from the centre
    double mass, side = 0;  // 1 ahead, -1 behind
  };
  template <class Weight>
  Eigen::Matrix<double, freedoms<d>, freedoms<d>> inertia(Weight weight) const;
  /// The rigid motion of that inertia with that momentum.
  Twist<d> motion_of(const Eigen::Matrix<double, freedoms<d>, freedoms<d>>& inertia, const Wrench<d>& momentum) const;

  std::vector<Around> around_;
  Twist<d> kept_ = Twist<d>::Ones();  // 0: entries that a mirror takes away
};

extern template HullSphere<2> sphere_around(const Surface<2>&);
extern template HullSphere<3> sphere_around(const Surface<3>&);
extern template class Surroundings<2>;
extern template class Surroundings<3>;

}  // namespace splashdown::fluid
