// What is read off the hulls in every step: mean pressures of patches, the highest pressures all over.
#pragma once

#include "apps/record/frames/hull_map.hpp"
#include "apps/record/settings.hpp"
#include "apps/statistics/statistics.hpp"
#include "apps/statistics/statistics_archive.hpp"
#include "apps/statistics/summary.hpp"
#include "core/fluid_view.hpp"

namespace splashdown::apps {

template <int d>
class HullReadings {
 public:
  /// Keeps the reference.
  explicit HullReadings(const RecorderSettings<d>& settings);

  void read(const FluidView<d>& fluid, const Kick& kick);
  /// Of the patches, in their order, at the step read last [Pa].
  const std::vector<double>& pressures() const { return pressures_; }
  /// Of a patch, in all steps.
  const IntervalHistory& history(std::size_t patch) const { return histories_[patch]; }
  void summarise(Summary& summary) const;
  /// hull_BODY.vtu: the surface in the frame of the body's shape with p_max [Pa], t_max [s] (nan: never wet), impulse [Pa s] and
  /// s, the distance from the keel [m].
  void write() const;

  /// Whether what was loaded belongs to these patches and hulls.
  bool fits_settings() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(time_, peaks_, impulses_, histories_);
    for (auto& map : maps_) archive(map);
  }

 private:
  const RecorderSettings<d>& settings_;
  double time_ = 0;
  /// Time integrals of a patch's mean pressure [Pa s].
  struct Impulse {
    double total = 0, repair = 0;  ///< both together; of what repairs add
    template <class Archive>
    void serialize(Archive& archive) {
      archive(total, repair);
    }
  };
  std::vector<Peak> peaks_;
  std::vector<Impulse> impulses_;
  std::vector<IntervalHistory> histories_;
  std::vector<HullMap<d>> maps_;
  std::vector<double> pressures_;
};

/// Centre of mass of a body in the frame of its shape; zero for the tank.
template <int d>
Vec<d> centre_of_mass(const RecorderSettings<d>& settings, const std::string& wall);

extern template class HullReadings<2>;
extern template class HullReadings<3>;

}  // namespace splashdown::apps
