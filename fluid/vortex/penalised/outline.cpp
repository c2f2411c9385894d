#include "fluid/vortex/penalised/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace splashdown::vortex {
namespace {

struct Segment {
  Vec<2> a, b;
  double distance(const Vec<2>& x) const {
    const Vec<2> along = b - a;
    const double t = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (a + t * along - x).norm();
  }
};

std::vector<Segment> segments_of(const Surface<2>& outline, const Isometry<2>& pose) {
  std::vector<Segment> segments;
  for (Eigen::Index f = 0; f < outline.facets.cols(); ++f)
    segments.push_back({pose * Vec<2>(outline.vertices.col(outline.facets(0, f))),
                        pose * Vec<2>(outline.vertices.col(outline.facets(1, f)))});
  return segments;
}

constexpr double drawn_in = 1. / 3;  // of the ramp's half width

/// Faces of one direction: their places are min + h (i, j).
class Cover {
 public:
  Cover(const Vec<2>& min, double h, const FaceBox& box, std::vector<double>& chi)
      : min_(min), h_(h), box_(box), chi_(chi) {}

  /// Rows are crossed by the outline an even number of times: parity tells inside from outside.
  void fill(const std::vector<Segment>& segments, bool inside_out) {
    chi_.assign(box_.size(), inside_out ? 1.0 : 0.0);
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(box_.height));
    for (const auto& s : segments) {
      const Vec<2>&low = s.a.y() < s.b.y() ? s.a : s.b, &high = s.a.y() < s.b.y() ? s.b : s.a;
      const int first = std::max(0, index(low.y(), 1)), last = std::min(box_.height - 1, index(high.y(), 1) - 1);
      for (int j = first; j <= last; ++j) {
        const double y = min_.y() + h_ * j, t = (y - low.y()) / (high.y() - low.y());
        crossings[static_cast<std::size_t>(j)].push_back(low.x() + t * (high.x() - low.x()));
      }
    }
    for (int j = 0; j < box_.height; ++j) {
      auto& x = crossings[static_cast<std::size_t>(j)];
      std::ranges::sort(x);
      for (std::size_t k = 0; k + 1 < x.size(); k += 2)
        for (int i = std::max(0, index(x[k], 0)); i < std::min(box_.width, index(x[k + 1], 0)); ++i)
          chi_[box_.at(i, j)] = inside_out ? 0.0 : 1.0;
    }
  }

  /// Replaces the step by a smooth ramp where the outline is near. The ramp is drawn in by a third of its half width: passes
  /// make a body of all that it touches, which would look larger by so much.
  void smooth(const std::vector<Segment>& segments, double width) {
    const double shift = drawn_in * width, reach = width + shift;
    std::vector<double> distance(box_.size(), std::numeric_limits<double>::infinity());
    for (const auto& s : segments) {
      const Vec<2> low = s.a.cwiseMin(s.b).array() - reach, high = s.a.cwiseMax(s.b).array() + reach;
      for (int j = std::max(0, index(low.y(), 1)); j < std::min(box_.height, index(high.y(), 1) + 1); ++j)
        for (int i = std::max(0, index(low.x(), 0)); i < std::min(box_.width, index(high.x(), 0) + 1); ++i) {
          double& d = distance[box_.at(i, j)];
          d = std::min(d, s.distance(min_ + h_ * Vec<2>(i, j)));
        }
    }
    for (std::size_t k = 0; k < distance.size(); ++k) {
      if (!(distance[k] < reach)) continue;
      const double phi = std::clamp(((chi_[k] > 0.5 ? -1 : 1) * distance[k] + shift) / width, -1., 1.);
      chi_[k] = 0.5 * (1 - phi - std::sin(std::numbers::pi * phi) / std::numbers::pi);
    }
  }

 private:
  /// The first index whose place is at x or beyond.
  int index(double x, int axis) const {
    const double at = std::ceil((x - min_[axis]) / h_);
    return static_cast<int>(std::clamp(at, -1.0, 1e9));
  }

  Vec<2> min_;
  double h_;
  const FaceBox& box_;
  std::vector<double>& chi_;
};

int multiple_of_eight(int n) { return (n + 7) / 8 * 8; }

}  // namespace

OutlineMoments moments_of(const Surface<2>& outline) {
  OutlineMoments m;
  Vec<2> first = Vec<2>::Zero();
  for (Eigen::Index f = 0; f < outline.facets.cols(); ++f) {
    const Vec<2> a = outline.vertices.col(outline.facets(0, f)), b = outline.vertices.col(outline.facets(1, f));
    const double twice = a.x() * b.y() - a.y() * b.x();
    m.area += 0.5 * twice;
    first += twice / 6 * (a + b);
    m.polar += twice / 12 * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
    m.length += (b - a).norm();
  }
  m.centroid = first / m.area;
  return m;
}

FaceBox box_around(const Grid& grid, const Surface<2>& outline, const Isometry<2>& pose, double width, int margin) {
  Eigen::AlignedBox<double, 2> extents;
  for (Eigen::Index v = 0; v < outline.vertices.cols(); ++v) extents.extend(pose * Vec<2>(outline.vertices.col(v)));
  const Vec<2> low = (extents.min() - grid.min).array() - width, high = (extents.max() - grid.min).array() + width;
  FaceBox box;
  box.i0 = static_cast<int>(std::floor(low.x() / grid.h)) - margin;
  box.j0 = static_cast<int>(std::floor(low.y() / grid.h)) - margin;
  // What is more than needed may go to the other side.
  const auto size = [margin](double end, int nodes, int& first) {
    const int needed = static_cast<int>(std::ceil(end)) + margin + 1 - first, all = multiple_of_eight(needed);
    first -= std::clamp(first + all - nodes, 0, all - needed);
    return all;
  };
  box.width = size(high.x() / grid.h, grid.nx + 1, box.i0);
  box.height = size(high.y() / grid.h, grid.ny + 1, box.j0);
  return box;
}

void cover(const Grid& grid, const FaceBox& box, const Surface<2>& outline, const Isometry<2>& pose, double width,
           bool inside_out, FaceField& chi) {
  const auto segments = segments_of(outline, pose);
  const Vec<2> corner = grid.node(box.i0, box.j0);
  const auto one = [&](const Vec<2>& shift, std::vector<double>& values) {
    Cover cover(corner + grid.h * shift, grid.h, box, values);
    cover.fill(segments, inside_out);
    if (width > 0) cover.smooth(segments, width);
  };
  one({0, 0.5}, chi.u);
  one({0.5, 0}, chi.v);
  // Faces that only one of their nodes in the box belongs to.
  for (int i = 0; i < box.width; ++i) chi.u[box.at(i, box.height - 1)] = 0;
  for (int j = 0; j < box.height; ++j) chi.v[box.at(box.width - 1, j)] = 0;
}

}  // namespace splashdown::vortex
