// How thin a body is, by balls inside that touch its surface (medial axis; Ma, Bae, Choi 2012).
#pragma once

#include <limits>

#include "elastic/mesh/solid_mesh.hpp"

namespace splashdown::elastic {

/// What `volume_mesh` would make of a surface.
struct VolumeForecast {
  double elements = 0;  ///< within a factor of three
  double thin =
      std::numeric_limits<double>::infinity();  ///< a fifth of the surface is over parts thinner than this [m]
};
/// From balls at some thousand points.
VolumeForecast forecast(const Surface<3>& surface, double size);

}  // namespace splashdown::elastic
