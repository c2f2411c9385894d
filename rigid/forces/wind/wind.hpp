// The wind: a velocity of the air at a place and an instant.
//
//   u(x, t) = u_ref f(z) + u_gust (1 - cos(2 pi (t - t_0)/T))/2,   f = 1 or ln(z/z_0)/ln(z_ref/z_0)
//
// z: height over the surface, along the last axis. Logarithmic profile of a neutral boundary layer (von Karman 1930; Prandtl
// 1932), zero below z_0; gust from t_0 to t_0 + T, the discrete 1-cos gust of airworthiness rules (Hoblit 1988).
#pragma once

#include "rigid/types.hpp"

namespace splashdown::rigid {

/// Of the air, world frame.
template <int d>
struct Wind {
  Vec<d> velocity = Vec<d>::Zero();  ///< u_ref [m/s]
  double roughness = 0;              ///< z_0 [m]; 0: uniform
  double height = 10;                ///< z_ref [m]
  double level = 0;                  ///< of the surface, in the world [m]
  Vec<d> gust = Vec<d>::Zero();      ///< u_gust [m/s]
  double gust_start = 0;             ///< t_0 [s]
  double gust_duration = 1;          ///< T [s]

  Vec<d> at(const Vec<d>& x, double t) const;  ///< velocity [m/s]
};

extern template struct Wind<2>;
extern template struct Wind<3>;

}  // namespace splashdown::rigid
