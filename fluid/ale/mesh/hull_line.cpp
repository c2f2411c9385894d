#include "fluid/ale/mesh/hull_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/surface/unite.hpp"

namespace splashdown::ale {
namespace {

double distance_to(const Surface<2>& outline, const Vec<2>& point) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index f = 0; f < outline.facets.cols(); ++f) {
    const Vec<2> a = outline.vertices.col(outline.facets(0, f)), along = outline.vertices.col(outline.facets(1, f)) - a;
    const double share = std::clamp((point - a).dot(along) / along.squaredNorm(), 0., 1.);
    least = std::min(least, (a + share * along - point).norm());
  }
  return least;
}

int nearest_wall(const std::vector<Hole>& hulls, const Vec<2>& point) {
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t w = 0; w < hulls.size(); ++w)
    if (const double away = distance_to(hulls[w].outline, point); away < least) {
      least = away;
      best = static_cast<int>(w);
    }
  return best;
}

}  // namespace

HullLine::HullLine(std::vector<Vec<2>> points, std::vector<int> walls)
    : points_(std::move(points)), walls_(std::move(walls)), starts_{0} {
  for (std::size_t i = 0; i < points_.size(); ++i)
    starts_.push_back(starts_.back() + (points_[(i + 1) % points_.size()] - points_[i]).norm());
}

std::size_t HullLine::edge_at(double& arc) const {
  arc -= length() * std::floor(arc / length());
  const auto next = std::ranges::upper_bound(starts_, arc);
  return std::min(static_cast<std::size_t>(next - starts_.begin()), points_.size()) - 1;
}

Vec<2> HullLine::at(double arc) const {
  const std::size_t i = edge_at(arc);
  const double share = (arc - starts_[i]) / (starts_[i + 1] - starts_[i]);
  return points_[i] + share * (points_[(i + 1) % points_.size()] - points_[i]);
}

int HullLine::wall_at(double arc) const { return walls_[edge_at(arc)]; }

double HullLine::middle(double from, double to) const {
  if (to - from > 0.5 * length()) from += length();
  if (from - to > 0.5 * length()) to += length();
  return 0.5 * (from + to);
}

bool HullLine::holds(const Vec<2>& point) const {
  bool inside = false;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec<2>&a = points_[i], &b = points_[(i + 1) % points_.size()];
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

double HullLine::turn_at(std::size_t point) const {
  const std::size_t count = points_.size();
  const Vec<2> before = points_[point] - points_[(point + count - 1) % count],
               after = points_[(point + 1) % count] - points_[point];
  return std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
}

/// From one point to a later one, by the number of edges up to an arc length: the integral of 1/size.
void HullLine::divide_piece(std::size_t from, std::size_t to, double size, const MeshSpec& spec) {
  constexpr double most_turn = 0.5;  // of an edge [rad]: its quadratic curve is then within 1e-4 of an arc
  constexpr int samples = 2000;
  const std::size_t count = points_.size();
  const double start = starts_[from], span = (to >= count ? length() + starts_[to - count] : starts_[to]) - start,
               corner = spec.corner_angle * std::numbers::pi / 180;
  double turn = 0;
  for (std::size_t i = from + 1; i < to; ++i) turn += std::abs(turn_at(i % count));
  const bool begins = turn_at(from % count) > corner, ends = turn_at(to % count) > corner;
  const auto wanted = [&](double along) {
    double least = size;
    if (begins) least = std::min(least, spec.corner * size + spec.growth * along);
    if (ends) least = std::min(least, spec.corner * size + spec.growth * (span - along));
    return least;
  };
  std::vector<double> edges = {0};
  for (int k = 0; k < samples; ++k) edges.push_back(edges.back() + span / samples / wanted(span * (k + 0.5) / samples));
  const int pieces = static_cast<int>(std::ceil(std::max({edges.back() * (1 - 1e-9), turn / most_turn, 1.})));
  for (int piece = 0, k = 0; piece < pieces; ++piece) {
    const double at = edges.back() * piece / pieces;
    while (k + 1 < samples && edges[static_cast<std::size_t>(k + 1)] <= at) ++k;
    const double low = edges[static_cast<std::size_t>(k)], high = edges[static_cast<std::size_t>(k + 1)];
    cuts_.push_back(start + span * (k + (at - low) / (high - low)) / samples);
  }
}

void HullLine::divide(std::span<const double> sizes, const MeshSpec& spec) {
  const std::size_t count = points_.size();
  const double corner = spec.corner_angle * std::numbers::pi / 180;
  std::vector<std::size_t> ends;  // points where smooth pieces begin
  for (std::size_t i = 0; i < count; ++i)
    if (std::abs(turn_at(i)) > corner || walls_[i] != walls_[(i + count - 1) % count]) ends.push_back(i);
  if (ends.empty()) ends.push_back(0);
  cuts_.clear();
  for (std::size_t e = 0; e < ends.size(); ++e) {
    const std::size_t from = ends[e], to = e + 1 < ends.size() ? ends[e + 1] : ends[0] + count;
    divide_piece(from, to, sizes[static_cast<std::size_t>(walls_[from])], spec);
  }
  for (double& cut : cuts_) cut -= length() * std::floor(cut / length());
  std::ranges::sort(cuts_);
}

std::vector<HullLine> hull_lines(const std::vector<Hole>& hulls) {
  std::vector<Surface<2>> outlines;
  for (const auto& hull : hulls) outlines.push_back(hull.outline);
  const Surface<2> all = outlines.size() == 1 ? outlines.front() : united<2>(outlines);
  std::vector<int> next(static_cast<std::size_t>(all.vertices.cols()), -1);
  for (Eigen::Index f = 0; f < all.facets.cols(); ++f)
    next[static_cast<std::size_t>(all.facets(0, f))] = all.facets(1, f);
  std::vector<HullLine> lines;
  for (std::size_t first = 0; first < next.size(); ++first) {
    std::vector<Vec<2>> points;
    std::vector<int> walls;
    for (int v = static_cast<int>(first); next[static_cast<std::size_t>(v)] >= 0;) {
      const int to = next[static_cast<std::size_t>(v)];
      const Vec<2> a = all.vertices.col(v), b = all.vertices.col(to);
      next[static_cast<std::size_t>(v)] = -1;
      if (a != b) {
        points.push_back(a);
        walls.push_back(nearest_wall(hulls, 0.5 * (a + b)));
      }
      v = to;
    }
    if (points.size() >= 3) lines.emplace_back(std::move(points), std::move(walls));
  }
  return lines;
}

std::vector<HullLine> divided_lines(const MeshSpec& spec) {
  std::vector<HullLine> lines;
  if (!spec.hulls.empty()) lines = hull_lines(spec.hulls);
  std::vector<double> sizes;
  for (const auto& hull : spec.hulls) sizes.push_back(hull.size);
  for (auto& line : lines) line.divide(sizes, spec);
  return lines;
}

}  // namespace splashdown::ale
