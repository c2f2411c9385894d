// Readings of a fluid at lines and walls, from its points and boundary (core/fluid_view.hpp).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "apps/record/wall_facets.hpp"
#include "apps/scene/patch_region.hpp"

namespace splashdown::apps {

/// Height of the highest free-surface facet over a horizontal position; nothing where there is none.
template <int d>
std::optional<double> surface_elevation(std::span<const Vec<d>> points, std::span<const Facet<d>> boundary,
                                        const Eigen::Matrix<double, d - 1, 1>& at);

/// Pressure at the point of the walls' wetted facets that is nearest to `point`, if it is not farther away
/// than half that facet: walls are faceted finer or coarser than the fluid, so that a sensor on a wall may
/// lie outside every cell.
template <int d>
std::optional<double> wall_pressure(std::span<const Vec<d>> points, std::span<const Facet<d>> boundary,
                                    std::span<const double> pressure, const Vec<d>& point);

/// Force of the pressure on the region's part of a wall [N/m, N]. Dry parts have no pressure.
template <int d>
double patch_force(const WallFacets<d>& wall, std::span<const double> pressure, const PatchRegion<d>& region);

template <int d>
struct SurfacePressurePoint {
  Vec<d> x;         ///< world frame [m]
  double s;         ///< distance from the keel [m]; in 2D along the outline, counter-clockwise positive
  double p;         ///< [Pa]
  double p_repair;  ///< mean over the kick of what the repair impulse adds [Pa]
  Vec<d> on_wall;   ///< wall frame; of a wall that deforms its place at t = 0, world frame [m]
};

/// Measures distances along a wall's surface from its keel: the lowest point, in the middle of the lowest
/// edge where that is level.
template <int d>
class SurfaceRuler {
 public:
  /// `initial`: the pose that decides what is lowest.
  SurfaceRuler(const Surface<d>& surface, const Isometry<d>& initial);
  /// In 3D the straight distance from the keel.
  double distance(const Vec<d>& point_in_wall_frame) const;

 private:
  Surface<d> surface_;
  std::vector<double> start_;  ///< of each facet along the outline (2D)
  double length_ = 0;
  double keel_ = 0;
  double orientation_ = 1;
  Vec<d> keel_point_;
};

/// Points of the wetted facets of a wall, ordered by s. `repair`: empty where there is none. `at_rest`: of a wall that deforms,
/// where the fluid's points on it were at t = 0, world frame, as the ruler's surface is; empty: of a rigid wall.
template <int d>
std::vector<SurfacePressurePoint<d>> surface_pressure(const WallFacets<d>& wall, std::span<const double> pressure,
                                                      std::span<const double> repair, const SurfaceRuler<d>& ruler,
                                                      std::span<const Vec<d>> at_rest = {});

}  // namespace splashdown::apps
