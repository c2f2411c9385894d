// Drops that land become part of much larger cells. They bring their own momentum and no more: the liquid that
// now counts to their nodes too keeps its velocity.
//
//   v <- w + V_before / V (v - w),   w mean velocity of the new neighbours, by their volume
#pragma once

#include "fluid/mesh/mesh.hpp"
#include "fluid/nodes.hpp"

namespace splashdown::fluid {

/// For nodes around which the volume V on `mesh` is more than three times Nodes::volume: remeshing alone hardly
/// doubles it. They also forget what the corrections found for them.
template <int d>
void absorb_droplets(Nodes<d>& nodes, const Mesh<d>& mesh);

extern template void absorb_droplets(Nodes<2>&, const Mesh<2>&);
extern template void absorb_droplets(Nodes<3>&, const Mesh<3>&);

}  // namespace splashdown::fluid
