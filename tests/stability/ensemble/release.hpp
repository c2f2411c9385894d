// The first acceleration of a body that is let go at rest under water.
//
//   (M + M_a) a = buoyancy - weight,   M = diag(m, I)
//
// about the centre of mass, in body axes. M_a: the added mass that the run recorded at t = 0. Buoyancy: the weight
// of the water that the mesh leaves out, at the centre of the body, where it is for a body of uniform density. The
// whole matrix counts: a pitched body goes sideways and turns while it rises.
#pragma once

#include <filesystem>

namespace splashdown::ensemble {

/// |a - a_expected| / |a_expected| of the centre of mass, from a run's folder. `water`: volume of the liquid if the
/// body were not there. Throws std::runtime_error if a file is not what it should be.
double release_error(const std::filesystem::path& run, double water);

}  // namespace splashdown::ensemble
