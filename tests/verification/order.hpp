// Measured orders of convergence.
#pragma once

#include <cmath>
#include <span>

namespace splashdown {

/// Slope of log(error) over log(h) by least squares.
inline double order_of(std::span<const double> h, std::span<const double> error) {
  const double n = static_cast<double>(h.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < h.size(); ++i) {
    const double x = std::log(h[i]), y = std::log(std::abs(error[i]));
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace splashdown
