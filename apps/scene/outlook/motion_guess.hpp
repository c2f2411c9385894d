// Where a body will be, without a run: for what a run costs, not for results.
#pragma once

#include <optional>

#include "apps/scene/outlook/immersion.hpp"

namespace splashdown::apps {

/// How a free body falls and what the water makes of that, from when it is free on.
///
///   (m + M_a) V keeps its momentum while M_a grows with the plan of what is wet (von Karman 1929), else m + M_a is moved by weight and
///   buoyancy; along the water the body keeps its speed: pressure pushes a bottom that is nearly level up
template <int d>
struct GuessedFall {
  double begins = 0;  ///< [s]
  rigid::Vec<d> velocity = rigid::Vec<d>::Zero(),
                gravity = rigid::Vec<d>::Zero();  ///< then, in the directions in which it is free
  double arrival = 0;                             ///< at the water, after it begins; infinite: never [s]
  double share = 1;          ///< of its speed along the water that it keeps there: less if it starts wet
  double interval = 0;       ///< of `sunk` [s]
  std::vector<double> sunk;  ///< upward, from its arrival on [m]

  /// Since it began to fall.
  rigid::Vec<d> moved(double time) const;
};

/// What guesses of a body's motion need of it, made once for many times.
template <int d>
struct GuessedBody {
  const Body* body;
  rigid::Surface<d> hull;            ///< world frame, at t = 0
  double mass = 0, impact_mass = 0;  ///< of the body, and what the water adds to a plate of its plan [kg, kg/m]
  ImmersionTable<d> immersion;
  GuessedFall<d> fall;  ///< of bodies that are free, or let go at a time
};
template <int d>
GuessedBody<d> guessed_body(const Scene& scene, const Body& body);
/// Of all bodies of the scene, in their order.
template <int d>
std::vector<GuessedBody<d>> guessed_bodies(const Scene& scene) {
  std::vector<GuessedBody<d>> bodies;
  for (const auto& body : scene.bodies) bodies.push_back(guessed_body<d>(scene, body));
  return bodies;
}

/// Displacement of the body between t = 0 and `time` [m], without its turning. Prescribed motion as prescribed; free
/// bodies as in `GuessedFall`, at most to the tank's walls and floor.
template <int d>
rigid::Vec<d> guessed_motion(const Scene& scene, const GuessedBody<d>& body, double time);
template <int d>
rigid::Vec<d> guessed_motion(const Scene& scene, const Body& body, double time);

/// Half the breadth of what will be under water at a time [m], with the water that rises beside a wedge, pi/2 of the
/// depth (Wagner 1932); at t = 0 without it.
template <int d>
double wetted_half(const Scene& scene, const Body& body, double time);

/// Half of the length that the area of its wetted facets is the square of, of the wetted outline in the plane: what `fluid.size.wetted_fraction`
/// is a fraction of in a run [m].
template <int d>
double wetted_length(const Scene& scene, const GuessedBody<d>& body, double time);

/// Where what is under water ends along the horizontal axes, lowest and highest, as it lies on the hull at t = 0 [m]; nothing: dry.
template <int d>
using WettedEnds = Eigen::Matrix<double, 2 * (d - 1), 1>;
template <int d>
std::optional<WettedEnds<d>> wetted_ends(const Scene& scene, const GuessedBody<d>& body, double time);

/// Thickness of the jet beside a hull in the plane whose faces rise at the deadrise beta from its lowest point [m]:
/// pi/8 (V / c')^2 c = c tan^2 beta / 2 pi, c half of the wetted width (Wagner 1932). None below 3 degrees, where
/// trapped air decides (Chuang 1967), without such a point, and in space.
template <int d>
std::optional<double> jet_thickness(const Body& body, double half);

/// Mass of water that moves with a flat plate on its surface: half of what moves with it in the whole space.
template <int d>
double plate_mass(double density, double plan);
template <>
double plate_mass<2>(double density, double breadth);
template <>
double plate_mass<3>(double density, double area);
/// What the water adds to a plate on its surface: half of pi/4 b^2 rho a metre for a strip of breadth b, half of
/// 8/3 rho c^3 for a disc of radius c with the hull's plan area (Lamb 1932, articles 71, 102).
double impact_mass(double density, const rigid::Surface<2>& hull);
double impact_mass(double density, const rigid::Surface<3>& hull);

}  // namespace splashdown::apps
