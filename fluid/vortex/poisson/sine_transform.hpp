// Sine transforms of rows of n - 1 numbers (DST-I), by one real Fourier transform of n numbers each (Press et al.,
// Numerical Recipes, section 12.4), and its transpose on the way back, which adds small modes first: differences of the
// result keep their digits. Modes stand in an order of their own: even ones, then odd ones.
#pragma once

#include <memory>
#include <vector>

namespace splashdown::vortex {

/// Plans of rows of one length; the same bits whenever it is made.
class SineTransform {
 public:
  explicit SineTransform(int n);  ///< even
  ~SineTransform();
  /// Takes the plans over.
  SineTransform(SineTransform&&) noexcept;
  /// The same.
  SineTransform& operator=(SineTransform&&) noexcept;

  /// Room that a thread needs [numbers].
  std::size_t room() const;
  /// The mode at each of n places: 2p at p < n/2 (none at 0), 2p + 1 at n/2 + p.
  std::vector<int> modes() const;
  /// X(k) = sum x(i) sin(pi i k/n). `row`: x(0), which is not read, to x(n - 1) on the way in, modes on the way out.
  void forward(double* row, double* room) const;
  /// x(i) = sum X(k) sin(pi i k/n): forward and back are n/2 times the row. x(0) becomes 0.
  void back(double* row, double* room) const;

 private:
  struct Plans;
  std::unique_ptr<Plans> plans_;
};

/// Room for transforms, aligned as they want it.
class TransformRoom {
 public:
  explicit TransformRoom(std::size_t numbers);  ///< count
  double* data() const { return data_.get(); }  ///< the first

 private:
  struct Free {
    void operator()(double* p) const;
  };
  std::unique_ptr<double[], Free> data_;
};

}  // namespace splashdown::vortex
