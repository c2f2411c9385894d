// What becomes of volume that the mesh loses or gains.
//
// Nodes carry the volume of the cells around them. Moving along curved paths, merging nodes and recognising anew which cells
// are liquid change what the mesh encloses. The difference is owed to the connected water where it arose, and comes back in
// the same step: the free surface moves outwards by
//
//   dx_i = g w_i l_i A_i / S_i,   g = owed / sum_i l_i |A_i|^2 / S_i,   l_i = min(V_i / S_i, S_i^(1/(d-1)))
//
// V_i: volume around node i, A_i: area vector of its free surface, S_i: its measure, so that sheets and tips
// grow by the same share of their thickness as the rest, but for w_i, which keeps the centre of mass (shares.hpp). Nodes
// whose cells have turned over have no volume, before and after: they keep their velocity. The sum of volume and what is
// owed, spray included, is the volume that the water began with, to roundoff.
#pragma once

#include <span>
#include <vector>

#include "fluid/pfem/mesh/conservation/free_water.hpp"
#include "fluid/pfem/mesh/mesh.hpp"
#include "fluid/pfem/mesh/recognition/recognise.hpp"
#include "fluid/pfem/nodes.hpp"

namespace splashdown::fluid {

/// Moves free nodes of the surface of `mesh` by what is owed, Nodes::volume + Nodes::owed of before less the volume of the
/// cells now, `volumes` around each node [m^d] (nodal_volumes of the mesh), and sets Nodes::owed so that this sum is kept;
/// returns the volume around each node then [m^d]. Nodes turn no cells over and enter no walls; tied ones stay on theirs, and
/// water that walls enclose on all sides has no room: it gets nothing back. `carried`: V0_i of nodes [m^d].
///
/// Energy. Of what a node gains, O_i is its own: with V0_i what it carried before it was moved or triangulated anew, V_i what it
/// has then, V1_i with what comes back, and w the mean velocity of free water, zero where walls are,
///
///   O_i = max(0, min(V0_i, V1_i) - V_i),   T0 = sum V0_i |v_i - w|^2 / 2,   T = sum min(V_i, V1_i) |v_i - w|^2 / 2,
///   R = sum O_i |v_i - w|^2 / 2,           s = (T0 - T) / R within [0, 1],
///
///   v_i <- w + (v_i - w) ((V_i + s O_i) / V1_i)^1/2     where V1_i > V_i
///
/// Water that a cut has made smaller and that grows again goes on at its speed, if its part has lost that much; other volume
/// comes without energy.
template <int d>
std::vector<double> return_volume(Nodes<d>& nodes, const Mesh<d>& mesh, const WallsAt<d>& walls,
                                  const FreeWater<d>& free, const std::vector<double>& volumes,
                                  std::span<const double> carried);

extern template std::vector<double> return_volume(Nodes<2>&, const Mesh<2>&, const WallsAt<2>&, const FreeWater<2>&,
                                                  const std::vector<double>&, std::span<const double>);
extern template std::vector<double> return_volume(Nodes<3>&, const Mesh<3>&, const WallsAt<3>&, const FreeWater<3>&,
                                                  const std::vector<double>&, std::span<const double>);

}  // namespace splashdown::fluid
