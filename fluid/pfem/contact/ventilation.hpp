// Where air gets between the fluid and a wall: from the contact line, under suction.
//
// A film of thickness delta that runs with v around a hull of curvature kappa is pressed to it by the air alone,
// p = -rho v^2 kappa delta at the hull. An inviscid film does so to the end of the hull. Water does not: air gets in at the
// contact line where the boundary layer of the hull separates upstream of it, and films tear (docs/design-notes).
#pragma once

#include <span>

#include "fluid/pfem/mesh/recognition/recognise.hpp"

namespace splashdown::fluid {

/// Pressure of late at nodes tied to walls, nodes.wall_pressure: in 3D a mean over the time in which water passes an element,
///
///   q <- q + (p - q) / (1 + h / (|v - w| kick)),   p = nodes.p + psi / kick
///
/// psi: `repair_impulse` [Pa s], `unknown`: its numbers at nodes, -1: none; nodes.p: of the step. Where water meets a wall a
/// step's repair brings what its pressure takes back; air needs that time to get to a node. In 2D, whose films are
/// resolved less, and in cells that reach from one wall to another, which close faster: q = nodes.p. Nodes that are not tied
/// forget.
template <int d>
void average_wall_pressure(Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& at,
                           std::span<const WallVelocity<d>> velocities, std::span<const int> unknown,
                           std::span<const double> repair_impulse, double kick);

/// Unties wetted nodes beside the contact line, or beside an edge where the flow separates, that air gets to:
///
///   any wall     p < -0.1 rho |v - w|^2 / 2 at the node
///   curved wall  where water passes fast, |v - w|^2 / 2 > g h, and the mean of p over the facets around is negative:
///                in films below resolution (plane); and where p < -0.1 rho |v - w|^2 / 2 at the lowest pressure of the wetted
///                region of negative pressure that the node belongs to
///
/// A row of nodes a step; p: nodes.wall_pressure. `velocities`: of the walls, `gravity`: g.
template <int d>
void ventilate(Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& at, std::span<const WallVelocity<d>> velocities,
               double density, double gravity);

extern template void average_wall_pressure(Nodes<2>&, const Mesh<2>&, const WallsAt<2>&,
                                           std::span<const WallVelocity<2>>, std::span<const int>,
                                           std::span<const double>, double);
extern template void average_wall_pressure(Nodes<3>&, const Mesh<3>&, const WallsAt<3>&,
                                           std::span<const WallVelocity<3>>, std::span<const int>,
                                           std::span<const double>, double);
extern template void ventilate(Nodes<2>&, const Mesh<2>&, const WallsAt<2>&, std::span<const WallVelocity<2>>, double,
                               double);
extern template void ventilate(Nodes<3>&, const Mesh<3>&, const WallsAt<3>&, std::span<const WallVelocity<3>>, double,
                               double);

}  // namespace splashdown::fluid
