#include "fluid/vortex/wake.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.hpp"
#include "fluid/vortex/wide.hpp"

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

SPLASHDOWN_WIDE double dot(const double* __restrict a, const double* __restrict b, std::size_t count) {
  double sums[lanes] = {}, sum = 0;
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    for (std::size_t l = 0; l < lanes; ++l) sums[l] += a[i + l] * b[i + l];
  for (; i < count; ++i) sum += a[i] * b[i];
  for (const double s : sums) sum += s;
  return sum;
}
/// omega = s omega + (1 - s) mean, of one mean, and of one s.
SPLASHDOWN_WIDE void turn_to(double mean, const double* __restrict s, std::size_t count, double* __restrict omega) {
  for (std::size_t i = 0; i < count; ++i) omega[i] = s[i] * omega[i] + (1 - s[i]) * mean;
}
SPLASHDOWN_WIDE void turn_to(const double* __restrict mean, double s, std::size_t count, double* __restrict omega) {
  for (std::size_t i = 0; i < count; ++i) omega[i] = s * omega[i] + (1 - s) * mean[i];
}

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

void Wake::end(NodeField& omega, const Vec<2>& reach) {
  goes_on_ = false;
  if (reach.isZero()) return;
  for (auto* side : {&sides_.bottom, &sides_.top}) side->assign(static_cast<std::size_t>(grid_.nx) + 1, 0.0);
  for (auto* side : {&sides_.left, &sides_.right}) side->assign(static_cast<std::size_t>(grid_.ny) + 1, 0.0);
  for (int axis = 0; axis < 2; ++axis)
    if (reach[axis] != 0) turn(omega, axis, reach[axis]);
}

/// Places across the stream have their means each. Of the places along it, one by one, `kept` says what stays of each and
/// `share` its part in the mean.
void Wake::turn(NodeField& omega, int axis, double reach) {
  const bool at_end = reach > 0;
  const auto row = static_cast<std::size_t>(grid_.nx) + 1, column = static_cast<std::size_t>(grid_.ny) + 1,
             across = axis == 0 ? column : row, along = axis == 0 ? row : column;
  const double width = std::min(std::abs(reach) / grid_.h, static_cast<double>(along - 1));
  const auto count = static_cast<std::size_t>(std::ceil(width));
  std::vector<double> mean(across), share(count), stays(count);
  double sum = 0;
  for (std::size_t d = 0; d < count; ++d) {  // from the side on
    const std::size_t at = at_end ? count - 1 - d : d;
    share[at] = slope(static_cast<double>(d) / width);
    stays[at] = kept(static_cast<double>(d) / width);
    sum += share[at];
  }
  if (!(sum > 0)) return;
  for (double& s : share) s /= sum;
  double* first = omega.data() + (at_end ? along - count : 0) * (axis == 0 ? 1 : row);
  in_pieces(across, 16, [&](std::size_t begin, std::size_t end) {
    if (axis == 0)
      for (std::size_t k = begin; k < end; ++k) mean[k] = dot(share.data(), first + k * row, count);
    else
      for (std::size_t d = 0; d < count; ++d) add_row(share[d], first + d * row + begin, end - begin, &mean[begin]);
  });
  balance(mean);
  in_pieces(across, 16, [&](std::size_t begin, std::size_t end) {
    if (axis == 0)
      for (std::size_t k = begin; k < end; ++k) turn_to(mean[k], stays.data(), count, first + k * row);
    else
      for (std::size_t d = 0; d < count; ++d) turn_to(&mean[begin], stays[d], end - begin, first + d * row + begin);
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
