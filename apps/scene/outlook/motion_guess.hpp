// Where a body will be, without a run: for what a run costs, not for results.
#pragma once

#include <optional>

#include "apps/scene/geometry.hpp"

namespace splashdown::apps {

/// What guesses of a body's motion need of it, made once for many times.
template <int d>
struct GuessedBody {
  const Body* body;
  rigid::Surface<d> hull;            ///< world frame, at t = 0
  double mass = 0, impact_mass = 0;  ///< of the body, and what the water adds at its impact [kg, kg/m]
};
template <int d>
GuessedBody<d> guessed_body(const Scene& scene, const Body& body);

/// Displacement of the body between t = 0 and `time` [m], without its turning. Prescribed motion as prescribed; free
/// bodies fall to the water and go on as after a plastic impact on the mass of water that a flat plate of their plan
/// area would meet, at most until the hull is all under water or beside the tank's walls.
template <int d>
rigid::Vec<d> guessed_motion(const Scene& scene, const GuessedBody<d>& body, double time);
template <int d>
rigid::Vec<d> guessed_motion(const Scene& scene, const Body& body, double time);

/// Half the breadth of what will be under water at a time [m], with the water that rises beside a wedge, pi/2 of the
/// depth (Wagner 1932); at t = 0 without it.
template <int d>
double wetted_half(const Scene& scene, const Body& body, double time);

/// Where that ends along the horizontal axes, lowest and highest, as it lies on the hull at t = 0 [m]; nothing: dry.
template <int d>
using WettedEnds = Eigen::Matrix<double, 2 * (d - 1), 1>;
template <int d>
std::optional<WettedEnds<d>> wetted_ends(const Scene& scene, const GuessedBody<d>& body, double time);

/// Thickness of the jet beside a hull in the plane whose faces rise at the deadrise beta from its lowest point [m]:
/// pi/8 (V / c')^2 c = c tan^2 beta / 2 pi, c half of the wetted width (Wagner 1932). None below 3 degrees, where
/// trapped air decides (Chuang 1967), without such a point, and in space.
template <int d>
std::optional<double> jet_thickness(const Body& body, double half);

/// What the water adds to a plate on its surface: half of pi/4 b^2 rho a metre for a strip of breadth b, half of
/// 8/3 rho c^3 for a disc of radius c with the hull's plan area (Lamb 1932, articles 71, 102).
double impact_mass(double density, const rigid::Surface<2>& hull);
double impact_mass(double density, const rigid::Surface<3>& hull);

}  // namespace splashdown::apps
