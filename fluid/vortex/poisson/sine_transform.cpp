#include "fluid/vortex/poisson/sine_transform.hpp"

#include <fftw3.h>

#include <cmath>
#include <cstddef>
#include <numbers>

#include "fluid/vortex/wide.hpp"

namespace splashdown::vortex {
namespace {

/// y(j) = s(j) (x(j) + x(n - j)) + (x(j) - x(n - j))/2, 0 < j < n.
SPLASHDOWN_WIDE void fold(const double* __restrict x, const double* __restrict sines, std::size_t n,
                          double* __restrict y) {
  for (std::size_t j = 1; j < n; ++j) y[j] = sines[j] * (x[j] + x[n - j]) + 0.5 * (x[j] - x[n - j]);
}

}  // namespace

void TransformRoom::Free::operator()(double* p) const { fftw_free(p); }
TransformRoom::TransformRoom(std::size_t numbers) : data_(fftw_alloc_real(numbers)) {}

struct SineTransform::Plans {
  std::size_t n, line;
  std::vector<double> sines;
  fftw_plan forward = nullptr, back = nullptr;

  explicit Plans(int length) : n(static_cast<std::size_t>(length)), line((n + 2 + 7) / 8 * 8), sines(n) {
    for (std::size_t j = 0; j < n; ++j)
      sines[j] = std::sin(std::numbers::pi * static_cast<double>(j) / static_cast<double>(n));
    TransformRoom room(2 * line);
    auto* spectrum = reinterpret_cast<fftw_complex*>(room.data() + line);
    // Plans that are measured would differ from run to run, and with them the last bits.
    forward = fftw_plan_dft_r2c_1d(length, room.data(), spectrum, FFTW_ESTIMATE);
    back = fftw_plan_dft_c2r_1d(length, spectrum, room.data(), FFTW_ESTIMATE);
  }
  Plans(const Plans&) = delete;
  Plans& operator=(const Plans&) = delete;
  ~Plans() {
    fftw_destroy_plan(forward);
    fftw_destroy_plan(back);
  }
};

SineTransform::SineTransform(int n) : plans_(std::make_unique<Plans>(n)) {}
SineTransform::~SineTransform() = default;
SineTransform::SineTransform(SineTransform&&) noexcept = default;
SineTransform& SineTransform::operator=(SineTransform&&) noexcept = default;

std::size_t SineTransform::room() const { return 2 * plans_->line; }

std::vector<int> SineTransform::modes() const {
  const int half = static_cast<int>(plans_->n) / 2;
  std::vector<int> modes;
  for (int p = 0; p < half; ++p) modes.push_back(2 * p);
  for (int p = 0; p < half; ++p) modes.push_back(2 * p + 1);
  return modes;
}

void SineTransform::forward(double* row, double* room) const {
  const auto& p = *plans_;
  double *y = room, *spectrum = room + p.line;
  y[0] = 0;
  fold(row, p.sines.data(), p.n, y);
  fftw_execute_dft_r2c(p.forward, y, reinterpret_cast<fftw_complex*>(spectrum));
  double *even = row, *odd = row + p.n / 2, sum = 0.5 * spectrum[0];
  even[0] = 0;
  odd[0] = sum;
  for (std::size_t k = 1; k < p.n / 2; ++k) {
    even[k] = -spectrum[2 * k + 1];
    odd[k] = sum += spectrum[2 * k];
  }
}

void SineTransform::back(double* row, double* room) const {
  const auto& p = *plans_;
  double *y = room, *spectrum = room + p.line, sum = 0;
  const double *even = row, *odd = row + p.n / 2;
  spectrum[p.n] = spectrum[p.n + 1] = 0;
  for (std::size_t k = p.n / 2 - 1; k > 0; --k) {
    sum += odd[k];
    spectrum[2 * k] = 0.5 * sum;
    spectrum[2 * k + 1] = -0.5 * even[k];
  }
  spectrum[0] = 0.5 * (odd[0] + sum);
  spectrum[1] = 0;
  fftw_execute_dft_c2r(p.back, reinterpret_cast<fftw_complex*>(spectrum), y);
  row[0] = 0;
  fold(y, p.sines.data(), p.n, row);
}

}  // namespace splashdown::vortex
