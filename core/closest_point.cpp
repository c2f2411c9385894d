#include "core/closest_point.hpp"

namespace splashdown {

Vec<3> closest_on(const std::array<Vec<3>, 3>& f, const Vec<3>& x) {
  const Vec<3> n = (f[1] - f[0]).cross(f[2] - f[0]);
  bool inside = true;
  for (int k = 0; k < 3; ++k) inside = inside && n.dot((f[(k + 1) % 3] - f[k]).cross(x - f[k])) >= 0;
  if (inside) return x - n * (n.dot(x - f[0]) / n.squaredNorm());
  Vec<3> best = f[0];
  for (int k = 0; k < 3; ++k) {
    const Vec<3> c = closest_on_segment<3>(f[k], f[(k + 1) % 3], x);
    if ((c - x).squaredNorm() < (best - x).squaredNorm()) best = c;
  }
  return best;
}

}  // namespace splashdown
