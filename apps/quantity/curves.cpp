#include "apps/quantity/curves.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace splashdown::quantity {

namespace {

using Column = std::vector<double>;

void require_increasing(const Column& x) {
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(x[i] > x[i - 1]))
      throw std::runtime_error(fmt::format("x does not increase from row {} ({}) to the next ({})", i, x[i - 1], x[i]));
}

void require_width(double width) {
  if (!(width > 0)) throw std::runtime_error(fmt::format("a width must be positive, not {}", width));
}

/// Index i with x[i] <= at <= x[i+1]; at has to lie within x.
std::size_t interval_of(const Column& x, double at) {
  const auto after = std::upper_bound(x.begin(), x.end(), at);
  const auto i = std::max<std::ptrdiff_t>(after - x.begin() - 1, 0);
  return std::min(static_cast<std::size_t>(i), x.size() - 2);
}

double value_at(const Column& x, const Column& y, double at) {
  const std::size_t i = interval_of(x, at);
  const double share = (at - x[i]) / (x[i + 1] - x[i]);
  return y[i] + share * (y[i + 1] - y[i]);
}

/// Of the piecewise linear curve from x.front() on; x does not decrease. Refers to both columns.
class RunningIntegral {
 public:
  RunningIntegral(const Column& y, const Column& x) : y_(y), x_(x), at_points_(x.size(), 0.0) {
    if (x.size() < 2) throw std::runtime_error("a window needs two rows");
    for (std::size_t i = 1; i < x.size(); ++i)
      at_points_[i] = at_points_[i - 1] + 0.5 * (y[i] + y[i - 1]) * (x[i] - x[i - 1]);
  }
  double operator()(double at) const {
    const std::size_t i = interval_of(x_, at);
    return at == x_[i] ? at_points_[i] : at_points_[i] + 0.5 * (y_[i] + value_at(x_, y_, at)) * (at - x_[i]);
  }

 private:
  const Column &y_, &x_;
  Column at_points_;
};

}  // namespace

double integral(const Column& y, const Column& x) {
  if (y.size() != x.size()) throw std::runtime_error("the first two columns differ in length");
  if (x.size() < 2) throw std::runtime_error("an integral needs two rows");
  require_increasing(x);
  double total = 0;
  for (std::size_t i = 1; i < x.size(); ++i) total += 0.5 * (y[i] + y[i - 1]) * (x[i] - x[i - 1]);
  return total;
}

double slope(const Column& y, const Column& x) {
  const Eigen::Map<const Eigen::ArrayXd> ys(y.data(), Eigen::Index(y.size()));
  const Eigen::Map<const Eigen::ArrayXd> xs(x.data(), Eigen::Index(x.size()));
  const Eigen::ArrayXd dx = xs - xs.mean();
  return (dx * (ys - ys.mean())).sum() / dx.square().sum();
}

Column interpolated(const Column& x, const Column& y, const Column& at) {
  if (x.size() < 2) throw std::runtime_error("interpolation needs two rows");
  require_increasing(x);
  const double slack = 0.01 * (x.back() - x.front());
  Column result;
  for (const double place : at) {
    const bool inside = place >= x.front() - slack && place <= x.back() + slack;
    result.push_back(inside ? value_at(x, y, std::clamp(place, x.front(), x.back()))
                            : std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

Column smoothed(const Column& y, const Column& x, double width) {
  require_width(width);
  require_increasing(x);
  Column result;
  std::size_t begin = 0, end = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    while (x[begin] < x[i] - 0.5 * width) ++begin;
    while (end < x.size() && x[end] <= x[i] + 0.5 * width) ++end;
    if (end - begin < 3) {  // too few points for a parabola: nothing to average
      result.push_back(y[i]);
      continue;
    }
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t k = begin; k < end; ++k) {
      const double u = (x[k] - x[i]) / (0.5 * width);
      const Eigen::Vector3d powers(1, u, u * u);
      normal += powers * powers.transpose();
      right += powers * y[k];
    }
    result.push_back(normal.inverse().row(0).dot(right));
  }
  return result;
}

Column window_means(const Column& y, const Column& x, double width) {
  require_width(width);
  require_increasing(x);
  const RunningIntegral integral_to(y, x);
  // Rounding of the division must not drop a window that fits exactly.
  const double windows = std::floor((x.back() - x.front()) / width * (1 + 1e-12));
  if (!(windows <= double(most_pieces)))
    throw std::runtime_error(
        fmt::format("{:g} windows of {} are too many; {} are the most", windows, width, most_pieces));
  Column means;
  for (double k = 0; k < windows; ++k) {
    const double from = x.front() + k * width;
    means.push_back((integral_to(std::min(from + width, x.back())) - integral_to(from)) / width);
  }
  return means;
}

double largest_mean(const Column& y, const Column& x, double width) {
  require_width(width);
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return x[i]; });
  Column sorted_x, sorted_y;
  for (const std::size_t i : order) sorted_x.push_back(x[i]), sorted_y.push_back(y[i]);
  const RunningIntegral integral_to(sorted_y, sorted_x);
  const double front = sorted_x.front(), back = sorted_x.back();
  if (!(back - front >= width))
    throw std::runtime_error(fmt::format("x spans {}, less than a window of {}", back - front, width));
  double largest = -std::numeric_limits<double>::infinity();
  for (const double at : sorted_x)
    for (const double from : {at, at - width}) {
      if (from < front || from + width > back) continue;
      const double mean = (integral_to(from + width) - integral_to(from)) / width;
      if (std::isnan(mean)) return mean;
      largest = std::max(largest, mean);
    }
  return largest;
}

Column upward_crossings(const Column& y, const Column& x) {
  Column result;
  for (std::size_t i = 1; i < y.size(); ++i) {
    if (std::isnan(y[i - 1]) && y[i] > 0) result.push_back(x[i]);
    if (y[i - 1] <= 0 && y[i] > 0) result.push_back(x[i - 1] + (x[i] - x[i - 1]) * (0 - y[i - 1]) / (y[i] - y[i - 1]));
  }
  return result;
}

Column peak_heights(const Column& y, const Column& x) {
  Column result;
  for (std::size_t i = 1; i + 1 < y.size(); ++i) {
    if (!(y[i] > y[i - 1] && y[i] >= y[i + 1])) continue;
    const double before = (y[i] - y[i - 1]) / (x[i] - x[i - 1]);
    const double after = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
    const double curvature = (after - before) / (x[i + 1] - x[i - 1]);  // half the second derivative
    const double gradient = before + curvature * (x[i] - x[i - 1]);     // at x[i]
    result.push_back(y[i] - gradient * gradient / (4 * curvature));
  }
  return result;
}

Column bin_centres(double low, double high, std::size_t count) {
  Column result;
  for (std::size_t i = 0; i < count; ++i) result.push_back(low + (double(i) + 0.5) * (high - low) / double(count));
  return result;
}

Column bin_means(const Column& y, const Column& x, double low, double high, std::size_t count) {
  if (!std::isfinite(high - low)) throw std::runtime_error(fmt::format("bins need ends, not {} and {}", low, high));
  Column sums(count, 0.0), rows(count, 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!(x[i] >= low && x[i] < high)) continue;
    const auto bin = std::min(count - 1, static_cast<std::size_t>((x[i] - low) / (high - low) * double(count)));
    sums[bin] += y[i];
    rows[bin] += 1;
  }
  for (std::size_t i = 0; i < count; ++i) sums[i] /= rows[i];  // an empty bin becomes nan
  return sums;
}

}  // namespace splashdown::quantity
