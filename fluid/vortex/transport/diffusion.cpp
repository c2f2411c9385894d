#include "fluid/vortex/transport/diffusion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.hpp"
#include "fluid/vortex/wide.hpp"

namespace splashdown::vortex {
namespace {

constexpr double left_out = 1e-13;        // of a sum
constexpr int widest_kernel = 13;         // less than the smallest grid
constexpr double most_spread = 0.3;       // of h^2, at which that many are enough
constexpr std::size_t fewest_rows = 128;  // that threads share: rows around them are made twice

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

/// Rows of a field after diffusion along x: as many as diffusion along y of one row asks for.
class Diffusion::Rows {
 public:
  Rows(const Diffusion& of, const NodeField& omega)
      : kernel_(of.kernel_),
        omega_(omega),
        n_(static_cast<std::size_t>(of.grid_.nx + 1)),
        top_(of.grid_.ny),
        reach_(static_cast<std::ptrdiff_t>(kernel_.size()) - 1),
        wide_(n_ + 2 * kernel_.size()),
        kept_(static_cast<std::size_t>(2 * reach_ + 1) * n_),
        mirrored_(4 * n_),
        zeros_(n_, 0.0),
        is_zero_(static_cast<std::size_t>(2 * reach_ + 1), 1) {}

  /// A row of the result; rows are asked for in ascending order.
  void to_row(std::ptrdiff_t j, double nothing, double* to) {
    for (made_ = std::max({made_, std::ptrdiff_t{1}, j - reach_}); made_ <= std::min(top_ - 1, j + reach_); ++made_)
      along_x(made_);
    bool any = false;
    for (std::ptrdiff_t at = std::max<std::ptrdiff_t>(1, j - reach_); at <= std::min(top_ - 1, j + reach_); ++at)
      any = any || !is_zero_[slot(at)];
    to[0] = to[n_ - 1] = 0;
    if (!any) return clear_row(to, n_);
    const std::size_t inner = n_ - 2;
    weigh_three(kernel_[0], row(j, 0), kernel_[1], row(j - 1, 0), row(j + 1, 1), inner, to + 1);
    for (std::ptrdiff_t k = 2; k < reach_; k += 2)
      add_pairs(kernel_[static_cast<std::size_t>(k)], row(j - k, 0), row(j + k, 1),
                kernel_[static_cast<std::size_t>(k) + 1], row(j - k - 1, 2), row(j + k + 1, 3), inner, to + 1);
    drop_small(nothing, inner, to + 1);
  }

 private:
  std::size_t slot(std::ptrdiff_t j) const { return static_cast<std::size_t>(j % (2 * reach_ + 1)); }

  void along_x(std::ptrdiff_t j) {
    const double* from = omega_.data() + static_cast<std::size_t>(j) * n_;
    const std::size_t inner = n_ - 2, reach = static_cast<std::size_t>(reach_);
    is_zero_[slot(j)] = all_zero(from + 1, inner) ? 1 : 0;
    if (is_zero_[slot(j)]) return;
    double* w = wide_.data() + reach;  // odd about both sides
    std::copy_n(from + 1, inner, w + 1);
    w[0] = w[n_ - 1] = 0;
    for (std::size_t k = 1; k <= reach; ++k) {
      *(w - k) = -w[k];
      w[n_ - 1 + k] = -w[n_ - 1 - k];
    }
    double* to = kept_.data() + slot(j) * n_;
    weigh_three(kernel_[0], w + 1, kernel_[1], w, w + 2, inner, to);
    for (std::size_t k = 2; k < reach; k += 2)
      add_pairs(kernel_[k], w + 1 - k, w + 1 + k, kernel_[k + 1], w - k, w + 2 + k, inner, to);
  }

  /// Inner nodes of a row, odd about bottom and top.
  const double* row(std::ptrdiff_t at, std::size_t spare) {
    const std::ptrdiff_t inside = at < 0 ? -at : at > top_ ? 2 * top_ - at : at;
    if (inside == 0 || inside == top_ || is_zero_[slot(inside)]) return zeros_.data();
    const double* found = kept_.data() + slot(inside) * n_;
    if (at == inside) return found;
    scale_row(-1, found, n_ - 2, mirrored_.data() + spare * n_);
    return mirrored_.data() + spare * n_;
  }

  const std::vector<double>& kernel_;
  const NodeField& omega_;
  std::size_t n_;
  std::ptrdiff_t top_, reach_;
  std::ptrdiff_t made_ = 0;  // rows below this one have been made
  std::vector<double> wide_, kept_, mirrored_, zeros_;
  std::vector<char> is_zero_;
};

void Diffusion::apply(NodeField& omega, double spread, double nothing) {
  if (spread <= 0) return;
  if (spread != prepared_) prepare(spread);
  const auto n = static_cast<std::size_t>(grid_.nx + 1), ny = static_cast<std::size_t>(grid_.ny);
  spread_.resize(omega.size());
  clear_row(spread_.data(), n);
  clear_row(spread_.data() + ny * n, n);
  for (int piece = 0; piece < pieces_; ++piece) {
    const std::size_t parts = std::clamp(ny / fewest_rows, std::size_t{1}, static_cast<std::size_t>(threads()));
    in_pieces(parts, 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t part = first; part < last; ++part) {
        Rows rows(*this, omega);
        for (std::size_t j = 1 + (ny - 1) * part / parts; j < 1 + (ny - 1) * (part + 1) / parts; ++j)
          rows.to_row(static_cast<std::ptrdiff_t>(j), nothing, spread_.data() + j * n);
      }
    });
    omega.swap(spread_);
  }
}

}  // namespace splashdown::vortex
