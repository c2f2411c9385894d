// What pictures and rows need from a running scene, taken as plain values.
#pragma once

#include "apps/record/frames/frames.hpp"
#include "apps/record/recorder.hpp"

namespace splashdown::apps {

template <int d>
Frame<d> take_frame(const RecordInput<d>& input);

/// Index of a wall by name, -1 if there is none.
template <int d>
int wall_index(const FluidView<d>& fluid, const std::string& name);

/// The same; throws std::invalid_argument if there is none.
template <int d>
int wall_called(const FluidView<d>& fluid, const std::string& name);

/// Index of a body by name; throws std::invalid_argument if there is none.
template <int d>
std::size_t body_index(const BodiesView<d>& bodies, const std::string& name);

/// Highest point of the free surface, without drops; nan if there is none [m].
template <int d>
double water_level(const FluidView<d>& fluid);

}  // namespace splashdown::apps
