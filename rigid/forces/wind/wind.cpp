#include "rigid/forces/wind/wind.hpp"

#include <cmath>
#include <numbers>

namespace splashdown::rigid {

template <int d>
Vec<d> Wind<d>::at(const Vec<d>& x, double t) const {
  Vec<d> u = velocity;
  if (roughness > 0) {
    const double z = x[d - 1] - level;
    u *= z > roughness ? std::log(z / roughness) / std::log(height / roughness) : 0;
  }
  const double since = t - gust_start;
  if (since > 0 && since < gust_duration) u += (1 - std::cos(2 * std::numbers::pi * since / gust_duration)) / 2 * gust;
  return u;
}

template struct Wind<2>;
template struct Wind<3>;

}  // namespace splashdown::rigid
