// Running statistics of a run: peaks, impulses, accelerations. They see every step and survive a resume.
//
// Loads and accelerations are averages over the kick around t_n, [t_n - dt_{n-1}/2, t_n + dt_n/2]; impulses
// and filters use them as such, so that impulse = change of momentum holds to rounding.
#pragma once

#include <span>

#include "apps/statistics/evidence.hpp"
#include "apps/statistics/filters.hpp"
#include "apps/statistics/landing_statistics.hpp"
#include "apps/statistics/statistics_archive.hpp"
#include "core/bodies_view.hpp"
#include "core/fluid_view.hpp"

namespace splashdown::apps {

/// The kick around t_n.
struct Kick {
  double time, begin, end;
  double length() const { return end - begin; }
};

/// Peak and history of a vector channel: an acceleration, a force.
class PulseStatistics {
 public:
  void add(const Kick& kick, std::span<const double> value);
  /// Peaks in units of `unit`, changes as they are.
  PulseSummary summary(double unit = 1) const;
  const Peak& peak() const { return raw_; }
  const IntervalHistory& history() const { return history_; }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(raw_, history_);
  }

 private:
  Peak raw_;
  IntervalHistory history_;
};

/// Evidence about each peak of a channel that was recorded in the same steps.
PulseGrades evidence_of(const EvidenceStatistics& steps, const PulseSummary& pulses, const PulseStatistics& channel);

template <int d>
struct BodyReading {
  Twist<d> velocity, acceleration;
  WallLoad<d> load;
  double submergence;                    ///< of the lowest point; nan without a water level [m]
  Eigen::Matrix<double, d, d> rotation;  ///< of the shape's frame
  HullExtent extent;
  bool free;                    ///< the water moves it
  double mass = 0;              ///< [kg, kg/m]
  double facets = 0;            ///< of the mesh, wetted by it
  std::vector<char> symmetric;  ///< horizontal axes along which no load may act
};

template <int d>
class BodyStatistics {
 public:
  void add(const Kick& kick, const BodyReading<d>& reading);
  BodySummary summary() const;
  const EvidenceStatistics& evidence() const { return evidence_; }
  /// What moves as prescribed has no acceleration of its own.
  bool moves_freely() const { return mass_ != 0; }
  double peak_force() const { return force_.peak().time < 0 ? 0 : force_.peak().value; }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(acceleration_, force_, submergence_, wetted_, impulse_, impulse_repair_, landing_, evidence_, mass_,
            to_and_fro_, fastest_);
  }

 private:
  PulseStatistics acceleration_, force_;
  Peak submergence_, wetted_;
  std::array<double, d> impulse_{}, impulse_repair_{};
  double to_and_fro_ = 0;  ///< integral of the load's magnitude
  LandingStatistics<d> landing_;
  EvidenceStatistics evidence_;
  double mass_ = 0;     ///< of a free body [kg, kg/m]
  double fastest_ = 0;  ///< |V| + |w| R [m/s]
};

/// Counts of the mesh and of the coupling's passes.
struct RunStatistics {
  RangeCount nodes, elements;
  long steps = 0, passes_sum = 0;
  int passes_max = 0;

  void add_step(int passes);
  void add_mesh(std::size_t node_count, std::size_t element_count);
  template <class Archive>
  void serialize(Archive& archive) {
    archive(nodes, elements, steps, passes_sum, passes_max, mesh_seen_);
  }

 private:
  bool mesh_seen_ = false;
};

LedgerSummary summary_of(const Ledger& ledger);

}  // namespace splashdown::apps
