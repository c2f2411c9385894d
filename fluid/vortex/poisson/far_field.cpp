#include "fluid/vortex/poisson/far_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/parallel.hpp"
#include "fluid/vortex/poisson/lattice_green.hpp"
#include "fluid/vortex/transport/kernels.hpp"
#include "fluid/vortex/wide.hpp"

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

void Sides::add(double times, const Sides& others) {
  for (const auto side : {&Sides::bottom, &Sides::top, &Sides::left, &Sides::right})
    for (std::size_t i = 0; i < (this->*side).size(); ++i) (this->*side)[i] += times * (others.*side)[i];
}

FarField::FarField(const Grid& grid)
    : grid_(grid), sums_(grid.nx / factor + 1 + 2 * pad, grid.ny / factor + 1 + 2 * pad, logarithm) {}

/// Columns first, all of a row together; then the few rows that are left.
void FarField::restrict_vorticity(const NodeField& omega) {
  constexpr int reach = 2 * factor - 1;
  std::array<double, 2 * reach + 1> weights;
  for (int d = -reach; d <= reach; ++d)
    weights[static_cast<std::size_t>(d + reach)] = m4(static_cast<double>(d) / factor);
  const double cell = grid_.h * grid_.h;
  const int columns = grid_.nx / factor, rows = grid_.ny / factor;
  sums_.clear();
  std::vector<char> is_zero(static_cast<std::size_t>(grid_.ny) + 1);
  for (int j = 0; j <= grid_.ny; ++j)
    is_zero[static_cast<std::size_t>(j)] =
        all_zero(omega.data() + grid_.at(0, j), static_cast<std::size_t>(grid_.nx + 1));
  in_pieces(static_cast<std::size_t>(rows + 3), 4, [&](std::size_t first, std::size_t last) {
    std::vector<double> row(static_cast<std::size_t>(grid_.nx) + 1 + 6 * factor);
    double* sum = row.data() + 3 * factor;
    for (auto r = static_cast<int>(first) - 1; r < static_cast<int>(last) - 1; ++r) {
      std::ranges::fill(row, 0.0);
      bool any = false;
      for (int j = std::max(0, factor * r - reach); j <= std::min(grid_.ny, factor * r + reach); ++j) {
        if (is_zero[static_cast<std::size_t>(j)]) continue;
        const double* from = omega.data() + grid_.at(0, j);
        any = true;
        add_row(cell * weights[static_cast<std::size_t>(j - factor * r + reach)], from,
                static_cast<std::size_t>(grid_.nx + 1), sum);
      }
      if (!any) continue;
      double* to = sums_.data() + static_cast<std::ptrdiff_t>(r + pad) * sums_.pitch() + pad;
      for (int c = -1; c <= columns + 1; ++c) {
        const double* at = sum + factor * c;
        double total = weights[reach] * at[0];
        for (int d = 1; d <= reach; ++d) total += weights[static_cast<std::size_t>(reach + d)] * (at[d] + at[-d]);
        to[c] = total;
      }
    }
  });
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
