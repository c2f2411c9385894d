#include "core/goals/corner_order.hpp"

#include <cmath>
#include <numbers>

namespace splashdown {
namespace {

/// The first x of (0, 1) where a function changes its sign, else the inner place where it comes nearest to zero from below: the
/// real part, nearly, of a pair of complex roots; else 1.
template <class Function>
double first_root(const Function& f) {
  constexpr int parts = 400;
  constexpr double end = 1 - 1e-9;  // 1 itself is a rigid rotation
  double x = 1e-3, before = f(x), nearest = -HUGE_VAL, at = 1;
  for (int k = 1; k <= parts; ++k) {
    double low = x, high = 1e-3 + (end - 1e-3) * k / parts;
    const double value = f(high);
    if (value * before < 0) {
      for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (f(middle) * before > 0 ? low : high) = middle;
      }
      return low;
    }
    if (value > nearest) {
      nearest = value;
      at = k < parts ? high : 1;
    }
    x = high;
    before = value;
  }
  return before < 0 || nearest < 0 ? at : 1;
}

}  // namespace

double corner_exponent(double angle, CornerSide one, CornerSide other, double kappa) {
  const double s = std::sin(angle);
  if (one != other)
    return first_root([&](double x) {
      const double sine = std::sin(x * angle);
      return sine * sine - (kappa + 1) * (kappa + 1) / (4 * kappa) + x * x * s * s / kappa;
    });
  if (angle <= std::numbers::pi) return 1;
  const double factor = one == CornerSide::held ? kappa : 1;
  const auto opening = first_root([&](double x) { return factor * std::sin(x * angle) + x * s; });
  const auto sliding = first_root([&](double x) { return factor * std::sin(x * angle) - x * s; });
  return std::min(opening, sliding);
}

double over_shown(double order) { return 1 / (1 - std::exp2(-order)); }

}  // namespace splashdown
