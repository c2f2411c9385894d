#include "elastic/mesh/inner_lines.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace splashdown::elastic {
namespace {

double cross_of(const Vec<2>& a, const Vec<2>& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Points that are apart from each other.
class Apart {
 public:
  explicit Apart(double near) : near_(near) {}
  int number_of(const Vec<2>& x) {
    for (std::size_t k = 0; k < all_.size(); ++k)
      if ((all_[k] - x).norm() <= near_) return static_cast<int>(k);
    all_.push_back(x);
    return static_cast<int>(all_.size()) - 1;
  }
  const Vec<2>& operator[](int number) const { return all_[static_cast<std::size_t>(number)]; }
  const std::vector<Vec<2>>& all() const { return all_; }

 private:
  double near_;
  std::vector<Vec<2>> all_;
};

/// Where two pieces cross within both.
std::optional<Vec<2>> crossing(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c, const Vec<2>& e) {
  const Vec<2> one = b - a, other = e - c;
  const double turn = cross_of(one, other);
  if (std::abs(turn) <= 1e-12 * one.norm() * other.norm()) return {};  // parallel: they meet at ends alone
  const double s = cross_of(c - a, other) / turn, t = cross_of(c - a, one) / turn;
  if (s < 0 || s > 1 || t < 0 || t > 1) return {};
  return a + s * one;
}

/// Even-odd.
bool is_inside(const Surface<2>& outline, const Vec<2>& x) {
  bool inside = false;
  for (Eigen::Index f = 0; f < outline.facets.cols(); ++f) {
    const Vec<2> a = outline.vertices.col(outline.facets(0, f)), b = outline.vertices.col(outline.facets(1, f));
    if ((a.y() > x.y()) != (b.y() > x.y()) && x.x() < a.x() + (x.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

}  // namespace

LinedOutline lined(const Surface<2>& outline, const InnerLines& lines, double near) {
  Apart points(near);
  std::vector<std::array<int, 2>> whole;
  for (Eigen::Index f = 0; f < outline.facets.cols(); ++f)
    whole.push_back({points.number_of(outline.vertices.col(outline.facets(0, f))),
                     points.number_of(outline.vertices.col(outline.facets(1, f)))});
  const std::size_t of_outline = whole.size();
  for (const auto& [from, to] : lines) whole.push_back({points.number_of(from), points.number_of(to)});
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (std::size_t k = std::max(i + 1, of_outline); k < whole.size(); ++k)
      if (const auto x = crossing(points[whole[i][0]], points[whole[i][1]], points[whole[k][0]], points[whole[k][1]]))
        points.number_of(*x);
  LinedOutline result;
  std::set<std::pair<int, int>> taken;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const Vec<2> from = points[whole[i][0]], way = points[whole[i][1]] - from;
    std::vector<std::pair<double, int>> stops;
    for (int k = 0; k < static_cast<int>(points.all().size()); ++k) {
      const double at = (points[k] - from).dot(way) / way.squaredNorm();
      const bool is_end = k == whole[i][0] || k == whole[i][1];
      if (is_end || (at > 0 && at < 1 && (from + at * way - points[k]).norm() <= near)) stops.emplace_back(at, k);
    }
    std::ranges::sort(stops);
    for (std::size_t k = 1; k < stops.size(); ++k) {
      const int a = stops[k - 1].second, b = stops[k].second;
      const Vec<2> middle = 0.5 * (points[a] + points[b]);
      if (i >= of_outline && !is_inside(outline, middle)) continue;
      if (taken.insert(std::minmax(a, b)).second) result.pieces.push_back({a, b});
    }
  }
  result.vertices.resize(2, static_cast<Eigen::Index>(points.all().size()));
  for (std::size_t k = 0; k < points.all().size(); ++k)
    result.vertices.col(static_cast<Eigen::Index>(k)) = points.all()[k];
  return result;
}

}  // namespace splashdown::elastic
