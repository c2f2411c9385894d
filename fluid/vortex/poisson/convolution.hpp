// Sums over a rectangle of nodes with a kernel of differences, psi(i, j) = sum G(i - k, j - l) w(k, l), by one pair
// of Fourier transforms of the doubled rectangle (Hockney & Eastwood, Computer Simulation Using Particles, 1981,
// section 6-5-4). Exact.
#pragma once

#include <functional>
#include <memory>

namespace splashdown::vortex {

/// Holds plans and work space for one size; the same bits whenever it is made.
class Convolution {
 public:
  /// `width` x `height` nodes; `kernel(m, n)` for 0 <= m < width, 0 <= n < height, even in both.
  Convolution(int width, int height, const std::function<double(int, int)>& kernel);
  ~Convolution();
  /// Takes plans and work space over.
  Convolution(Convolution&&) noexcept;
  /// The same.
  Convolution& operator=(Convolution&&) noexcept;

  int width() const;   ///< nodes along x
  int height() const;  ///< nodes along y
  int pitch() const;   ///< distance of rows in `data`
  double* data();      ///< node (i, j) at j pitch + i
  /// The same, to be read.
  const double* data() const;
  void clear();  ///< all zero: has to be called before sources are written
  void run();    ///< sources in `data` become sums

 private:
  struct Plans;
  std::unique_ptr<Plans> plans_;
};

}  // namespace splashdown::vortex
