// The highest pressure that each part of a hull has seen in a run, and when, and the impulse that it got.
//
// The hull's surface is divided until no edge is longer than asked for; its vertices are the points. In each step a
// wetted facet of the fluid gives its linear pressure to the points that lie on it: whose foot on the facet's plane is
// inside it, nearer than half of its size, where the hull faces the same way. Cost: that of the wetted facets.
// The highest is that of the physical pressure: in the step of a true impact the repair impulse is not part of it. The impulse, the
// time integral, has both.
#pragma once

#include <cereal/types/vector.hpp>
#include <memory>
#include <string>
#include <vector>

#include "apps/record/wall_facets.hpp"
#include "apps/statistics/statistics.hpp"

namespace splashdown::apps {

/// The surface with its longer edges halved until there are none; neighbours stay neighbours.
template <int d>
Surface<d> refined(Surface<d> surface, double longest);

template <int d>
class HullMap {
 public:
  HullMap(const Surface<d>& surface_in_wall_frame, double size);
  ~HullMap();
  HullMap(HullMap&&) noexcept;

  /// `repair`: mean over the kick of what the repair impulse adds [Pa]; empty where there is none.
  void add(const WallFacets<d>& wall, std::span<const double> pressure, std::span<const double> repair,
           const Kick& kick);
  const Surface<d>& surface() const { return surface_; }
  const std::vector<double>& pressure() const { return pressure_; }  ///< [Pa]; 0 where never wetted
  const std::vector<double>& time() const { return time_; }          ///< [s]; nan where never wetted
  const std::vector<double>& impulse() const { return impulse_; }    ///< of both, over the run [Pa s]

  /// The points follow from surface and size: only what was seen is state.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(pressure_, time_, impulse_);
  }

 private:
  class Locator;
  Surface<d> surface_;
  std::vector<Vec<d>> normal_;  ///< at the points, out of the body
  std::vector<double> pressure_, time_, impulse_;
  std::vector<char> wet_;  // in this step
  std::unique_ptr<Locator> locator_;
};

extern template class HullMap<2>;
extern template class HullMap<3>;

}  // namespace splashdown::apps
