#include "fluid/vortex/poisson/convolution.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/parallel.hpp"
#include "fluid/vortex/poisson/sine_transform.hpp"
#include "fluid/vortex/wide.hpp"

namespace splashdown::vortex {
namespace {

constexpr int group = 8;  // columns that are transformed together
constexpr std::size_t line = 2 * group;

/// The next length whose only factors are 2, 3, 5 and 7, even.
int good_length(int n) {
  for (int length = n + n % 2;; length += 2) {
    int rest = length;
    for (const int factor : {2, 3, 5, 7})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return length;
  }
}

std::size_t count(int n) { return static_cast<std::size_t>(n); }

/// Complex numbers times real ones, one after another.
SPLASHDOWN_WIDE void multiply(const double* __restrict kernel, std::size_t numbers, double* __restrict spectrum) {
  for (std::size_t k = 0; k < numbers; ++k) {
    spectrum[2 * k] *= kernel[k];
    spectrum[2 * k + 1] *= kernel[k];
  }
}

fftw_complex* complex(double* numbers) { return reinterpret_cast<fftw_complex*>(numbers); }

}  // namespace

/// Rows beyond the sources are zero, and those beyond the sums are not needed: neither is transformed along x. Columns
/// go there and back in groups that stay in the cache.
struct Convolution::Plans {
  int width, height, nx, ny, groups, pitch;
  TransformRoom data;
  std::vector<double> kernel;  // of each group, row by row
  fftw_plan row_forward = nullptr, row_back = nullptr, column_forward = nullptr, column_back = nullptr;

  Plans(int w, int h)
      : width(w),
        height(h),
        nx(good_length(2 * w)),
        ny(good_length(2 * h)),
        groups((nx / 2 + 1 + group - 1) / group),
        pitch(groups * static_cast<int>(line)),
        data(count(pitch) * count(h)),
        kernel(count(groups * group) * count(ny)) {
    std::fill_n(data.data(), count(pitch) * count(h), 0.0);
    TransformRoom room(line * count(ny));
    // Plans that are measured would differ from run to run, and with them the last bits.
    row_forward = fftw_plan_dft_r2c_1d(nx, data.data(), complex(data.data()), FFTW_ESTIMATE);
    row_back = fftw_plan_dft_c2r_1d(nx, complex(data.data()), data.data(), FFTW_ESTIMATE);
    const auto plan = [&](int sign) {
      return fftw_plan_many_dft(1, &ny, group, complex(room.data()), nullptr, group, 1, complex(room.data()), nullptr,
                                group, 1, sign, FFTW_ESTIMATE);
    };
    column_forward = plan(FFTW_FORWARD);
    column_back = plan(FFTW_BACKWARD);
  }
  Plans(const Plans&) = delete;
  Plans& operator=(const Plans&) = delete;
  ~Plans() {
    for (const auto plan : {row_forward, row_back, column_forward, column_back}) fftw_destroy_plan(plan);
  }
  double* row(std::size_t j) { return data.data() + j * count(pitch); }

  void set(const std::function<double(int, int)>& values) {
    const std::size_t length = 2 * count(nx / 2 + 1);
    TransformRoom all(length * count(ny));
    std::fill_n(all.data(), length * count(ny), 0.0);
    const fftw_plan plan = fftw_plan_dft_r2c_2d(ny, nx, all.data(), complex(all.data()), FFTW_ESTIMATE);
    const double scale = 1. / (static_cast<double>(nx) * ny);
    for (int n = 0; n < height; ++n)
      for (int m = 0; m < width; ++m) {
        const double value = scale * values(m, n);
        for (const int i : {m, (nx - m) % nx})
          for (const int j : {n, (ny - n) % ny}) all.data()[count(j) * length + count(i)] = value;
      }
    fftw_execute(plan);
    fftw_destroy_plan(plan);
    // A kernel that is even in both directions has a real spectrum.
    for (int k = 0; k <= nx / 2; ++k)
      for (int l = 0; l < ny; ++l)
        kernel[count((k / group * ny + l) * group + k % group)] = all.data()[count(l) * length + 2 * count(k)];
  }
  void rows_forward() {
    in_pieces(count(height), 16, [&](std::size_t first, std::size_t last) {
      for (std::size_t j = first; j < last; ++j) {
        std::fill(row(j) + width, row(j) + pitch, 0.0);
        fftw_execute_dft_r2c(row_forward, row(j), complex(row(j)));
      }
    });
  }
  void columns() {
    const std::size_t given = count(height), numbers = line * count(ny);
    in_pieces(count(groups), 2, [&](std::size_t first, std::size_t last) {
      TransformRoom room(numbers);
      for (std::size_t g = first; g < last; ++g) {
        for (std::size_t j = 0; j < given; ++j) std::copy_n(row(j) + g * line, line, room.data() + j * line);
        std::fill(room.data() + given * line, room.data() + numbers, 0.0);
        fftw_execute_dft(column_forward, complex(room.data()), complex(room.data()));
        multiply(kernel.data() + g * numbers / 2, numbers / 2, room.data());
        fftw_execute_dft(column_back, complex(room.data()), complex(room.data()));
        for (std::size_t j = 0; j < given; ++j) std::copy_n(room.data() + j * line, line, row(j) + g * line);
      }
    });
  }
  void rows_back() {
    in_pieces(count(height), 16, [&](std::size_t first, std::size_t last) {
      for (std::size_t j = first; j < last; ++j) fftw_execute_dft_c2r(row_back, complex(row(j)), row(j));
    });
  }
};

Convolution::Convolution(int width, int height, const std::function<double(int, int)>& kernel)
    : plans_(std::make_unique<Plans>(width, height)) {
  plans_->set(kernel);
}

Convolution::~Convolution() = default;
Convolution::Convolution(Convolution&&) noexcept = default;
Convolution& Convolution::operator=(Convolution&&) noexcept = default;

int Convolution::width() const { return plans_->width; }
int Convolution::height() const { return plans_->height; }
int Convolution::pitch() const { return plans_->pitch; }
double* Convolution::data() { return plans_->data.data(); }
const double* Convolution::data() const { return plans_->data.data(); }
void Convolution::clear() { std::fill_n(data(), count(plans_->pitch) * count(plans_->height), 0.0); }

void Convolution::run() {
  plans_->rows_forward();
  plans_->columns();
  plans_->rows_back();
}

}  // namespace splashdown::vortex
