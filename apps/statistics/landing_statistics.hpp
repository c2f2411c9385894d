// What became of a body on the water: attitude, capsized or not, at rest or not, skips. Survives a resume.
//
//   dry interval  wetted = 0 after first contact; it begins with the first dry step and ends with the next wet one
//   capsized      tilt (attitude.hpp) above 90 degrees at the end of the record; since when
//   settled       |V_up| + |w_h| R < 0.02 sqrt(g0 L) from some time after first contact until the end of the record, and
//                 for 2 pi sqrt(L / g0) at least. V_up: vertical velocity of the centre of mass, w_h: horizontal part
//                 of the angular velocity (2D: all of it), R: distance of the farthest vertex from the centre of mass,
//                 L: longest side of the hull's box, g0 = 9.80665 m/s^2
//
// The sum bounds the speed of every point of the hull in heave, roll and pitch, the motions that float to a rest. Drift and
// yaw have no position of rest and do not count. The waiting time is the period of heave of a box of draft L
// (Newman 1977, Marine Hydrodynamics, without added mass): a body at the turning point of its swing is not at rest.
#pragma once

#include "apps/statistics/attitude.hpp"
#include "apps/statistics/statistics_archive.hpp"
#include "apps/statistics/summary.hpp"

namespace splashdown::apps {

/// Of the hull: see R and L above [m].
struct HullExtent {
  double reach = 0, length = 0;
};
template <int d>
HullExtent extent_of(const Surface<d>& surface_in_body_frame);

template <int d>
struct LandingReading {
  Eigen::Matrix<double, d, d> rotation;                      ///< of the shape's frame
  Twist<d> velocity;                                         ///< at t_n
  double wetted = 0;                                         ///< [m, m^2]
  bool free = true;                                          ///< a body that the water moves
  double height = std::numeric_limits<double>::quiet_NaN();  ///< of the lowest point above the water's level [m]
};

template <int d>
class LandingStatistics {
 public:
  void add(double time, const LandingReading<d>& reading, const HullExtent& extent);
  LandingSummary summary() const;
  /// Without jumps by whole turns [deg].
  const Angles& attitude() const { return now_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(begun_, time_, first_contact_, now_, lowest_, highest_, tilt_, over_since_, dry_, calm_since_, free_,
            settled_below_, settled_window_, height_, sinking_);
  }

 private:
  bool begun_ = false, free_ = true;
  double time_ = 0, first_contact_ = -1;
  Angles now_{};
  std::array<Peak, 3> lowest_, highest_;      ///< of the angles since first contact [deg]; lowest with reversed sign
  Peak tilt_;                                 ///< since first contact [deg]
  double over_since_ = -1, calm_since_ = -1;  ///< negative: not now
  std::vector<std::array<double, 2>> dry_;    ///< [s]; end negative: still dry
  double settled_below_ = 0, settled_window_ = 0;
  double height_ = std::numeric_limits<double>::quiet_NaN(), sinking_ = 0;
};

}  // namespace splashdown::apps
