// Meshes of practically one size: between them peaks scatter, and their mean scatters less.
#pragma once

namespace splashdown::apps {

/// Replicates stand this share beside the mesh that they repeat: another mesh of nearly the same size. With first order
/// that moves an error by a fiftieth of itself, which is far below the scatter that they are to show.
inline constexpr double replicate_offset = 0.02;

/// With four digits that many differ.
inline constexpr int most_replicates = 48;

/// The refinement of replicate k = 0, 1 ... of a mesh: pairs about its own, within 3 %, the first of them `replicate_offset` away.
double replicate_refine(double refine, int k);

}  // namespace splashdown::apps
