#include "fluid/vortex/poisson/stream_function.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/parallel.hpp"
#include "fluid/vortex/wide.hpp"

namespace splashdown::vortex {
namespace {

constexpr std::size_t rows_a_piece = 16, modes_a_chain = 64;

SPLASHDOWN_WIDE void weigh(double scale, std::size_t count, double* __restrict row) {
  for (std::size_t i = 0; i < count; ++i) row[i] *= scale;
}
/// row = factor (row + below).
SPLASHDOWN_WIDE void eliminate(const double* __restrict factor, const double* __restrict below, std::size_t count,
                               double* __restrict row) {
  for (std::size_t i = 0; i < count; ++i) row[i] = factor[i] * (row[i] + below[i]);
}
/// row += factor above.
SPLASHDOWN_WIDE void substitute(const double* __restrict factor, const double* __restrict above, std::size_t count,
                                double* __restrict row) {
  for (std::size_t i = 0; i < count; ++i) row[i] += factor[i] * above[i];
}

}  // namespace

StreamFunction::StreamFunction(const Grid& grid, SideKind sides) : grid_(grid), transform_(grid.nx) {
  if (sides == SideKind::free) far_.emplace(grid);
  const auto nx = static_cast<std::size_t>(grid.nx), ny = static_cast<std::size_t>(grid.ny);
  sides_ = {std::vector<double>(nx + 1), std::vector<double>(nx + 1), std::vector<double>(ny + 1),
            std::vector<double>(ny + 1)};
  std::vector<double> lambda;  // h^2 times eigenvalues of -d_x^2 by three points
  for (const int k : transform_.modes()) {
    const double half = std::sin(0.5 * std::numbers::pi * k / grid.nx);
    lambda.push_back(4 * half * half);
  }
  for (std::size_t first = 0; first < nx; first += modes_a_chain)
    add_chain(first, std::min(modes_a_chain, nx - first), lambda);
}

void StreamFunction::add_chain(std::size_t first, std::size_t count, const std::vector<double>& lambda) {
  Chain chain{first, count, 0, {}};
  std::vector<double> last(count, 0.0);
  double change = 1;
  while (change > 2 * std::numeric_limits<double>::epsilon() && chain.rows < static_cast<std::size_t>(grid_.ny)) {
    change = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const double factor = 1 / (2 + lambda[first + k] - last[k]);
      change = std::max(change, std::abs(factor - last[k]));
      last[k] = factor;
    }
    chain.factors.insert(chain.factors.end(), last.begin(), last.end());
    ++chain.rows;
  }
  chains_.push_back(std::move(chain));
}

/// Modes of rows 1 ... ny - 1 of psi, in place.
void StreamFunction::solve_chain(const Chain& chain, NodeField& psi) const {
  const auto n = static_cast<std::size_t>(grid_.nx + 1), ny = static_cast<std::size_t>(grid_.ny);
  const auto factors = [&](std::size_t j) {
    return chain.factors.data() + std::min(j, chain.rows) * chain.count - chain.count;
  };
  const std::vector<double> zero(chain.count, 0.0);
  double* row = psi.data() + chain.first;
  eliminate(factors(1), zero.data(), chain.count, row + n);
  for (std::size_t j = 2; j < ny; ++j) eliminate(factors(j), row + (j - 1) * n, chain.count, row + j * n);
  for (std::size_t j = ny - 2; j > 0; --j) substitute(factors(j), row + (j + 1) * n, chain.count, row + j * n);
}

void StreamFunction::solve(NodeField& psi, const Sides* beyond) {
  if (far_) far_->evaluate(psi, sides_);
  if (far_ && beyond) sides_.add(1, *beyond);
  const auto n = static_cast<std::size_t>(grid_.nx + 1), ny = static_cast<std::size_t>(grid_.ny);
  // What sides give to their neighbours' equations; sums of rows there and back are nx/2 of themselves.
  const double scale = 2. / grid_.nx, square = scale * grid_.h * grid_.h;
  in_pieces(ny - 1, rows_a_piece, [&](std::size_t first, std::size_t last) {
    TransformRoom room(transform_.room());
    for (std::size_t j = first + 1; j < last + 1; ++j) {
      double* row = psi.data() + j * n;
      weigh(square, n, row);
      row[1] += scale * sides_.left[j];
      row[n - 2] += scale * sides_.right[j];
      if (j == 1) add_row(scale, sides_.bottom.data(), n, row);
      if (j == ny - 1) add_row(scale, sides_.top.data(), n, row);
      transform_.forward(row, room.data());
    }
  });
  in_pieces(chains_.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c) solve_chain(chains_[c], psi);
  });
  std::ranges::copy(sides_.bottom, psi.begin());
  std::ranges::copy(sides_.top, psi.end() - static_cast<std::ptrdiff_t>(n));
  in_pieces(ny - 1, rows_a_piece, [&](std::size_t first, std::size_t last) {
    TransformRoom room(transform_.room());
    for (std::size_t j = first + 1; j < last + 1; ++j) {
      double* row = psi.data() + j * n;
      transform_.back(row, room.data());
      row[0] = sides_.left[j];
      row[n - 1] = sides_.right[j];
    }
  });
}

}  // namespace splashdown::vortex
