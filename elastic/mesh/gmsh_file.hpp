// Meshes of solids from Gmsh: .msh of version 2.2 or 4.1 as text. Triangles (plane, z the same everywhere) or tetrahedra,
// straight or of second order; points, lines and, in space, surface elements are passed over.
#pragma once

#include <filesystem>
#include <istream>
#include <string>

#include "elastic/mesh/solid_mesh.hpp"

namespace splashdown::elastic {

/// Coordinates are multiplied by `scale` (0.001: the file is in millimetres). Throws MeshError; texts name file and line.
template <int d>
SolidMesh<d> read_gmsh(const std::filesystem::path& file, double scale = 1);
/// The same of a text that is called `name` in errors.
template <int d>
SolidMesh<d> read_gmsh(std::istream& text, const std::string& name, double scale = 1);

}  // namespace splashdown::elastic
