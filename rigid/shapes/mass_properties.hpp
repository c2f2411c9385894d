// Mass, centre of mass and moment of inertia of homogeneous bodies.
//
//   From a surface: the divergence theorem turns volume integrals of polynomials into sums over facets,
//   exact for the polyhedron (Mirtich 1996; here as signed cones from one point, any dimension).
//   From a formula: ellipse and capsule, whose outlines are polygons with vertices on the curve. Their
//   polygons enclose less than the curve (256 segments of a circle: 1.0e-4 of the area), so mass from
//   density uses the formula: it is the mass of the thing itself, whatever the outline's resolution.
//   Box and wedge are polygons; formula and surface agree to round-off.
//
// All functions without a density give unit density. Two-dimensional values are per metre of depth.
#pragma once

#include "rigid/body.hpp"

namespace splashdown::rigid {

/// Throws std::invalid_argument if the surface does not enclose a positive volume (normals outward).
template <int d>
MassProperties<d> mass_properties(const Surface<d>& surface);

/// The same body with another density [kg/m^3] or with another mass [kg, kg/m]; neither may be negative.
template <int d>
MassProperties<d> with_density(const MassProperties<d>& unit_density, double density);
template <int d>
MassProperties<d> with_mass(const MassProperties<d>& any_density, double mass);

// Frames as in rigid/shapes/shapes.hpp.
MassProperties<2> box_mass_properties(double width, double height);
MassProperties<2> ellipse_mass_properties(double a, double b);
MassProperties<2> capsule_mass_properties(double radius, double straight);
MassProperties<2> wedge_mass_properties(double deadrise, double breadth, double side);

}  // namespace splashdown::rigid
