// The first acceleration of a body that is let go at rest under water.
//
//   (M + M_a) a = buoyancy - weight,   M = diag(m, I)
//
// about the centre of mass, in body axes. M_a: the added mass that the run recorded at t = 0. Buoyancy: the weight
// of the water that the mesh leaves out, at the centre of the body, where it is for a body of uniform density. The
// whole matrix counts: a pitched body goes sideways and turns while it rises.
#pragma once

#include <filesystem>
#include <optional>

#include "tests/stability/ensemble/member.hpp"

namespace splashdown::ensemble {

/// The law for a body that is let go in liquid of this viscosity [Pa s; 0: none]; none at all where viscosity has its say between
/// the first step, of elements of `size`, and none: where its layer then is more than a hundredth of `thickness` [m], which would
/// change the added mass by that share. `water`: as below.
std::optional<ReleaseLaw> release_law(double viscosity, double size, double thickness, double water);

/// |a - a_expected| / |a_expected| of the centre of mass, from a run's folder. `water`: volume of the liquid if the
/// body were not there. Throws std::runtime_error if a file is not what it should be.
double release_error(const std::filesystem::path& run, double water);

}  // namespace splashdown::ensemble
