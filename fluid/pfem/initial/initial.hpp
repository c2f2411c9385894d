// The liquid at t = 0: regions clipped by walls, meshed to the size field.
#pragma once

#include <optional>
#include <stdexcept>

#include "fluid/pfem/mesh/recognition/recognise.hpp"
#include "fluid/pfem/spec.hpp"

namespace splashdown::fluid {

/// Nodes and mesh at t = 0, world frame.
template <int d>
struct InitialLiquid {
  Nodes<d> nodes;
  Mesh<d> mesh;
};

/// Water between two walls, in space.
struct Gap {
  std::size_t first, second;  ///< walls
  Vec<3> at;                  ///< on one of them
  double width, size;         ///< of the gap; of elements there [m]
};

/// Gaps of at least this over h are filled by the first mesh, narrower ones mostly (docs/theory.md, "Gaps between walls").
inline constexpr double filled_gap = 0.4;

/// A gap that the first mesh does not fill.
class GapRefused : public std::invalid_argument {
 public:
  /// `which`: the gap; `what`: rule and cure, for the user.
  GapRefused(const Gap& which, const std::string& what) : std::invalid_argument(what), gap(which) {}
  Gap gap;  ///< width 0: not known
};

/// What `fill` tells before it makes a mesh, in a second or so: throws as `fill` does. The narrowest gap that the mesh may
/// fail to fill; nothing if there is none. In the plane gaps of any width are filled.
template <int d>
std::optional<Gap> look_at_start(const FluidSpec<d>& spec, const WallsAt<d>& walls);

/// Throws std::invalid_argument if no liquid remains, GapRefused for gaps that cannot be filled.
template <int d>
InitialLiquid<d> fill(const FluidSpec<d>& spec, const WallsAt<d>& walls);

}  // namespace splashdown::fluid
