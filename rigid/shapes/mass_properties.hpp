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

/// m = int dV, c = int x dV / m, I = int (|r|^2 1 - r r^T) dV, r = x - c, of unit density: exact for the polygon or polyhedron.
/// In the surface's frame [m^d, m, m^(d+2)]. Throws std::invalid_argument if the surface does not enclose a positive volume
/// (normals outward).
template <int d>
MassProperties<d> mass_properties(const Surface<d>& surface);

/// The same body with another density [kg/m^3] or with another mass [kg, kg/m]: m and I scale with it, c stays. Throws
/// std::invalid_argument for negative values and those that are not finite.
template <int d>
MassProperties<d> with_density(const MassProperties<d>& unit_density, double density);
/// The same body with another mass [kg, kg/m].
template <int d>
MassProperties<d> with_mass(const MassProperties<d>& any_density, double mass);

/// Of unit density; lengths [m], deadrise [rad], frames as in rigid/shapes/shapes.hpp, which checks them. I / m of the box is
/// (width^2 + height^2) / 12, of the ellipse (a^2 + b^2) / 4.
MassProperties<2> box_mass_properties(double width, double height);
/// Semi-axis a along x, b along y [m].
MassProperties<2> ellipse_mass_properties(double a, double b);
/// A rectangle of length `straight` between two half discs of `radius` [m], long axis along x.
MassProperties<2> capsule_mass_properties(double radius, double straight);
/// Triangle below, rectangle of height `side` above; keel at the origin.
MassProperties<2> wedge_mass_properties(double deadrise, double breadth, double side);

}  // namespace splashdown::rigid
