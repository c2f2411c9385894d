#include "core/closest_point.hpp"

#include <limits>

namespace splashdown {

Vec<3> closest_on(const std::array<Vec<3>, 3>& f, const Vec<3>& x) {
  const std::array<Vec<3>, 3> edge{f[1] - f[0], f[2] - f[1], f[0] - f[2]};
  const Vec<3> n = edge[0].cross(edge[1]);
  // Beyond an edge of those that x lies beyond.
  Vec<3> best;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    if (n.dot(edge[k].cross(x - f[k])) >= 0) continue;
    const Vec<3> c = closest_on_segment<3>(f[k], f[(k + 1) % 3], x);
    const double squared = (c - x).squaredNorm();
    if (squared < least) best = c, least = squared;
  }
  return least < std::numeric_limits<double>::infinity() ? best : Vec<3>(x - n * (n.dot(x - f[0]) / n.squaredNorm()));
}

}  // namespace splashdown
