// What is read off the hulls in every step: mean pressures of patches, the highest pressures all over.
#pragma once

#include "apps/record/hull_map.hpp"
#include "apps/record/settings.hpp"
#include "apps/statistics/statistics_archive.hpp"
#include "apps/statistics/summary.hpp"
#include "fluid/view.hpp"

namespace splashdown::apps {

template <int d>
class HullReadings {
 public:
  /// Keeps the reference.
  explicit HullReadings(const RecorderSettings<d>& settings);

  void read(const fluid::View<d>& fluid, double time);
  /// Of the patches, in their order, at the step read last [Pa].
  const std::vector<double>& pressures() const { return pressures_; }
  void summarise(Summary& summary) const;
  /// hull_BODY.vtu: the surface in the frame of the body's shape with p_max [Pa], t_max [s] (nan: never wet) and s, the
  /// distance from the keel [m].
  void write() const;

  /// Whether what was loaded belongs to these patches and hulls.
  bool fits_settings() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(time_, peaks_);
    for (auto& map : maps_) archive(map);
  }

 private:
  const RecorderSettings<d>& settings_;
  double time_ = 0;
  std::vector<Peak> peaks_;
  std::vector<HullMap<d>> maps_;
  std::vector<double> pressures_;
};

/// Centre of mass of a body in the frame of its shape; zero for the tank.
template <int d>
fluid::Vec<d> centre_of_mass(const RecorderSettings<d>& settings, const std::string& wall);

extern template class HullReadings<2>;
extern template class HullReadings<3>;

}  // namespace splashdown::apps
