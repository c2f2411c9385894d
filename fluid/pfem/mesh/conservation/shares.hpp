// Where on its surface water gets back what it has lost: by the least change of equal shares that leaves its centre of mass where
// it was.
//
//   w_i = exp(a . y_i) sum r / sum r_i exp(a . y_i),   y_i = (x_i - x_0) / L,
//   a: the minimum of  log sum r_i exp(a . y_i) + e |a|^2 / 2
//
// r_i is the volume by which the surface around x_i grows with a share of one, x_0 where the volume was lost, the nearest
// place in the box around the surface, L the box's diagonal. At the minimum sum w_i r_i y_i / sum r_i = -e a: the mean place
// of what comes back is x_0, as far as the surface reaches; e bounds a where it does not. Of all positive shares with that
// mean these are nearest to equal ones (Jaynes 1957, Phys. Rev. 106, 620: maximum entropy). Newton's method, O(surface).
#pragma once

#include <span>
#include <vector>

#include "fluid/pfem/types.hpp"

namespace splashdown::fluid {

/// A place of the free surface.
template <int d>
struct SurfacePlace {
  Vec<d> x;     ///< world frame [m]
  double room;  ///< r_i [m^d]
};

/// w_i of these places; one with less than two of them. `lost_at`: any place.
template <int d>
std::vector<double> shares_about(const Vec<d>& lost_at, std::span<const SurfacePlace<d>> places);

extern template std::vector<double> shares_about(const Vec<2>&, std::span<const SurfacePlace<2>>);
extern template std::vector<double> shares_about(const Vec<3>&, std::span<const SurfacePlace<3>>);

}  // namespace splashdown::fluid
