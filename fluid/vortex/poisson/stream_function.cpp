#include "fluid/vortex/poisson/stream_function.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "core/parallel.hpp"

namespace splashdown::vortex {
namespace {

constexpr std::size_t rows_a_piece = 16;

std::size_t count(int n) { return static_cast<std::size_t>(n); }

/// Eigenvalues of -d_x^2 by three points [1/m^2], and their sines.
void modes(int n, double h, std::vector<double>& lambda, std::vector<double>& sine) {
  for (int k = 1; k < n; ++k) {
    const double half = std::sin(0.5 * std::numbers::pi * k / n);
    lambda.push_back(4 * half * half / (h * h));
    sine.push_back(std::sin(std::numbers::pi * k / n));
  }
}

}  // namespace

StreamFunction::StreamFunction(const Grid& grid, SideKind sides, int order)
    : grid_(grid), transform_(grid.nx, grid.ny), order_(order) {
  if (sides == SideKind::free) far_.emplace(grid);
  sides_ = {std::vector<double>(count(grid.nx + 1)), std::vector<double>(count(grid.nx + 1)),
            std::vector<double>(count(grid.ny + 1)), std::vector<double>(count(grid.ny + 1))};
  modes(grid.nx, grid.h, lambda_x_, sine_x_);
  modes(grid.ny, grid.h, lambda_y_, sine_y_);
}

void StreamFunction::load(const NodeField& omega) {
  in_pieces(count(grid_.ny - 1), rows_a_piece, [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last; ++j) {
      const double* from = omega.data() + grid_.at(1, static_cast<int>(j) + 1);
      std::copy_n(from, count(grid_.nx - 1), transform_.data() + j * count(transform_.pitch()));
    }
  });
}

/// Transforms of what known values on the sides bring into the equations beside them, by two sines a mode.
void StreamFunction::add_sides() {
  const double scale = 2 / (grid_.h * grid_.h);
  spectra_ = sides_;
  const auto inner = [scale](std::vector<double>& side) {
    for (double& x : side) x *= scale;
    return std::span(side).subspan(1, side.size() - 2);
  };
  transform_.run_row(inner(spectra_.bottom));
  transform_.run_row(inner(spectra_.top));
  transform_.run_column(inner(spectra_.left));
  transform_.run_column(inner(spectra_.right));
}

void StreamFunction::divide(double spread) {
  const auto decay = [&](const std::vector<double>& lambda, std::vector<double>& factors) {
    factors.resize(lambda.size());
    for (std::size_t k = 0; k < lambda.size(); ++k) {
      const double fourth = order_ == 4 ? grid_.h * grid_.h / 12 * lambda[k] * lambda[k] : 0.0;
      factors[k] = std::exp(-spread * (lambda[k] + fourth));
    }
  };
  decay(lambda_x_, decay_x_);
  decay(lambda_y_, decay_y_);
  const double scale = 1. / (4. * grid_.nx * grid_.ny);
  in_pieces(lambda_y_.size(), rows_a_piece, [&](std::size_t first, std::size_t last) {
    for (std::size_t l = first; l < last; ++l) {
      double* row = transform_.data() + l * count(transform_.pitch());
      const double sign = l % 2 == 0 ? 1 : -1, left = spectra_.left[l + 1], right = spectra_.right[l + 1];
      const double bottom = sine_y_[l], top = sign * sine_y_[l];
      for (std::size_t k = 0; k < lambda_x_.size(); ++k) {
        const double parity = k % 2 == 0 ? 1 : -1;
        const double given =
            bottom * spectra_.bottom[k + 1] + top * spectra_.top[k + 1] + sine_x_[k] * (left + parity * right);
        row[k] = scale * (row[k] * decay_x_[k] * decay_y_[l] + given) / (lambda_x_[k] + lambda_y_[l]);
      }
    }
  });
}

void StreamFunction::store(NodeField& omega, NodeField& psi) const {
  psi.resize(grid_.nodes());
  const std::size_t row = count(grid_.nx + 1);
  std::ranges::copy(sides_.bottom, psi.begin());
  std::ranges::copy(sides_.top, psi.end() - static_cast<std::ptrdiff_t>(row));
  in_pieces(count(grid_.ny - 1), rows_a_piece, [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last; ++j) {
      double* to = psi.data() + (j + 1) * row;
      to[0] = sides_.left[j + 1];
      std::copy_n(transform_.data() + j * count(transform_.pitch()), count(grid_.nx - 1), to + 1);
      to[row - 1] = sides_.right[j + 1];
    }
  });
  const double scale = 1 / (grid_.h * grid_.h);
  in_pieces(count(grid_.ny - 1), rows_a_piece, [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last; ++j)
      for (std::size_t k = (j + 1) * row + 1; k < (j + 2) * row - 1; ++k)
        omega[k] = scale * (4 * psi[k] - psi[k - 1] - psi[k + 1] - psi[k - row] - psi[k + row]);
  });
}

void StreamFunction::solve(NodeField& omega, double spread, NodeField& psi) {
  if (far_) far_->evaluate(omega, sides_);
  load(omega);
  transform_.run();
  add_sides();
  divide(spread);
  transform_.run();
  store(omega, psi);
}

}  // namespace splashdown::vortex
