#include "fluid/vortex/poisson/convolution.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cstddef>
#include <memory>

namespace splashdown::vortex {
namespace {

struct Free {
  void operator()(double* p) const { fftw_free(p); }
};
using Aligned = std::unique_ptr<double[], Free>;

/// The next length whose only factors are 2, 3, 5 and 7, even.
int good_length(int n) {
  for (int length = n + n % 2;; length += 2) {
    int rest = length;
    for (const int factor : {2, 3, 5, 7})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return length;
  }
}

}  // namespace

struct Convolution::Plans {
  int width, height, nx, ny, pitch;
  std::size_t numbers;
  Aligned data, kernel;
  fftw_plan forward = nullptr, backward = nullptr;

  Plans(int w, int h)
      : width(w),
        height(h),
        nx(good_length(2 * w)),
        ny(good_length(2 * h)),
        pitch(2 * (nx / 2 + 1)),
        numbers(static_cast<std::size_t>(pitch) * static_cast<std::size_t>(ny)),
        data(fftw_alloc_real(numbers)),
        kernel(fftw_alloc_real(numbers)) {
    auto* spectrum = reinterpret_cast<fftw_complex*>(data.get());
    // Plans that are measured would differ from run to run, and with them the last bits.
    forward = fftw_plan_dft_r2c_2d(ny, nx, data.get(), spectrum, FFTW_ESTIMATE);
    backward = fftw_plan_dft_c2r_2d(ny, nx, spectrum, data.get(), FFTW_ESTIMATE);
  }
  Plans(const Plans&) = delete;
  Plans& operator=(const Plans&) = delete;
  ~Plans() {
    fftw_destroy_plan(forward);
    fftw_destroy_plan(backward);
  }
};

Convolution::Convolution(int width, int height, const std::function<double(int, int)>& kernel)
    : plans_(std::make_unique<Plans>(width, height)) {
  auto& p = *plans_;
  clear();
  const double scale = 1. / (static_cast<double>(p.nx) * p.ny);
  for (int n = 0; n < height; ++n)
    for (int m = 0; m < width; ++m) {
      const double value = scale * kernel(m, n);
      const int columns[] = {m, (p.nx - m) % p.nx}, rows[] = {n, (p.ny - n) % p.ny};
      for (const int i : columns)
        for (const int j : rows) data()[static_cast<std::ptrdiff_t>(j) * p.pitch + i] = value;
    }
  fftw_execute(p.forward);
  std::copy_n(data(), p.numbers, p.kernel.get());
  clear();
}

Convolution::~Convolution() = default;
Convolution::Convolution(Convolution&&) noexcept = default;
Convolution& Convolution::operator=(Convolution&&) noexcept = default;

int Convolution::width() const { return plans_->width; }
int Convolution::height() const { return plans_->height; }
int Convolution::pitch() const { return plans_->pitch; }
double* Convolution::data() { return plans_->data.get(); }
const double* Convolution::data() const { return plans_->data.get(); }
void Convolution::clear() { std::fill_n(data(), plans_->numbers, 0.0); }

void Convolution::run() {
  auto& p = *plans_;
  fftw_execute(p.forward);
  // A kernel that is even in both directions has a real spectrum.
  for (std::size_t k = 0; k < p.numbers; k += 2) {
    p.data[k] *= p.kernel[k];
    p.data[k + 1] *= p.kernel[k];
  }
  fftw_execute(p.backward);
}

}  // namespace splashdown::vortex
