// Bodies in 3D: closed triangle meshes, normals outward, with the exact mass properties of the shape itself.
//
// Every shape comes in a frame of its own (stated below); `centred` moves it to its centre of mass. All vertices lie
// on the exact surface. Round shapes have `around` edges on their widest circle, and triangles of about that size all
// over; where the surface bends, neighbouring triangles turn by 360 deg / `around` about the axis at most, so that only
// true edges are creases. Flat faces of a box are two triangles each: they need no more.
// Impossible values are std::invalid_argument; the text states rule and value.
#pragma once

#include <span>

#include "rigid/shapes/shapes.hpp"

namespace splashdown::rigid {

/// The polyhedron of a sphere encloses 0.05 % less than the sphere, that of a cylinder 0.04 %.
inline constexpr int default_around = 128;

/// Centre at the origin, radius [m]. A subdivided icosahedron: no poles.
Shape<3> sphere(double radius, int around = default_around);

/// Centre at the origin; edges of these lengths along the axes [m].
Shape<3> box(const Vec<3>& size);

/// Apex down at the origin, axis z, flat top at z = radius tan(deadrise). Deadrise, between the horizontal and the
/// cone's side, in radians, between 0 and pi/2.
Shape<3> cone(double deadrise, double radius, int around = default_around);

/// A cylinder of length `straight` [m] between two half spheres: axis along x, centre at the origin.
Shape<3> capsule_of_revolution(double radius, double straight, int around = default_around);

/// A profile of points (r, z) [m] turned about the z axis, straight between the points. Either sense; r >= 0. An end that
/// is not on the axis is closed by a flat disc. Curves are as round as their points make them.
Shape<3> revolved(std::span<const Vec<2>> profile, int around = default_around);

/// Of that body at unit density, exactly: m = pi int r^2 dz and so on.
MassProperties<3> mass_properties_of_revolution(std::span<const Vec<2>> profile);

}  // namespace splashdown::rigid
