#include "apps/record/tables/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splashdown::apps {

template <int d>
double wetted_facets(const RecordInput<d>& input, std::size_t body) {
  if (!input.fluid) return 0;
  const auto boundary = input.fluid->boundary();
  const int wall = static_cast<int>(body);  // body k is wall k
  return static_cast<double>(std::ranges::count(boundary, wall, &Facet<d>::wall));
}

template <int d>
std::vector<char> symmetric_axes(const RecorderSettings<d>& settings, const std::string& body) {
  const auto found = settings.symmetric.find(body);
  return found == settings.symmetric.end() ? std::vector<char>{} : found->second;
}

template <int d>
void add_pressure_evidence(Summary& summary, const RecorderSettings<d>& settings, const PressureReadings<d>& readings,
                           const StepsOfBody& steps_of) {
  for (std::size_t i = 0; i < settings.patches.size(); ++i) {
    auto& patch = summary.patches[settings.patches[i].name];
    const auto* steps = steps_of(patch.body);
    if (!steps || patch.pressure.time < 0) continue;
    patch.evidence = steps->at_pressure(patch.pressure.time);
    patch.evidence.step = steps->step_share(readings.hulls.history(i), patch.pressure.time);
    const double half_width = d == 2 ? patch.area / 2 : std::sqrt(patch.area / std::numbers::pi);
    patch.evidence.pressed = half_width / steps->facet_size(patch.pressure.time);
  }
  for (std::size_t i = 0; i < settings.pressure_probes.size(); ++i) {
    auto& point = summary.probes[settings.pressure_probes[i].name];
    const auto* steps = steps_of(point.body);
    if (!steps || point.pressure.time < 0) continue;
    point.evidence = steps->at_pressure(point.pressure.time);
    point.evidence.step = steps->step_share(readings.points.history(i), point.pressure.time);
    point.evidence.pressed = 0;
  }
  for (auto& [name, body] : summary.bodies) {
    const auto* steps = steps_of(name);
    if (!steps || !body.maximum_pressure) continue;
    auto& evidence = body.maximum_pressure->evidence;
    const double beside = evidence.step;
    evidence = steps->at_pressure(body.maximum_pressure->peak.time);
    evidence.step = beside;
    evidence.pressed = 0;  // a point
  }
}

template double wetted_facets<2>(const RecordInput<2>&, std::size_t);
template std::vector<char> symmetric_axes<2>(const RecorderSettings<2>&, const std::string&);
template void add_pressure_evidence<2>(Summary&, const RecorderSettings<2>&, const PressureReadings<2>&,
                                       const StepsOfBody&);
template double wetted_facets<3>(const RecordInput<3>&, std::size_t);
template std::vector<char> symmetric_axes<3>(const RecorderSettings<3>&, const std::string&);
template void add_pressure_evidence<3>(Summary&, const RecorderSettings<3>&, const PressureReadings<3>&,
                                       const StepsOfBody&);

}  // namespace splashdown::apps
