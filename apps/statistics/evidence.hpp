// What the steps of a run say about its peaks: how finely the hull was resolved, and how much a peak stands alone.
// Survives a resume.
//
//   elements   on half of the wetted width: N/2 of the N wetted facets in the plane; in space the c/h of a disc of radius c
//              tiled by N equilateral triangles of side h, N = pi c^2 / (sqrt(3)/4 h^2), so c/h = 0.371 sqrt(N)
//   growing    share of the wetted width that came within the half of the time since first contact before the peak, over
//              that half: min(1, 2 (1 - w(t - T/2)/w(t))) with w the wetted length, in space the root of the area; 1 for a
//              wedge or cone that enters (w ~ t), 0.6 for a round bottom (w ~ sqrt(t)), 0 for a body afloat. Of filtered
//              peaks the largest within 1/CFC, which the filter remembers
//   repair     |sum of repair load . load| / |load|^2: the part of the load that came as impulses after remeshing
//   step       peak over the straight line through the steps around it, minus 1. The line is fitted over the time in which
//              the hull sinks by an element, h/V to each side, for the mesh knows nothing shorter; at least over the steps
//              beside the peak, at most over a tenth of the time since first contact
//   sideways   load across the plane of symmetry of a symmetric scene, over the load: zero but for the mesh
//
// Filtered peaks are compared with repair and sideways loads that went through the same filter.
#pragma once

#include <optional>

#include "apps/statistics/filters.hpp"
#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

/// Of a body in one step.
struct EvidenceReading {
  std::vector<double> force, repair;  ///< components of the load and of its repair part [N, N/m]
  double facets = 0;                  ///< of the mesh, wetted by the hull
  double wetted = 0;                  ///< [m, m^2]
  double speed = 0;                   ///< of the centre of mass [m/s]
  std::vector<char> symmetric;        ///< horizontal axes along which no load may act
};

class EvidenceStatistics {
 public:
  void add(double begin, double end, const EvidenceReading& reading);
  /// About a peak of `channel`, a vector that was recorded in the same steps; `cfc`: that its peak went through.
  Evidence about(const Pulse& peak, const IntervalHistory& channel, std::optional<int> cfc) const;
  /// About a peak of pressure: without what only a load's own steps can say.
  Evidence at_pressure(double time) const;
  /// Length of the wetted facets at a time [m]; nan if dry.
  double facet_size(double time) const;
  /// The line through the steps around the peak, see above: deviation of the peak from it.
  double step_share(const IntervalHistory& channel, double time) const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(loads_, wet_, first_contact_, symmetric_);
  }

 private:
  int dimension() const { return loads_.channels / 2; }
  std::size_t step_at(double time) const;
  double wetted_length(double time) const;
  double growing(double time) const;
  /// Elements and growth.
  Evidence at(double time) const;
  /// Repair and sideways shares of loads at one instant: force components, then repair components.
  void add_shares(const double* loads, Evidence& evidence) const;

  IntervalHistory loads_;  ///< force, repair
  IntervalHistory wet_;    ///< facets, wetted, speed
  double first_contact_ = -1;
  std::vector<char> symmetric_;
};

}  // namespace splashdown::apps
