#include "rigid/shapes/hydrostatics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "rigid/message.hpp"
#include "rigid/shapes/simplex.hpp"

namespace splashdown::rigid {

namespace {

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
  const double weakest = f.submerged.waterline_moment.template selfadjointView<Eigen::Lower>().eigenvalues().minCoeff();
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
std::optional<Floating<d>> floating(const Surface<d>& surface, const Isometry<d>& pose, double mass, double density,
                                    double water_level) {
  if (!(mass > 0 && density > 0 && std::isfinite(mass) && std::isfinite(density)))
    throw std::invalid_argument(message("floating: mass ", mass, " and density ", density, " must be positive"));
  const auto heights = (pose.linear() * surface.vertices).row(d - 1).eval();
  double wet = water_level - heights.maxCoeff(), dry = water_level - heights.minCoeff();
  Isometry<d> trial = pose;
  double& height = trial.translation()(d - 1);
  const double given = height;
  height = wet;
  const double target = mass / density;
  if (submerged<d>(surface, trial, water_level).volume < target) return std::nullopt;

  // The displaced volume falls with height at the rate of the waterline: Newton, kept between bounds.
  const double resolution = 1e-15 * (dry - wet), round_off = 1e-9 * (dry - wet);
  const int iterations = 200;  // bisection alone needs about 50
  height = given > wet && given < dry ? given : 0.5 * (wet + dry);
  double last = dry - wet;
  for (int i = 0; i < iterations && dry - wet > resolution; ++i) {
    const Submerged<d> s = submerged<d>(surface, trial, water_level);
    const double excess = s.volume - target;
    (excess > 0 ? wet : dry) = height;
    const double newton = height + excess / s.waterline;
    const double next = newton > wet && newton < dry ? newton : 0.5 * (wet + dry);
    const double change = std::abs(newton - height);
    if (change <= resolution || (last < round_off && change >= last)) break;
    last = change;
    height = next;
  }
  return assess<d>(surface, trial, water_level);
}

namespace {

/// Turns by a slope: a point at the horizontal distance p rises by slope . p. In space about ez x slope.
template <int d>
Eigen::Matrix<double, d, d> tilt(const Slope<d>& slope) {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  if constexpr (d == 2)
    turn.z() = slope(0);
  else
    turn.template head<2>() << slope.y(), -slope.x();
  return Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()).toRotationMatrix().template topLeftCorner<d, d>();
}

/// Energy over weight when the displaced volume is given: the height of the centre of mass over that of buoyancy. With
/// respect to the slope, its gradient is minus the lever and its curvature the metacentric heights.
template <int d>
double energy(const Floating<d>& f) {
  return f.pose.translation()(d - 1) - f.submerged.centre(d - 1);
}

template <int d>
Slope<d> lever(const Floating<d>& f) {
  return (f.submerged.centre - f.pose.translation()).template head<d - 1>();
}

template <int d>
Eigen::Matrix<double, d - 1, d - 1> metacentric_tensor(const Floating<d>& f) {
  return f.submerged.waterline_moment / f.submerged.volume -
         energy(f) * Eigen::Matrix<double, d - 1, d - 1>::Identity();
}

/// Descends in energy along the allowed slopes (orthonormal columns) by Newton's method, in steps of a degree at most,
/// so that it ends in the minimum that the body would come to; never at an unstable balance. Indifferent directions, a
/// round body's roll, stay as they are.
template <int d>
Floating<d> settled(const Surface<d>& surface, Floating<d> f, double mass, double density, double water_level,
                    const Eigen::MatrixXd& allowed) {
  const double extent = (surface.vertices.rowwise().maxCoeff() - surface.vertices.rowwise().minCoeff()).norm();
  const double balance = 1e-9 * extent;  // a lever that is nothing but round-off
  const double neutral = 1e-4 * extent;  // |GM| of round bodies: that of their facets (a 128-gon: 3e-4 radii)
  const double stride = std::numbers::pi / 180, arrived = 1e-13;
  const int iterations = 1000;
  const auto along = [&](const Floating<d>& at) -> Eigen::VectorXd { return allowed.transpose() * lever(at); };
  for (int i = 0; i < iterations; ++i) {
    const Eigen::VectorXd down = along(f);
    const Eigen::MatrixXd tensor = metacentric_tensor(f);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> curvature(allowed.transpose() * tensor * allowed);
    const Eigen::VectorXd& heights = curvature.eigenvalues();
    const Eigen::MatrixXd& axes = curvature.eigenvectors();
    Eigen::VectorXd step;
    if (down.norm() <= balance && heights(0) < -neutral) {
      const double sense = axes.col(0).sum() < 0 ? -1 : 1;  // counter-clockwise in the plane
      step = sense * stride * axes.col(0);
    } else {
      Eigen::VectorXd amounts = axes.transpose() * down;
      for (Eigen::Index k = 0; k < amounts.size(); ++k) {
        const bool indifferent = std::abs(heights(k)) <= neutral && std::abs(amounts(k)) <= 0.1 * neutral;
        amounts(k) = indifferent ? 0 : amounts(k) / std::max(std::abs(heights(k)), neutral);
      }
      step = axes * amounts;
      if (step.norm() < arrived) break;
      if (step.norm() > stride) step *= stride / step.norm();
    }
    bool better = false;
    for (; step.norm() >= arrived && !better; step *= 0.5) {
      Isometry<d> pose = f.pose;
      pose.linear() = tilt<d>(allowed * step) * f.pose.linear();
      const auto next = floating<d>(surface, pose, mass, density, water_level);
      // Near the minimum the energy is flat to round-off, the lever is not.
      const bool lower = energy(*next) < energy(f), closer = along(*next).norm() < down.norm();
      better = lower || (closer && heights(0) > 0);
      if (better) f = *next;
    }
    if (!better) break;
  }
  return f;
}

}  // namespace

template <int d>
double metacentric_height(const Floating<d>& f, const Slope<d>& direction) {
  return direction.dot(metacentric_tensor(f) * direction);
}

template <int d>
std::optional<Floating<d>> floating_stable(const Surface<d>& surface, const Isometry<d>& pose, double mass,
                                           double density, double water_level) {
  const auto start = floating<d>(surface, pose, mass, density, water_level);
  if (!start) return start;
  return settled<d>(surface, *start, mass, density, water_level, Eigen::MatrixXd::Identity(d - 1, d - 1));
}

std::vector<Heeled> righting_levers(const Surface<3>& surface, const Floating<3>& rest, double mass, double density,
                                    double water_level, const Slope<3>& axis, std::span<const double> heels) {
  const Slope<3> across(-axis.y(), axis.x());
  std::vector<Heeled> curve;
  Floating<3> f = rest;
  double before = 0;
  for (const double heel : heels) {
    Isometry<3> pose = f.pose;
    pose.linear() = tilt<3>((heel - before) * across) * f.pose.linear();
    before = heel;
    f = settled<3>(surface, *floating<3>(surface, pose, mass, density, water_level), mass, density, water_level, axis);
    curve.push_back({heel, -lever(f).dot(across), f});
  }
  return curve;
}

template Submerged<2> submerged<2>(const Surface<2>&, const Isometry<2>&, double);
template Submerged<3> submerged<3>(const Surface<3>&, const Isometry<3>&, double);
template std::optional<Floating<2>> floating<2>(const Surface<2>&, const Isometry<2>&, double, double, double);
template std::optional<Floating<3>> floating<3>(const Surface<3>&, const Isometry<3>&, double, double, double);

template double metacentric_height<2>(const Floating<2>&, const Slope<2>&);
template double metacentric_height<3>(const Floating<3>&, const Slope<3>&);
template std::optional<Floating<2>> floating_stable<2>(const Surface<2>&, const Isometry<2>&, double, double, double);
template std::optional<Floating<3>> floating_stable<3>(const Surface<3>&, const Isometry<3>&, double, double, double);

}  // namespace splashdown::rigid
