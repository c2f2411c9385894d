// The room that hulls take in water which is all around them.
//
// A hull's facets between nodes of the water are chords: what they enclose is less than a round or edged hull holds, and
// changes as nodes slide over it and are triangulated anew. The water around is no more or less for it.
#pragma once

#include <optional>
#include <vector>

#include "core/mirror.hpp"
#include "fluid/pfem/mesh/mesh.hpp"

namespace splashdown::fluid {

/// Enclosed by the facets of a wall: volume [m^d] and its centre. Without volume where other facets meet them.
template <int d>
struct DisplacedVolume {
  double volume = 0;
  Vec<d> centre = Vec<d>::Zero();  ///< world frame [m]

  /// Whether the wall's facets enclose a volume by themselves.
  bool is_closed() const { return volume > 0; }
};

/// Of each of the first `walls` walls. With a plane of symmetry: what is before it, of hulls that are closed with what is beyond.
template <int d>
std::vector<DisplacedVolume<d>> displaced_volumes(const Mesh<d>& mesh, const std::vector<Vec<d>>& x, std::size_t walls,
                                                  const std::optional<Mirror>& mirror = {});

extern template std::vector<DisplacedVolume<2>> displaced_volumes(const Mesh<2>&, const std::vector<Vec<2>>&,
                                                                  std::size_t, const std::optional<Mirror>&);
extern template std::vector<DisplacedVolume<3>> displaced_volumes(const Mesh<3>&, const std::vector<Vec<3>>&,
                                                                  std::size_t, const std::optional<Mirror>&);

}  // namespace splashdown::fluid
