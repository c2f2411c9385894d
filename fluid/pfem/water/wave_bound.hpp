// The largest step with which waves on the mesh stay stable.
#pragma once

#include "fluid/pfem/mesh/mesh.hpp"
#include "fluid/pfem/nodes.hpp"

namespace splashdown::fluid {

/// 2 / omega, omega an upper bound of the highest frequency that the water's weight gives to its free surface:
///
///   omega^2 = (1 + z + 2 z^2) max over surface nodes of g b_i / m_i,  z = (d+1)/(d+2)
///
/// m_i the node's volume, b_i a d-th of the area of the surface around it, seen along gravity. Infinite without gravity.
/// Left out: surfaces that hang, sheets, and spikes, which carry no pressure and fly.
template <int d>
double wave_dt(const Nodes<d>& nodes, const Mesh<d>& mesh, const Vec<d>& gravity);

}  // namespace splashdown::fluid
