#include "rigid/shapes/inclined_hull.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry.hpp"
#include "rigid/shapes/simplex.hpp"

namespace splashdown::rigid {

namespace {

/// Corners of a clipped facet: no allocation, for a curve of levers clips millions.
template <int d>
struct Clip {
  std::array<Vec<d>, 4> corners;  // a triangle cut by a plane leaves a quadrangle at most
  std::size_t count = 0;

  void add(const Vec<d>& x) { corners[count++] = x; }
};

/// The part of a polygon (or of a segment, seen as a polygon with two corners) with height <= 0.
template <int d>
Clip<d> below_zero(const FacetCorners<d>& corners) {
  Clip<d> kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec<d>& a = corners[i];
    const Vec<d>& b = corners[(i + 1) % corners.size()];
    const double ya = a(d - 1), yb = b(d - 1);
    if (ya <= 0) kept.add(a);
    if ((ya <= 0) == (yb <= 0)) continue;
    Vec<d> cut = a + ya / (ya - yb) * (b - a);
    cut(d - 1) = 0;
    kept.add(cut);
  }
  return kept;
}

/// A segment's clip runs there and back: its first two corners are the segment.
template <typename Visit>
void each_simplex(const Clip<2>& kept, const Visit& visit) {
  if (kept.count >= 2) visit(FacetCorners<2>{kept.corners[0], kept.corners[1]});
}

template <typename Visit>
void each_simplex(const Clip<3>& kept, const Visit& visit) {
  for (std::size_t k = 2; k < kept.count; ++k)
    visit(FacetCorners<3>{kept.corners[0], kept.corners[k - 1], kept.corners[k]});
}

/// Projection of a facet on the water plane, positive where its normal points up.
double upward_measure(const FacetCorners<2>& c) { return c[0].x() - c[1].x(); }
double upward_measure(const FacetCorners<3>& c) { return 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).z(); }

}  // namespace

template <int d>
FloatingHull<d>::FloatingHull(const Surface<d>& of, Hollow hollow)
    : surface(of),
      hollows(of),
      extent((of.vertices.rowwise().maxCoeff() - of.vertices.rowwise().minCoeff()).norm()),
      state(hollow) {
  for (Eigen::Index f = 0; f < of.facets.cols(); ++f) volume += cone_measure<d>(facet_corners<d>(of, f));
}

template <int d>
InclinedHull<d>::InclinedHull(const FloatingHull<d>& hull, const Mat<d>& attitude)
    : hull_(&hull), turned_(attitude * hull.surface.vertices) {
  lowest_ = turned_.row(d - 1).minCoeff();
  highest_ = turned_.row(d - 1).maxCoeff();
  if (hull.state == Hollow::flooded) return;
  reached_ = hull.hollows.rims(turned_);
  rims_ = reached_;
  std::erase(rims_, no_rim);
  std::ranges::sort(rims_);
  rims_.erase(std::unique(rims_.begin(), rims_.end()), rims_.end());
}

/// Of the facets that water wets, with their corners about the point of the water plane over the centre of mass: a cone from there
/// is clipped by clipping its base.
template <int d>
template <class Visit>
void InclinedHull<d>::each_wet_part(double level, double flooded, const Visit& visit) const {
  const auto& facets = hull_->surface.facets;
  for (Eigen::Index f = 0; f < facets.cols(); ++f) {
    FacetCorners<d> corners;
    bool above = true, below = true, dry = false;
    for (int k = 0; k < d; ++k) {
      const int v = facets(k, f);
      Vec<d>& x = corners[static_cast<std::size_t>(k)];
      x = turned_.col(v);
      x(d - 1) -= level;
      const bool under = x(d - 1) <= 0;
      (under ? above : below) = false;
      dry = dry || (under && !reached_.empty() && reached_[static_cast<std::size_t>(v)] > flooded);
    }
    if (above || dry) continue;
    if (below)
      visit(corners);
    else
      each_simplex(below_zero<d>(corners), visit);
  }
}

