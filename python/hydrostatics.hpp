// splashdown._simulation: hydrostatics of a hull from a file (rigid/shapes/hydrostatics.hpp).
#pragma once

#include <pybind11/pybind11.h>

namespace splashdown {

/// Adds Afloat and hydrostatics.
void add_hydrostatics(pybind11::module_& m);

}  // namespace splashdown
