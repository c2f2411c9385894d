// What a paddle that swings with a small stroke sends out, far away from it, on water of constant depth d:
//
//   piston               H/S = 4 sinh kd sinh kd / (sinh 2kd + 2kd)
//   flap, hinge at b     H/S = 4 sinh kd (sinh kd - (cosh kd - cosh kb)/(k (d - b))) / (sinh 2kd + 2kd)
//
// H the height of the waves, S the stroke at the still level from end to end, k the wave number, b the height of the hinge above
// the bed, below which the wall is fixed (Havelock 1929; Biesel and Suquet 1951; Dean and Dalrymple, Water Wave Mechanics, 1984,
// section 6.3). A sea is the sum of its waves: each is where the paddle's speed has its crest.
#pragma once

#include <span>
#include <vector>

#include "fluid/effects/waves/spectrum.hpp"

namespace splashdown::fluid {

/// How a paddle moves.
enum class Paddle { piston, flap };

/// H/S for k d > 0; to roundoff also in deep water. `hinge`: b/d of a flap, from 0 to below 1.
double height_over_stroke(Paddle paddle, double kd, double hinge = 0);

/// A paddle and its water.
struct PaddleSpec {
  Paddle type = Paddle::piston;
  double hinge = 0;       ///< of a flap above the bed [m]
  double depth = 0;       ///< [m]
  double gravity = 9.81;  ///< [m/s^2]
  double ramp = 0;        ///< in which the motion grows from nothing [s]
};

/// A sea of linear waves that run away from a paddle, and how the paddle moves for it.
class PaddleSea {
 public:
  /// `waves`: with their crests at the paddle's place at rest at the phases that they have; directions do not matter.
  PaddleSea(std::span<const SeaWave> waves, const PaddleSpec& spec);

  /// Of the paddle's face at the still level at time t [s], towards the water [m].
  double displacement(double t) const;
  /// Of the surface above the still level [m], `x` [m] away from the paddle's place at rest, some depths at least. The motion's
  /// growth comes with the speed of the energy.
  double elevation(double x, double t) const;
  /// Its shortest wave's period [s].
  double shortest_period() const;

 private:
  struct Component {
    double w, k, phase, amplitude, stroke, group;  // [rad/s], [1/m], rad, [m], half a stroke [m], [m/s]
  };
  double share(double t) const;

  std::vector<Component> waves_;
  double ramp_;
};

}  // namespace splashdown::fluid