template <int d>
Displaced InclinedHull<d>::displaced(double level, double flooded) const {
  Displaced s;
  each_wet_part(level, flooded, [&](const FacetCorners<d>& part) {
    s.volume += cone_measure<d>(part);
    s.waterline -= upward_measure(part);
  });
  return s;
}

template <int d>
Submerged<d> InclinedHull<d>::submerged(double level, double flooded) const {
  Submerged<d> s;
  Vec<d> first = Vec<d>::Zero(), plane_first = Vec<d>::Zero();
  Mat<d> plane_second = Mat<d>::Zero();
  each_wet_part(level, flooded, [&](const FacetCorners<d>& part) {
    const CornerSums<d> sums(part);
    const double cone = cone_measure<d>(part), up = upward_measure(part);
    s.volume += cone;
    first += cone / (d + 1) * sums.first;
    // The wet surface and the water plane close each other: int f(x) n_up dA over both vanishes.
    s.waterline -= up;
    plane_first -= up / d * sums.first;
    plane_second -= up / (d * (d + 1)) * sums.second;
  });
  if (s.volume > 0) s.centre = Vec<d>::Unit(d - 1) * level + first / s.volume;
  if (s.waterline > 0) {
    const Vec<d> centroid = plane_first / s.waterline;
    s.waterline_centre = centroid.template head<d - 1>();
    plane_second -= s.waterline * centroid * centroid.transpose();
    s.waterline_moment = plane_second.template topLeftCorner<d - 1, d - 1>();
  }
  return s;
}

template <int d>
double InclinedHull<d>::rim_above(double level, double flooded) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < reached_.size(); ++v)
    if (reached_[v] > flooded && turned_(d - 1, static_cast<Eigen::Index>(v)) < level)
      least = std::min(least, reached_[v]);
  return least;
}

namespace {

/// The displaced volume grows with the level at the rate of the waterline: Newton, kept between bounds.
template <int d>
double level_of(const InclinedHull<d>& hull, double volume, double dry, double wet, double flooded, double level) {
  const double resolution = 1e-15 * (hull.highest() - hull.lowest()),
               round_off = 1e-9 * (hull.highest() - hull.lowest());
  const int iterations = 200;  // bisection alone needs about 50
  if (!(level > dry && level < wet)) level = 0.5 * (wet + dry);
  double last = hull.highest() - hull.lowest();
  for (int i = 0; i < iterations && wet - dry > resolution; ++i) {
    const Displaced s = hull.displaced(level, flooded);
    const double excess = s.volume - volume;
    (excess > 0 ? wet : dry) = level;
    const double newton = level - excess / s.waterline;
    const double next = newton > dry && newton < wet ? newton : 0.5 * (wet + dry);
    const double change = std::abs(newton - level);
    if (change <= resolution || (last < round_off && change >= last)) break;
    last = change;
    level = next;
  }
  return level;
}

}  // namespace

template <int d>
std::optional<Immersion> balanced(const InclinedHull<d>& hull, double volume, double guess) {
  double dry = hull.lowest(), flooded = no_rim;
  // Between two rims the volume grows with the level; at each it drops by what is flooded.
  for (std::size_t i = 0; i <= hull.rims().size(); ++i) {
    const bool all = i == hull.rims().size();
    const double wet = all ? hull.highest() : hull.rims()[i];
    if ((all ? hull.volume() : hull.displaced(wet, flooded).volume) >= volume)
      return Immersion{level_of<d>(hull, volume, dry, wet, flooded, guess), flooded};
    flooded = dry = wet;
  }
  return {};
}

template <>
Mat<2> tilt<2>(const Slope<2>& slope) {
  return rotation(slope);
}
template <>
Mat<3> tilt<3>(const Slope<3>& slope) {
  return rotation(Vec<3>(slope.y(), -slope.x(), 0));
}

template struct FloatingHull<2>;
template struct FloatingHull<3>;
template class InclinedHull<2>;
template class InclinedHull<3>;
template std::optional<Immersion> balanced<2>(const InclinedHull<2>&, double, double);
template std::optional<Immersion> balanced<3>(const InclinedHull<3>&, double, double);

}  // namespace splashdown::rigid
