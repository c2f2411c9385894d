// What of a hull is under a level: its wet facets, what is seen of them from above, what they displace, and where they end.
#pragma once

#include <vector>

#include "apps/scene/geometry.hpp"

namespace splashdown::apps {

template <int d>
struct Immersion {
  double wetted = 0;                  ///< area of the facets below the level [m^2], in the plane length [m]
  double plan = 0;                    ///< of those that look down, seen from above [m^2, m]
  double volume = 0;                  ///< that they displace [m^3, m^2]
  rigid::Vec<d> low = {}, high = {};  ///< the ends of those facets [m]

  bool dry() const { return wetted == 0; }
  /// Of a hull whose facets are cut at the level.
  static Immersion of(const rigid::Surface<d>& hull, double level);
};

/// Immersions of one hull, looked up by depth: the level over its lowest point [m].
template <int d>
class ImmersionTable {
 public:
  explicit ImmersionTable(const rigid::Surface<d>& hull);
  /// Linear between depths that lie closer near the lowest point; of the whole hull above its top, dry at zero and below.
  Immersion<d> at(double depth) const;
  double height() const { return height_; }

 private:
  double height_ = 0;
  std::vector<Immersion<d>> at_depth_;
};

}  // namespace splashdown::apps
