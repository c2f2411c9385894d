#include "fluid/vortex/wake.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.hpp"

namespace splashdown::vortex {
namespace {

/// psi of a unit of vorticity on a half line that begins at a distance a ahead and b aside, but for a constant.
double half_line(double a, double b) {
  const double square = a * a + b * b;
  return square > 0 ? (0.5 * a * std::log(square) - a - b * std::atan2(b, a)) / (2 * std::numbers::pi) : 0;
}

/// Where the turn stands at a distance from the side, in its reach: one before it, zero at the side; and its slope.
double kept(double x) { return x * x * (3 - 2 * x); }
double slope(double x) { return 6 * x * (1 - x); }

/// Without circulation, that far fields stay finite.
void balance(std::vector<double>& mean) {
  double sum = 0, size = 0;
  for (const double m : mean) {
    sum += m;
    size += std::abs(m);
  }
  for (double& m : mean) m -= size > 0 ? sum / size * std::abs(m) : 0;
}

}  // namespace

const NodeField& Wake::ended(const NodeField& omega, const Vec<2>& reach) {
  goes_on_ = false;
  if (reach.isZero()) return omega;
  ended_ = omega;
  for (auto* side : {&sides_.bottom, &sides_.top}) side->assign(static_cast<std::size_t>(grid_.nx) + 1, 0.0);
  for (auto* side : {&sides_.left, &sides_.right}) side->assign(static_cast<std::size_t>(grid_.ny) + 1, 0.0);
  for (int axis = 0; axis < 2; ++axis)
    if (reach[axis] != 0) turn(axis, reach[axis]);
  return ended_;
}

/// Of the whole field; lines lie along the side, one by one towards it.
void Wake::turn(int axis, double reach) {
  const bool at_end = reach > 0;
  const int along = axis == 0 ? grid_.ny : grid_.nx, across = axis == 0 ? grid_.nx : grid_.ny;
  const std::size_t row = static_cast<std::size_t>(grid_.nx) + 1, step = axis == 0 ? row : 1,
                    lines = axis == 0 ? 1 : row;
  const double width = std::min(std::abs(reach) / grid_.h, static_cast<double>(across));
  const int count = static_cast<int>(std::ceil(width));
  std::vector<double> mean(static_cast<std::size_t>(along) + 1);
  double weights = 0;
  for (int d = 0; d < count; ++d) weights += slope(d / width);
  if (!(weights > 0)) return;
  const auto line = [&](int d) { return ended_.data() + static_cast<std::size_t>(at_end ? across - d : d) * lines; };
  in_pieces(mean.size(), 16, [&](std::size_t first, std::size_t last) {
    for (int d = 0; d < count; ++d)
      for (std::size_t k = first; k < last; ++k) mean[k] += slope(d / width) / weights * line(d)[k * step];
  });
  balance(mean);
  in_pieces(mean.size(), 16, [&](std::size_t first, std::size_t last) {
    for (int d = 0; d < count; ++d) {
      const double s = kept(d / width);
      for (std::size_t k = first; k < last; ++k) {
        double& w = line(d)[k * step];
        w = s * w + (1 - s) * mean[k];
      }
    }
  });
  go_on(axis, at_end, mean);
}

/// Strips share the mean by hat functions, which keep its first moment.
void Wake::go_on(int axis, bool at_end, const std::vector<double>& mean) {
  std::vector<double> of_strip(strips + 1, 0.0);
  const double each = static_cast<double>(mean.size() - 1) / strips;
  for (std::size_t k = 0; k < mean.size(); ++k) {
    const double at = static_cast<double>(k) / each;
    const auto low = std::min(static_cast<std::size_t>(at), strips - 1);
    of_strip[low] += grid_.h * mean[k] * (1 - (at - static_cast<double>(low)));
    of_strip[low + 1] += grid_.h * mean[k] * (at - static_cast<double>(low));
  }
  const auto& psi = exit(axis, at_end);
  for (std::size_t s = 0; s <= strips; ++s) {
    if (of_strip[s] == 0) continue;
    sides_.add(of_strip[s], psi.of_strip[s]);
    goes_on_ = true;
  }
}

const Wake::Exit& Wake::exit(int axis, bool at_end) {
  auto& exit = exits_[static_cast<std::size_t>(2 * axis + (at_end ? 1 : 0))];
  if (!exit.of_strip.empty()) return exit;
  const Vec<2> size = grid_.max() - grid_.min;
  for (std::size_t s = 0; s <= strips; ++s) {
    const double begins = static_cast<double>(s) / strips * size[1 - axis];
    const auto psi = [&](const Vec<2>& x) {
      return half_line(at_end ? size[axis] - x[axis] : x[axis], x[1 - axis] - begins);
    };
    Sides sides;
    for (int i = 0; i <= grid_.nx; ++i) {
      sides.bottom.push_back(psi({grid_.h * i, 0}));
      sides.top.push_back(psi({grid_.h * i, size.y()}));
    }
    for (int j = 0; j <= grid_.ny; ++j) {
      sides.left.push_back(psi({0, grid_.h * j}));
      sides.right.push_back(psi({size.x(), grid_.h * j}));
    }
    exit.of_strip.push_back(std::move(sides));
  }
  return exit;
}

}  // namespace splashdown::vortex
