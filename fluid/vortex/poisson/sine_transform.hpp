// The discrete sine transform of the inner nodes of a rectangle (DST-I, its own inverse up to 4 nx ny): it makes the
// five-point Laplacian with zero on the sides diagonal. Rows and blocks of columns are transformed one by one, on all
// threads; the result does not depend on their number.
#pragma once

#include <memory>
#include <span>

namespace splashdown::vortex {

/// Holds plans and work space for one size; the same bits whenever it is made.
class SineTransform {
 public:
  SineTransform(int nx, int ny);  ///< squares in each direction: (nx - 1) (ny - 1) inner nodes
  ~SineTransform();
  /// Takes plans and work space over.
  SineTransform(SineTransform&&) noexcept;
  /// The same.
  SineTransform& operator=(SineTransform&&) noexcept;

  int pitch() const;  ///< distance of rows in `data`
  double* data();     ///< node (i, j) at (j - 1) pitch + i - 1; k of x and l of y, from 1, likewise
  void run();         ///< X(k, l) = 4 sum x(i, j) sin(pi i k / nx) sin(pi j l / ny)
  /// One side alone, in place: X(k) = 2 sum x(i) sin(pi i k / n), of n - 1 numbers where n is nx or ny.
  void run_row(std::span<double> numbers);
  void run_column(std::span<double> numbers);  ///< the same along y

 private:
  struct Plans;
  std::unique_ptr<Plans> plans_;
};

}  // namespace splashdown::vortex
