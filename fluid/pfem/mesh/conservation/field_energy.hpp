// Kinetic energy of the velocity field, and that a new mesh does not add to it.
//
// Between nodes the velocity is linear, v_h = sum N_i v_i. Nodes keep their velocity when cells change around them, which is
// exact where v_h is linear; elsewhere the field on the new mesh has another energy than the one on the old mesh,
//
//   E = 1/2 int |v_h|^2 dx = sum_c V_c / (2 (d+1) (d+2)) (sum_i |v_i|^2 + |sum_i v_i|^2),
//
// most of all where a front closes on a wall or merged nodes leave their volume to faster ones. Each cell's energy is booked
// to its corners in equal shares, E_i (Nodes::field_energy), which go with the nodes: merged ones leave it to their heir,
// drops take theirs along.
#pragma once

#include <span>
#include <vector>

#include "fluid/pfem/mesh/conservation/free_water.hpp"
#include "fluid/pfem/mesh/mesh.hpp"
#include "fluid/pfem/nodes.hpp"

namespace splashdown::fluid {

/// int |v_h|^2 / 2 dx over a cell [m^d m^2/s^2]; none where it has turned over.
template <int d>
double cell_energy(const std::array<int, d + 1>& cell, const std::vector<Vec<d>>& x, const std::vector<Vec<d>>& v);

/// E_i [m^d m^2/s^2], over the density; of drops V |v|^2 / 2. O(cells).
template <int d>
std::vector<double> field_energies(const Mesh<d>& mesh, const Nodes<d>& nodes);

/// Takes out of the velocities what the mesh has added to Nodes::field_energy. Parts that no wall touches are left to `free`,
/// which keeps their momentum and energy; `recognised`: volumes around nodes by which the patches are known, where they are
/// not Nodes::volume, what nodes carried; `volumes`: V_i [m^d]. O(cells).
///
/// What a part of the water that walls touch has more of afterwards, its excess, is taken out again
/// where it arose, in patches P of nodes whose volume has changed, with shares as they have gained it. There nodes exchange
/// momentum with the others in their cells,
///
///   v_i <- v_i + theta_P / V_i sum_c V_c / (d+1) (m_c - v_i),   m_c mean over the nodes of the cell that are in the patch,
///
/// theta_P in (0, 1] such that the excess goes, a quadratic equation; or, where one exchange does not do, several of them.
/// Momentum sum V_i v_i is kept, no energy is made, and nothing happens to water that has none in excess: no viscosity, and no
/// threshold.
template <int d>
void limit_field_energy(Nodes<d>& nodes, const Mesh<d>& mesh, const FreeWater<d>& free,
                        std::span<const double> recognised, std::span<const double> volumes);

extern template double cell_energy<2>(const std::array<int, 3>&, const std::vector<Vec<2>>&,
                                      const std::vector<Vec<2>>&);
extern template double cell_energy<3>(const std::array<int, 4>&, const std::vector<Vec<3>>&,
                                      const std::vector<Vec<3>>&);
extern template std::vector<double> field_energies(const Mesh<2>&, const Nodes<2>&);
extern template std::vector<double> field_energies(const Mesh<3>&, const Nodes<3>&);
extern template void limit_field_energy(Nodes<2>&, const Mesh<2>&, const FreeWater<2>&, std::span<const double>,
                                        std::span<const double>);
extern template void limit_field_energy(Nodes<3>&, const Mesh<3>&, const FreeWater<3>&, std::span<const double>,
                                        std::span<const double>);

}  // namespace splashdown::fluid
