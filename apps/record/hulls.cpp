#include "apps/record/hulls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/record/frames/frames.hpp"
#include "apps/record/probes.hpp"
#include "apps/record/view.hpp"

namespace splashdown::apps {

template <int d>
Vec<d> centre_of_mass(const RecorderSettings<d>& settings, const std::string& wall) {
  const auto found = settings.centre_of_mass.find(wall);
  return found == settings.centre_of_mass.end() ? Vec<d>(Vec<d>::Zero()) : found->second;
}

namespace {

/// How far the pressure of a point is off the mean of those that share a facet with it, relative.
template <int d>
double above_neighbours(const HullMap<d>& map, std::size_t point) {
  const auto& facets = map.surface().facets;
  double sum = 0, count = 0;
  for (Eigen::Index f = 0; f < facets.cols(); ++f) {
    if ((facets.col(f).array() != static_cast<int>(point)).all()) continue;
    for (int k = 0; k < d; ++k) {
      const auto other = static_cast<std::size_t>(facets(k, f));
      if (other != point) sum += map.pressure()[other], count += 1;
    }
  }
  return sum > 0 ? std::abs(map.pressure()[point] / (sum / count) - 1) : std::numeric_limits<double>::infinity();
}

/// A wall as the fluid meets it; of one that deforms as it was at t = 0, with the body's pose then.
template <int d>
WallFacets<d> as_made(const FluidView<d>& fluid, int wall, const std::vector<Vec<d>>& at_rest,
                      const Isometry<d>& pose) {
  auto facets = wall_facets(fluid, wall);
  if (at_rest.empty()) return facets;
  facets.points = at_rest;
  facets.pose = pose;
  return facets;
}

}  // namespace

template <int d>
HullReadings<d>::HullReadings(const RecorderSettings<d>& settings)
    : settings_(settings),
      peaks_(settings.patches.size()),
      impulses_(settings.patches.size()),
      histories_(settings.patches.size()) {
  for (const auto& record : settings.hull_maps) maps_.emplace_back(record.surface, record.size);
}

template <int d>
void HullReadings<d>::read(const FluidView<d>& fluid, const Kick& kick) {
  const double time = time_ = kick.time;
  pressures_.clear();
  for (std::size_t i = 0; i < peaks_.size(); ++i) {
    const auto& patch = settings_.patches[i];
    const int of_body = wall_called(fluid, patch.body);
    const auto at_rest = points_at_rest(fluid, of_body);
    const auto wall = as_made(fluid, of_body, at_rest, patch.pose);
    const auto mean = [&](std::span<const double> pressure) {
      return patch_force(wall, pressure, patch.region) / patch.area;
    };
    pressures_.push_back(mean(fluid.pressure()));
    peaks_[i].offer(pressures_[i], time);
    const double repair = fluid.repair_pressure().empty() ? 0.0 : mean(fluid.repair_pressure());
    impulses_[i].total += kick.length() * (pressures_[i] + repair);
    impulses_[i].repair += kick.length() * repair;
    if (histories_[i].ends.empty()) histories_[i] = {1, kick.begin, {}, {}};
    histories_[i].append(kick.end, {&pressures_[i], 1});
  }
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    const auto& record = settings_.hull_maps[i];
    const int of_body = wall_called(fluid, record.body);
    const auto at_rest = points_at_rest(fluid, of_body);
    maps_[i].add(as_made(fluid, of_body, at_rest, record.pose), fluid.pressure(), fluid.repair_pressure(), kick);
  }
}

template <int d>
void HullReadings<d>::summarise(Summary& summary) const {
  for (std::size_t i = 0; i < peaks_.size(); ++i)
    summary.patches[settings_.patches[i].name] = {.pressure = peaks_[i],
                                                  .impulse = impulses_[i].total,
                                                  .impulse_repair = impulses_[i].repair,
                                                  .area = settings_.patches[i].area,
                                                  .body = settings_.patches[i].body,
                                                  .evidence = {},
                                                  .grade = {}};
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    const auto& body = settings_.hull_maps[i].body;
    const auto& p = maps_[i].pressure();
    const auto top = static_cast<std::size_t>(std::ranges::max_element(p) - p.begin());
    if (!(maps_[i].time()[top] >= 0)) continue;  // never wet
    const Vec<d> at = maps_[i].surface().vertices.col(static_cast<Eigen::Index>(top)) + centre_of_mass(settings_, body);
    summary.bodies[body].maximum_pressure =
        MaximumPressure{{p[top], maps_[i].time()[top]}, std::vector<double>(at.data(), at.data() + d), {}};
    summary.bodies[body].maximum_pressure->evidence.step = above_neighbours<d>(maps_[i], top);
  }
}

template <int d>
bool HullReadings<d>::fits_settings() const {
  const auto fits = [](const HullMap<d>& map) {
    const auto points = static_cast<std::size_t>(map.surface().vertices.cols());
    return map.pressure().size() == points && map.time().size() == points && map.impulse().size() == points;
  };
  return peaks_.size() == settings_.patches.size() && impulses_.size() == peaks_.size() &&
         std::ranges::all_of(maps_, fits);
}

template <int d>
void HullReadings<d>::write() const {
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    const auto& record = settings_.hull_maps[i];
    auto surface = maps_[i].surface();
    const SurfaceRuler<d> ruler(record.surface, record.pose);
    std::vector<double> distance;
    for (Eigen::Index v = 0; v < surface.vertices.cols(); ++v)
      distance.push_back(ruler.distance(surface.vertices.col(v)));
    surface.vertices.colwise() += centre_of_mass(settings_, record.body);
    write_surface<d>(
        settings_.directory / ("hull_" + file_name_of(record.body) + ".vtu"), time_, surface,
        {{"p_max", maps_[i].pressure()}, {"t_max", maps_[i].time()}, {"impulse", maps_[i].impulse()}, {"s", distance}});
  }
}

template Vec<2> centre_of_mass<2>(const RecorderSettings<2>&, const std::string&);
template Vec<3> centre_of_mass<3>(const RecorderSettings<3>&, const std::string&);
template class HullReadings<2>;
template class HullReadings<3>;

}  // namespace splashdown::apps
