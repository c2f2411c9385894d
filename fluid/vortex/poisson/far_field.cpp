#include "fluid/vortex/poisson/far_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "fluid/vortex/poisson/lattice_green.hpp"
#include "fluid/vortex/transport/kernels.hpp"

namespace splashdown::vortex {
namespace {

constexpr int pad = 3;  // coarse nodes beyond the sides: of the kernel, and of the interpolation
constexpr int factor = FarField::coarsening;

/// -log(r)/(2 pi), where r is zero the mean that the lattice has.
double logarithm(int m, int n) {
  if (m == 0 && n == 0) return lattice_offset / (2 * std::numbers::pi);
  return -0.25 * std::log(static_cast<double>(m) * m + static_cast<double>(n) * n) / std::numbers::pi;
}

/// Lagrange's polynomials of the nodes -2 ... 3 at t in [0, 1).
std::array<double, 6> lagrange(double t) {
  std::array<double, 6> weights;
  for (int a = 0; a < 6; ++a) {
    double w = 1;
    for (int b = 0; b < 6; ++b)
      if (a != b) w *= (t - (b - 2)) / (a - b);
    weights[static_cast<std::size_t>(a)] = w;
  }
  return weights;
}

}  // namespace

FarField::FarField(const Grid& grid)
    : grid_(grid),
      sums_(grid.nx / factor + 1 + 2 * pad, grid.ny / factor + 1 + 2 * pad, logarithm),
      row_(static_cast<std::size_t>(sums_.width())) {}

void FarField::restrict_vorticity(const NodeField& omega) {
  std::array<std::array<double, 4>, factor> weights;
  for (int r = 0; r < factor; ++r)
    for (int k = 0; k < 4; ++k)
      weights[static_cast<std::size_t>(r)][static_cast<std::size_t>(k)] = m4(k - 1 - static_cast<double>(r) / factor);
  const double cell = grid_.h * grid_.h;
  sums_.clear();
  for (int j = 0; j <= grid_.ny; ++j) {
    std::ranges::fill(row_, 0.0);
    bool any = false;
    for (int i = 0; i <= grid_.nx; ++i) {
      const double w = omega[grid_.at(i, j)];
      if (w == 0) continue;
      any = true;
      const auto& weight = weights[static_cast<std::size_t>(i % factor)];
      double* to = row_.data() + i / factor + pad - 1;
      for (std::size_t k = 0; k < 4; ++k) to[k] += w * weight[k];
    }
    if (!any) continue;
    const auto& weight = weights[static_cast<std::size_t>(j % factor)];
    for (int k = 0; k < 4; ++k) {
      double* to = sums_.data() + static_cast<std::ptrdiff_t>(j / factor + pad - 1 + k) * sums_.pitch();
      const double share = cell * weight[static_cast<std::size_t>(k)];
      for (std::size_t i = 0; i < row_.size(); ++i) to[i] += share * row_[i];
    }
  }
}

void FarField::evaluate(const NodeField& omega, Sides& sides) {
  restrict_vorticity(omega);
  sums_.run();
  std::array<std::array<double, 6>, factor> weights;
  for (int r = 0; r < factor; ++r) weights[static_cast<std::size_t>(r)] = lagrange(static_cast<double>(r) / factor);
  const auto along = [&](int count, const double* from, std::ptrdiff_t step, std::vector<double>& side) {
    side.resize(static_cast<std::size_t>(count) + 1);
    for (int i = 0; i <= count; ++i) {
      const auto& weight = weights[static_cast<std::size_t>(i % factor)];
      double sum = 0;
      for (int k = 0; k < 6; ++k) sum += weight[static_cast<std::size_t>(k)] * from[(i / factor - 2 + k) * step];
      side[static_cast<std::size_t>(i)] = sum;
    }
  };
  const std::ptrdiff_t pitch = sums_.pitch();
  const double* corner = sums_.data() + pad * pitch + pad;
  along(grid_.nx, corner, 1, sides.bottom);
  along(grid_.nx, corner + grid_.ny / factor * pitch, 1, sides.top);
  along(grid_.ny, corner, pitch, sides.left);
  along(grid_.ny, corner + grid_.nx / factor, pitch, sides.right);
}

}  // namespace splashdown::vortex
