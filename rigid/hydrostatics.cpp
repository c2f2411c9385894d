#include "rigid/hydrostatics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "rigid/message.hpp"
#include "rigid/simplex.hpp"

namespace splashdown::rigid {

namespace {

using std::numbers::pi;

/// The part of a polygon (or of a segment, seen as a polygon with two corners) with height <= 0.
template <int d>
std::vector<Vec<d>> below_zero(const FacetCorners<d>& corners) {
  std::vector<Vec<d>> kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec<d>& a = corners[i];
    const Vec<d>& b = corners[(i + 1) % corners.size()];
    const double ya = a(d - 1), yb = b(d - 1);
    if (ya <= 0) kept.push_back(a);
    if ((ya <= 0) == (yb <= 0)) continue;
    kept.push_back(a + ya / (ya - yb) * (b - a));
    kept.back()(d - 1) = 0;
  }
  return kept;
}

/// A segment's clip runs there and back: its first two corners are the segment.
std::vector<FacetCorners<2>> simplices(const std::vector<Vec<2>>& kept) {
  if (kept.size() < 2) return {};
  return {{kept[0], kept[1]}};
}

std::vector<FacetCorners<3>> simplices(const std::vector<Vec<3>>& kept) {
  std::vector<FacetCorners<3>> fan;
  for (std::size_t k = 2; k < kept.size(); ++k) fan.push_back({kept[0], kept[k - 1], kept[k]});
  return fan;
}

/// Projection of a facet on the water plane, positive where its normal points up.
double upward_measure(const FacetCorners<2>& c) { return c[0].x() - c[1].x(); }
double upward_measure(const FacetCorners<3>& c) { return 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).z(); }

template <int d>
double lowest(const Surface<d>& surface, const Isometry<d>& pose) {
  return (pose.linear() * surface.vertices).row(d - 1).minCoeff() + pose.translation()(d - 1);
}

template <int d>
Floating<d> assess(const Surface<d>& surface, const Isometry<d>& pose, double water_level) {
  Floating<d> f;
  f.pose = pose;
  f.submerged = submerged<d>(surface, pose, water_level);
  f.draft = water_level - lowest<d>(surface, pose);
  const double weakest =
      f.submerged.waterline_moment.template selfadjointView<Eigen::Lower>().eigenvalues().minCoeff();
  f.metacentric_height = f.submerged.centre(d - 1) + weakest / f.submerged.volume - pose.translation()(d - 1);
  return f;
}

}  // namespace

template <int d>
Submerged<d> submerged(const Surface<d>& surface, const Isometry<d>& pose, double water_level) {
  Vec<d> apex = pose.translation();  // a cone from a point of the plane is clipped by clipping its base
  apex(d - 1) = water_level;
  Submerged<d> s;
  Vec<d> first = Vec<d>::Zero(), plane_first = Vec<d>::Zero();
  Eigen::Matrix<double, d, d> plane_second = Eigen::Matrix<double, d, d>::Zero();
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
    FacetCorners<d> corners = facet_corners(surface, f);
    for (Vec<d>& x : corners) x = pose * x - apex;
    for (const FacetCorners<d>& part : simplices(below_zero<d>(corners))) {
      const CornerSums<d> sums(part);
      const double cone = cone_measure<d>(part), up = upward_measure(part);
      s.volume += cone;
      first += cone / (d + 1) * sums.first;
      // The wet surface and the water plane close each other: int f(x) n_up dA over both vanishes.
      s.waterline -= up;
      plane_first -= up / d * sums.first;
      plane_second -= up / (d * (d + 1)) * sums.second;
    }
  }
  if (s.volume > 0) s.centre = apex + first / s.volume;
  if (s.waterline > 0) {
    const Vec<d> centroid = plane_first / s.waterline;
    plane_second -= s.waterline * centroid * centroid.transpose();
    s.waterline_moment = plane_second.template topLeftCorner<d - 1, d - 1>();
  }
  return s;
}

template <int d>
std::optional<Floating<d>> floating(const Surface<d>& surface, const Isometry<d>& pose, double mass,
                                    double density, double water_level) {
  if (!(mass > 0 && density > 0 && std::isfinite(mass) && std::isfinite(density)))
    throw std::invalid_argument(
        message("floating: mass ", mass, " and density ", density, " must be positive"));
  const auto heights = (pose.linear() * surface.vertices).row(d - 1).eval();
  double wet = water_level - heights.maxCoeff(), dry = water_level - heights.minCoeff();
  Isometry<d> trial = pose;
  double& height = trial.translation()(d - 1);
  height = wet;
  const double target = mass / density;
  if (submerged<d>(surface, trial, water_level).volume < target) return std::nullopt;

  // The displaced volume falls with height at the rate of the waterline: Newton, kept between bounds.
  const double resolution = 1e-15 * (dry - wet);
  const int iterations = 200;  // bisection alone needs about 50
  height = 0.5 * (wet + dry);
  for (int i = 0; i < iterations && dry - wet > resolution; ++i) {
    const Submerged<d> s = submerged<d>(surface, trial, water_level);
    const double excess = s.volume - target;
    (excess > 0 ? wet : dry) = height;
    const double newton = height + excess / s.waterline;
    const double next = newton > wet && newton < dry ? newton : 0.5 * (wet + dry);
    const bool settled = std::abs(newton - height) <= resolution;
    if (settled) break;
    height = next;
  }
  return assess<d>(surface, trial, water_level);
}

std::optional<Floating<2>> floating_stable(const Surface<2>& surface, const Isometry<2>& pose, double mass,
                                           double density, double water_level) {
  const double extent =
      (surface.vertices.rowwise().maxCoeff() - surface.vertices.rowwise().minCoeff()).norm();
  const auto at = [&](double turn) {
    Isometry<2> heeled = pose;
    heeled.linear() = Eigen::Rotation2Dd(turn) * pose.linear();
    return floating<2>(surface, heeled, mass, density, water_level);
  };
  const auto lever = [](const Floating<2>& f) { return f.submerged.centre.x() - f.pose.translation().x(); };

  const double balance = 1e-9 * extent;  // a lever that is nothing but round-off
  const double neutral = 1e-6 * extent;  // (a circle's 256-gon has |GM| < 8e-5 radii: it settles on a facet)
  const double stride = pi / 180;        // resolves the equilibria of anything but a gear wheel
  const std::optional<Floating<2>> start = at(0);
  if (!start) return start;
  double sense = std::copysign(1., lever(*start));
  if (std::abs(lever(*start)) <= balance) {
    if (start->metacentric_height > -neutral) return start;
    sense = 1;
  }

  double from = 0, to = sense * stride;
  while (sense * lever(*at(to)) > 0 && std::abs(to) < 2 * pi) {
    from = to;
    to += sense * stride;
  }
  const double resolution = 1e-13;
  while (std::abs(to - from) > resolution) {
    const double middle = 0.5 * (from + to);
    (sense * lever(*at(middle)) > 0 ? from : to) = middle;
  }
  return at(0.5 * (from + to));
}

template Submerged<2> submerged<2>(const Surface<2>&, const Isometry<2>&, double);
template Submerged<3> submerged<3>(const Surface<3>&, const Isometry<3>&, double);
template std::optional<Floating<2>> floating<2>(const Surface<2>&, const Isometry<2>&, double, double,
                                                double);
template std::optional<Floating<3>> floating<3>(const Surface<3>&, const Isometry<3>&, double, double,
                                                double);

}  // namespace splashdown::rigid
