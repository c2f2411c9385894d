// What grades of numbers need from a running scene, taken as plain values.
#pragma once

#include <functional>

#include "apps/record/hulls.hpp"
#include "apps/record/points.hpp"
#include "apps/record/recorder.hpp"
#include "apps/statistics/evidence.hpp"

namespace splashdown::apps {

/// Facets of the mesh on a body's hull.
template <int d>
double wetted_facets(const RecordInput<d>& input, std::size_t body);

/// Horizontal axes along which symmetry forbids a load on the body; none if nothing is known.
template <int d>
std::vector<char> symmetric_axes(const RecorderSettings<d>& settings, const std::string& body);

/// What mesh and loads of a body said in every step; null for a body without any.
using StepsOfBody = std::function<const EvidenceStatistics*(const std::string& body)>;

/// What was read of pressures.
template <int d>
struct PressureReadings {
  const HullReadings<d>& hulls;
  const PointReadings& points;
};

/// Fills the evidence about peaks of patches and of points, and about the largest pressures.
template <int d>
void add_pressure_evidence(Summary& summary, const RecorderSettings<d>& settings, const PressureReadings<d>& readings,
                           const StepsOfBody& steps_of);

}  // namespace splashdown::apps
