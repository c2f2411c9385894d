#include "fluid/vortex/transport/diffusion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/parallel.hpp"
#include "fluid/vortex/wide.hpp"

namespace splashdown::vortex {
namespace {

constexpr double left_out = 1e-13;   // of a sum
constexpr int widest_kernel = 13;    // less than the smallest grid
constexpr double most_spread = 0.3;  // of h^2, at which that many are enough

/// to = c from.
SPLASHDOWN_WIDE void scale_row(double c, const double* __restrict from, std::size_t count, double* __restrict to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = c * from[i];
}

/// to = c here + a (one + two).
SPLASHDOWN_WIDE void weigh_three(double c, const double* __restrict here, double a, const double* __restrict one,
                                 const double* __restrict two, std::size_t count, double* __restrict to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = c * here[i] + a * (one[i] + two[i]);
}

/// to += a (one + two) + b (three + four).
SPLASHDOWN_WIDE void add_pairs(double a, const double* __restrict one, const double* __restrict two, double b,
                               const double* __restrict three, const double* __restrict four, std::size_t count,
                               double* __restrict to) {
  for (std::size_t i = 0; i < count; ++i) to[i] += a * (one[i] + two[i]) + b * (three[i] + four[i]);
}

SPLASHDOWN_WIDE void drop_small(double nothing, std::size_t count, double* __restrict to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = std::abs(to[i]) < nothing ? 0.0 : to[i];
}

}  // namespace

void Diffusion::prepare(double spread) {
  const double share = spread / (grid_.h * grid_.h);
  pieces_ = std::max(1, static_cast<int>(std::ceil(share / most_spread)));
  prepared_ = spread;
  constexpr int samples = 64;
  kernel_.clear();
  double rest = 1;
  for (int n = 0; n <= widest_kernel && std::abs(rest) > left_out; ++n) {
    double sum = 0;
    for (int k = 0; k < samples; ++k) {
      const double angle = 2 * std::numbers::pi * k / samples, half = std::sin(0.5 * angle), lambda = 4 * half * half;
      const double fourth = order_ == 4 ? lambda * lambda / 12 : 0;
      sum += std::exp(-share / pieces_ * (lambda + fourth)) * std::cos(n * angle);
    }
    kernel_.push_back(sum / samples);
    rest -= (n == 0 ? 1 : 2) * kernel_.back();
  }
  kernel_[0] += rest;                                   // what was cut off stays where it was
  if (kernel_.size() % 2 != 0) kernel_.push_back(0.0);  // pairs
}

/// From the field to along_x_, rows without vorticity apart.
void Diffusion::along_x(const NodeField& omega) {
  const auto n = static_cast<std::size_t>(grid_.nx + 1), inner = n - 2, reach = kernel_.size() - 1;
  in_pieces(static_cast<std::size_t>(grid_.ny - 1), 16, [&](std::size_t first, std::size_t last) {
    std::vector<double> row(n + 2 * reach);
    for (std::size_t j = first + 1; j < last + 1; ++j) {
      const double* from = omega.data() + j * n;
      is_zero_[j] = all_zero(from + 1, inner) ? 1 : 0;
      if (is_zero_[j]) continue;
      double* w = row.data() + reach;  // odd about both sides
      std::copy_n(from + 1, inner, w + 1);
      w[0] = w[n - 1] = 0;
      for (std::size_t k = 1; k <= reach; ++k) {
        *(w - k) = -w[k];
        w[n - 1 + k] = -w[n - 1 - k];
      }
      double* to = along_x_.data() + j * n + 1;
      weigh_three(kernel_[0], w + 1, kernel_[1], w, w + 2, inner, to);
      for (std::size_t k = 2; k < reach; k += 2)
        add_pairs(kernel_[k], w + 1 - k, w + 1 + k, kernel_[k + 1], w - k, w + 2 + k, inner, to);
    }
  });
}

/// And back.
void Diffusion::along_y(NodeField& omega, double nothing) const {
  constexpr std::size_t block = 512;
  const auto n = static_cast<std::size_t>(grid_.nx + 1);
  const auto top = static_cast<std::ptrdiff_t>(grid_.ny), reach = static_cast<std::ptrdiff_t>(kernel_.size()) - 1;
  const NodeField zeros(block, 0.0);
  in_pieces(static_cast<std::size_t>(top - 1), 16, [&](std::size_t first, std::size_t last) {
    std::array<std::array<double, block>, 4> mirrored;
    for (auto j = static_cast<std::ptrdiff_t>(first) + 1; j < static_cast<std::ptrdiff_t>(last) + 1; ++j) {
      const bool any = std::any_of(is_zero_.begin() + std::max<std::ptrdiff_t>(0, j - reach),
                                   is_zero_.begin() + std::min(top, j + reach) + 1, [](char zero) { return !zero; });
      for (std::size_t left = 1; left < n - 1; left += block) {
        const std::size_t count = std::min(block, n - 1 - left);
        double* to = omega.data() + static_cast<std::size_t>(j) * n + left;
        if (!any) {
          clear_row(to, count);
          continue;
        }
        const auto row = [&](std::ptrdiff_t at, std::size_t spare) -> const double* {
          const auto inside = static_cast<std::size_t>(at < 0 ? -at : at > top ? 2 * top - at : at);
          if (is_zero_[inside]) return zeros.data();
          const double* found = along_x_.data() + inside * n + left;
          if (at >= 0 && at <= top) return found;
          scale_row(-1, found, count, mirrored[spare].data());
          return mirrored[spare].data();
        };
        weigh_three(kernel_[0], row(j, 0), kernel_[1], row(j - 1, 0), row(j + 1, 1), count, to);
        for (std::ptrdiff_t k = 2; k < reach; k += 2)
          add_pairs(kernel_[static_cast<std::size_t>(k)], row(j - k, 0), row(j + k, 1),
                    kernel_[static_cast<std::size_t>(k) + 1], row(j - k - 1, 2), row(j + k + 1, 3), count, to);
        drop_small(nothing, count, to);
      }
    }
  });
}

void Diffusion::apply(NodeField& omega, double spread, double nothing) {
  if (spread <= 0) return;
  if (spread != prepared_) prepare(spread);
  along_x_.resize(omega.size());
  is_zero_.assign(static_cast<std::size_t>(grid_.ny) + 1, 1);
  for (int piece = 0; piece < pieces_; ++piece) {
    along_x(omega);
    along_y(omega, nothing);
  }
}

}  // namespace splashdown::vortex
