// What the energy statistics need from a running scene, taken as plain values.
#pragma once

#include "apps/record/recorder.hpp"
#include "apps/statistics/energy_statistics.hpp"

namespace splashdown::apps {

/// Needs a fluid.
template <int d>
WaterAtStart water_at_start(const RecordInput<d>& input);
/// One entry a body.
template <int d>
std::vector<BodyEnergy> body_energies(const RecordInput<d>& input);

/// Volume that a closed surface encloses [m^2, m^3]; `surface`: of a body or a wall.
template <int d, class Surface>
double hull_volume(const Surface& surface) {
  double sum = 0;  // of the simplices between the origin and the facets
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
    Eigen::Matrix<double, d, d> corners;
    for (int k = 0; k < d; ++k) corners.col(k) = surface.vertices.col(surface.facets(k, f));
    sum += corners.determinant();
  }
  return std::abs(sum) / (d == 2 ? 2 : 6);
}

}  // namespace splashdown::apps
