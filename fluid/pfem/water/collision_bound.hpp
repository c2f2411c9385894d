// The largest step in which water that flies towards a wall or towards other water does not pass through it, and walls that close
// in on each other do not press out at once what is between them.
#pragma once

#include <span>
#include <vector>

#include "fluid/pfem/mesh/mesh.hpp"
#include "fluid/pfem/mesh/recognition/recognise.hpp"
#include "fluid/pfem/nodes.hpp"

namespace splashdown::fluid {

/// max(cfl h, D / 2) / w over nodes of the free surface that would move by more than h within `dt`: D is the distance to a wall
/// or to other water, w the speed at which it closes. Drops of a few elements with little energy are left out: what they hit
/// hardly feels them.
template <int d>
double collision_dt(const Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& walls,
                    std::span<const WallVelocity<d>> velocity, double cfl, double dt);

/// Until walls that approach each other meet: the least V / (-dV/dt) of cells between two walls, V their volume and dV/dt its
/// rate with the velocities of their nodes [s]. What is thinner than a hundredth of the element size may go at once: gaps
/// end.
template <int d>
double gap_time(const Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& walls);

extern template double gap_time(const Nodes<2>&, const Mesh<2>&, const WallsAt<2>&);
extern template double gap_time(const Nodes<3>&, const Mesh<3>&, const WallsAt<3>&);
extern template double collision_dt(const Nodes<2>&, const Mesh<2>&, const WallsAt<2>&,
                                    std::span<const WallVelocity<2>>, double, double);
extern template double collision_dt(const Nodes<3>&, const Mesh<3>&, const WallsAt<3>&,
                                    std::span<const WallVelocity<3>>, double, double);

}  // namespace splashdown::fluid
