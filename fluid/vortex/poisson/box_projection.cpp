#include "fluid/vortex/poisson/box_projection.hpp"

#include <cstddef>

#include "fluid/vortex/poisson/lattice_green.hpp"

namespace splashdown::vortex {

BoxProjection::BoxProjection(int width, int height) : sums_(width, height, lattice_green) {}

void BoxProjection::add(const std::vector<double>& fu, const std::vector<double>& fv, std::vector<double>& u,
                        std::vector<double>& v) {
  const auto w = static_cast<std::size_t>(sums_.width()), h = static_cast<std::size_t>(sums_.height());
  const auto pitch = static_cast<std::size_t>(sums_.pitch());
  sums_.clear();
  double* psi = sums_.data();  // lengths in squares: h cancels
  for (std::size_t j = 0; j < h; ++j)
    for (std::size_t i = 0; i < w; ++i) {
      const std::size_t k = j * w + i;
      psi[j * pitch + i] = fv[k] - (i > 0 ? fv[k - 1] : 0.0) - fu[k] + (j > 0 ? fu[k - w] : 0.0);
    }
  sums_.run();
  for (std::size_t j = 0; j < h; ++j)
    for (std::size_t i = 0; i < w; ++i) {
      const std::size_t k = j * w + i, at = j * pitch + i;
      if (j + 1 < h) u[k] += psi[at + pitch] - psi[at];
      if (i + 1 < w) v[k] -= psi[at + 1] - psi[at];
    }
}

}  // namespace splashdown::vortex
