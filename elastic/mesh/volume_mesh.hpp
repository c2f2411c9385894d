// The mesh of a body in space: its closed surface is filled by Delaunay refinement with its edges protected, then points get
// weights until flat cells are gone (Oudot, Rineau, Yvinec 2005; Cheng and others 2000; CGAL's Mesh_3). Cells are straight:
// curved sides are chords, a twentieth of `size` away at most. The same surface gives the same mesh.
#pragma once

#include "elastic/mesh/solid_mesh.hpp"

namespace splashdown::elastic {

/// Edges are at most `size` long [m]; where facets of the surface turn by more than 30 degrees the mesh has edges, too.
/// `surface`: closed, normals outward, without crossings. Parts thinner than `size` get elements as small as they are thin:
/// see `forecast` (elastic/mesh/thickness.hpp). Throws MeshError where no mesh has the surface's volume within a tenth.
SolidMesh<3> volume_mesh(const Surface<3>& surface, double size);

}  // namespace splashdown::elastic
