#include "rigid/lines/catenary.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "rigid/message.hpp"

namespace splashdown::rigid {
namespace {

// Forces are found to this share of themselves; the bracket of H spans as many decades as doubles resolve.
constexpr double exact = 1e-13;

/// Where a growing function is zero between `low` and `high`: false position after Anderson and Bjorck (1973), which halves the
/// weight of an end that stays, bisection where that is slow.
template <class Function>
double growing_root(const Function& f, double low, double high) {
  double f_low = f(low), f_high = f(high);
  if (f_low >= 0) return low;
  if (f_high <= 0) return high;
  constexpr int most = 200;
  double width = high - low;
  for (int i = 0; i < most && high - low > exact * (std::abs(low) + std::abs(high)); ++i) {
    const bool slow = i % 3 == 2 && high - low > 0.5 * width;
    if (i % 3 == 2) width = high - low;
    double x = slow ? 0.5 * (low + high) : low - f_low * (high - low) / (f_high - f_low);
    if (!(x > low && x < high)) x = 0.5 * (low + high);
    const double f_x = f(x);
    if (f_x == 0) return x;
    if (f_x < 0) {
      const double kept = 1 - f_x / f_low;
      low = x, f_low = f_x;
      f_high *= kept > 0 ? kept : 0.5;
    } else {
      const double kept = 1 - f_x / f_high;
      high = x, f_high = f_x;
      f_low *= kept > 0 ? kept : 0.5;
    }
  }
  return 0.5 * (low + high);
}

/// Vertical force at the anchor; the floor carries what would pull it down.
double at_anchor(const CatenarySpec& line, double V) {
  const double end = V - line.weight * line.length;
  return line.floor ? std::max(end, 0.0) : end;
}

/// V - V_a without its cancellation: the weight that hangs.
double hanging_weight(const CatenarySpec& line, double V) {
  const double all = line.weight * line.length;
  return line.floor ? std::min(V, all) : all;
}

/// asinh(V/H) - asinh(V_a/H) = ln (V + T)/(V_a + T_a), with T - T_a = (V - V_a)(V + V_a)/(T + T_a).
double opening(const CatenarySpec& line, double H, double V) {
  const double a = at_anchor(line, V), hangs = hanging_weight(line, V), T = std::hypot(H, V), T_a = std::hypot(H, a);
  const double growth = hangs + hangs * (V + a) / (T + T_a);
  if (a >= 0) return std::log1p(growth / (a + T_a));
  return V <= 0 ? std::log1p((hangs - hangs * (V + a) / (T + T_a)) / (T - V)) : std::asinh(V / H) - std::asinh(a / H);
}

double lying(const CatenarySpec& line, double V) {
  return line.floor ? std::clamp(line.length - V / line.weight, 0.0, line.length) : 0.0;
}

double height(const CatenarySpec& line, double H, double V) {
  const double a = at_anchor(line, V), w = line.weight, sum = std::hypot(H, V) + std::hypot(H, a);
  return hanging_weight(line, V) * (V + a) * (1 / sum + 0.5 / line.axial_stiffness) / w;
}

double reach(const CatenarySpec& line, double H, double V) {
  const double w = line.weight, EA = line.axial_stiffness, on_floor = lying(line, V);
  double x = H / w * opening(line, H, V) + H * line.length / EA + on_floor;
  if (line.friction > 0 && on_floor > 0) {
    const double still = std::max(on_floor - H / (line.friction * w), 0.0);
    x += line.friction * w / (2 * EA) * (still * still - on_floor * on_floor);
  }
  return x;
}

/// V that lifts the end to z while H pulls; at least `least`.
double lifting_force(const CatenarySpec& line, double H, double z) {
  const double w = line.weight, L = line.length;
  double low = line.floor ? 0.0 : 0.5 * w * L - 1, high = 0.5 * w * L + 1;
  const auto over = [&](double V) { return height(line, H, V) - z; };
  for (double step = w * L + 1; over(high) < 0; step *= 2) high += step;
  if (!line.floor)
    for (double step = w * L + 1; over(low) > 0; step *= 2) low -= step;
  return growing_root(over, low, high);
}

/// d(x, z)/d(H, V)
Eigen::Matrix2d compliance(const CatenarySpec& line, double H, double V) {
  const double w = line.weight, EA = line.axial_stiffness, a = at_anchor(line, V), on_floor = lying(line, V);
  const double T = std::hypot(H, V), T_a = std::hypot(H, a);
  Eigen::Matrix2d all;
  // Of the arc: integrals of V^2/T^3, -H V/T^3, H^2/T^3 over dV/w from a to V.
  all(0, 0) = (opening(line, H, V) - (V / T - a / T_a)) / w + line.length / EA;
  all(0, 1) = all(1, 0) = H * (1 / T - 1 / T_a) / w;
  all(1, 1) = (V / T - a / T_a) / w + hanging_weight(line, V) / (w * EA);
  if (line.friction > 0 && on_floor > 0) {
    const double still = std::max(on_floor - H / (line.friction * w), 0.0);
    all(0, 0) -= still / EA;
    all(0, 1) += line.friction * (on_floor - still) / EA;
  }
  return all;
}

/// Straight down onto the floor, the rest in a heap.
std::optional<CatenaryEnd> hanging(const CatenarySpec& line, const Eigen::Vector2d& span) {
  if (!line.floor) return {};
  const double w = line.weight, EA = line.axial_stiffness;
  // z = l + w l^2/(2 EA)
  const double hangs = 2 * span.y() / (1 + std::sqrt(1 + 2 * w * span.y() / EA));
  if (hangs + span.x() > line.length) return {};
  CatenaryEnd end;
  end.force.y() = w * hangs;
  end.stiffness(1, 1) = w / (1 + w * hangs / EA);
  end.on_floor = line.length - hangs;
  return end;
}

/// Stretched out on its floor.
CatenaryEnd lying_straight(const CatenarySpec& line, double x) {
  CatenaryEnd end;
  end.on_floor = line.length;
  if (x <= line.length) return end;
  const double w = line.weight, EA = line.axial_stiffness, mu = line.friction;
  const auto over = [&](double H) { return reach(line, H, 0) - x; };
  double high = EA * (x / line.length - 1) + mu * w * line.length;
  while (over(high) < 0) high *= 2;
  const double H = growing_root(over, 0, high);
  end.force.x() = H;
  end.stiffness(0, 0) = 1 / compliance(line, H, 0)(0, 0);  // z grows like V^2: upwards it has none yet
  end.anchor_tension = std::max(H - mu * w * line.length, 0.0);
  return end;
}

}  // namespace

Eigen::Vector2d catenary_span(const CatenarySpec& line, double H, double V) {
  return {reach(line, H, V), height(line, H, V)};
}

CatenaryEnd catenary_end(const CatenarySpec& line, const Eigen::Vector2d& asked) {
  Eigen::Vector2d span = asked;
  if (line.floor) span.y() = std::max(span.y(), 0.0);
  if (const auto end = hanging(line, span)) return *end;
  if (line.floor && span.y() == 0) return lying_straight(line, span.x());
  // As if all pulled along one straight line, and as if nothing did.
  const double chord = span.norm(), EA = line.axial_stiffness, wL = line.weight * line.length;
  double high = EA * std::max(chord / line.length - 1, 0.0) + wL + 1;
  const auto over = [&](double H) { return reach(line, H, lifting_force(line, H, span.y())) - span.x(); };
  constexpr double least = 1e-9;  // of its weight: such a line hangs straight down
  while (over(high) < 0) high *= 4;
  double low = high / 4;
  while (low > least * wL && over(low) > 0) high = low, low /= 4;
  const double H = growing_root(over, low, high);
  const double V = lifting_force(line, H, span.y());
  CatenaryEnd end;
  end.force = {H, V};
  end.stiffness = compliance(line, H, V).inverse();
  end.on_floor = lying(line, V);
  end.anchor_tension =
      line.floor ? std::hypot(std::max(H - line.friction * line.weight * end.on_floor, 0.0), at_anchor(line, V))
                 : std::hypot(H, at_anchor(line, V));
  return end;
}

void check(const CatenarySpec& line) {
  const auto require = [](bool fine, const char* what, double value) {
    if (!fine) throw std::invalid_argument(message("line: ", what, ", it is ", value));
  };
  require(std::isfinite(line.length) && line.length > 0, "its length must be positive", line.length);
  require(std::isfinite(line.axial_stiffness) && line.axial_stiffness > 0, "its axial stiffness must be positive",
          line.axial_stiffness);
  require(std::isfinite(line.weight) && line.weight > 0, "the weight of a catenary must be positive", line.weight);
  require(std::isfinite(line.friction) && line.friction >= 0, "friction must not be negative", line.friction);
}

}  // namespace splashdown::rigid
