#include "fluid/vortex/poisson/sine_transform.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cstddef>

#include "core/parallel.hpp"

namespace splashdown::vortex {
namespace {

struct FreeNumbers {
  void operator()(double* p) const { fftw_free(p); }
};

constexpr int block = 8;  // columns at a time: a line of the cache

}  // namespace

struct SineTransform::Plans {
  int nx, ny, pitch;
  std::unique_ptr<double[], FreeNumbers> data, line;
  fftw_plan row = nullptr, columns = nullptr, side_x = nullptr, side_y = nullptr;

  Plans(int nx_, int ny_)
      : nx(nx_),
        ny(ny_),
        pitch((nx - 1 + block - 1) / block * block),
        data(fftw_alloc_real(static_cast<std::size_t>(pitch) * static_cast<std::size_t>(ny))),
        line(fftw_alloc_real(static_cast<std::size_t>(std::max(nx, ny)))) {
    std::fill_n(data.get(), static_cast<std::size_t>(pitch) * static_cast<std::size_t>(ny), 0.0);
    const int along_x = nx - 1, along_y = ny - 1;
    const fftw_r2r_kind kind = FFTW_RODFT00;
    // Plans that are measured would differ from run to run, and with them the last bits.
    row = fftw_plan_many_r2r(1, &along_x, 1, data.get(), nullptr, 1, pitch, data.get(), nullptr, 1, pitch, &kind,
                             FFTW_ESTIMATE);
    columns = fftw_plan_many_r2r(1, &along_y, block, data.get(), nullptr, pitch, 1, data.get(), nullptr, pitch, 1,
                                 &kind, FFTW_ESTIMATE);
    side_x = fftw_plan_r2r_1d(along_x, line.get(), line.get(), kind, FFTW_ESTIMATE);
    side_y = fftw_plan_r2r_1d(along_y, line.get(), line.get(), kind, FFTW_ESTIMATE);
  }
  Plans(const Plans&) = delete;
  Plans& operator=(const Plans&) = delete;
  ~Plans() {
    for (const auto plan : {row, columns, side_x, side_y}) fftw_destroy_plan(plan);
  }
  void side(fftw_plan plan, std::span<double> numbers) {
    std::ranges::copy(numbers, line.get());
    fftw_execute(plan);
    std::copy_n(line.get(), numbers.size(), numbers.begin());
  }
};

SineTransform::SineTransform(int nx, int ny) : plans_(std::make_unique<Plans>(nx, ny)) {}
SineTransform::~SineTransform() = default;
SineTransform::SineTransform(SineTransform&&) noexcept = default;
SineTransform& SineTransform::operator=(SineTransform&&) noexcept = default;

int SineTransform::pitch() const { return plans_->pitch; }
double* SineTransform::data() { return plans_->data.get(); }

void SineTransform::run() {
  auto& p = *plans_;
  in_pieces(static_cast<std::size_t>(p.ny - 1), 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last; ++j) {
      double* at = p.data.get() + j * static_cast<std::size_t>(p.pitch);
      fftw_execute_r2r(p.row, at, at);
    }
  });
  in_pieces(static_cast<std::size_t>(p.pitch / block), 4, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b) {
      double* at = p.data.get() + b * block;
      fftw_execute_r2r(p.columns, at, at);
    }
  });
}

void SineTransform::run_row(std::span<double> numbers) { plans_->side(plans_->side_x, numbers); }
void SineTransform::run_column(std::span<double> numbers) { plans_->side(plans_->side_y, numbers); }

}  // namespace splashdown::vortex
