// Sheets of one element: water between two free surfaces with no node between them.
//
// At a free surface p = 0, and across one element nothing can differ from it: such water is in free fall, and what the mesh says
// beyond that (volume that flips move, facets that turn over, pressures that keep up with both) is its own noise. Thin jets grew
// scallops and hairs of it, which bent back into their root. So a node none of whose cells has a node that is within the water or
// on a wall flies as a drop (droplets.hpp), under the effects alone, and the cells around it are no water any more:
//
//   of each of them, V, every corner that stays gives V / (d + 1) to the corners that fly, in equal shares, with its momentum:
//     v <- (V_f v_f + s v) / (V_f + s), x likewise,  V_f <- V_f + s
//
// and what it has of the field's energy in the cell (field_energy.hpp).
#pragma once

#include <functional>

#include "fluid/pfem/mesh/mesh.hpp"
#include "fluid/pfem/mesh/recognition/recognise.hpp"
#include "fluid/pfem/nodes.hpp"

namespace splashdown::fluid {

/// Lets nodes of sheets for which `may_fly` holds do so, and those that are left without cells: removes the cells from `mesh`,
/// closes its boundary, sets Nodes::spray and Nodes::surface, and hands over Nodes::volume and Nodes::field_energy.
/// `flat_cells`, which are closed as long as there is water all around (Recognised), open beside what flies.
///
/// Water that has just closed a gap between two waters stays until nodes carry it. So does all of a part of which more than
/// half would fly, but for one that all does: its mesh is coarse rather than its water thin.
///
/// Volume, momentum and centre of mass are kept, kinetic energy falls by what the velocities differ across a cell.
template <int d>
void let_sheets_fly(Nodes<d>& nodes, Mesh<d>& mesh, FlatCells<d>& flat_cells, const std::function<bool(int)>& may_fly);

/// Lets these nodes, and those that are left without cells, fly in the same way, whatever they are of.
template <int d>
void let_fly(Nodes<d>& nodes, Mesh<d>& mesh, FlatCells<d>& flat_cells, const std::vector<char>& flies);

extern template void let_fly(Nodes<2>&, Mesh<2>&, FlatCells<2>&, const std::vector<char>&);
extern template void let_fly(Nodes<3>&, Mesh<3>&, FlatCells<3>&, const std::vector<char>&);
extern template void let_sheets_fly(Nodes<2>&, Mesh<2>&, FlatCells<2>&, const std::function<bool(int)>&);
extern template void let_sheets_fly(Nodes<3>&, Mesh<3>&, FlatCells<3>&, const std::function<bool(int)>&);

}  // namespace splashdown::fluid
