#include "rigid/shapes/hydrostatics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "core/geometry.hpp"
#include "rigid/message.hpp"
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

/// Vertices about the point of the water plane below or above the centre of mass: a cone from there is clipped by
/// clipping its base.
template <int d>
using Corners = Eigen::Matrix<double, d, Eigen::Dynamic>;

template <int d>
Corners<d> about_water_plane(const Surface<d>& surface, const Isometry<d>& pose, double water_level) {
  Vec<d> apex = pose.translation();
  apex(d - 1) = water_level;
  Corners<d> x(d, surface.vertices.cols());
  for (Eigen::Index i = 0; i < x.cols(); ++i) x.col(i) = pose * surface.vertices.col(i) - apex;
  return x;
}

/// Visits the parts of the facets below the water plane.
template <int d, typename Visit>
void each_wet_part(const Surface<d>& surface, const Corners<d>& x, const Visit& visit) {
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
    FacetCorners<d> corners;
    std::size_t wet = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      corners[k] = x.col(surface.facets(static_cast<Eigen::Index>(k), f));
      wet += corners[k](d - 1) <= 0;
    }
    if (wet == corners.size()) visit(corners);
    if (wet > 0 && wet < corners.size()) each_simplex(below_zero<d>(corners), visit);
  }
}

/// Projection of a facet on the water plane, positive where its normal points up.
double upward_measure(const FacetCorners<2>& c) { return c[0].x() - c[1].x(); }
double upward_measure(const FacetCorners<3>& c) { return 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).z(); }

/// Of the turned vertices, over the centre of mass.
struct Heights {
  double least = std::numeric_limits<double>::max(), most = std::numeric_limits<double>::lowest();
};

template <int d>
Heights heights(const Surface<d>& surface, const Isometry<d>& pose) {
  const Vec<d> up = pose.linear().row(d - 1);
  Heights h;
  for (Eigen::Index i = 0; i < surface.vertices.cols(); ++i) {
    const double height = up.dot(surface.vertices.col(i));
    h.least = std::min(h.least, height);
    h.most = std::max(h.most, height);
  }
  return h;
}

/// Eigenvalues in ascending order, and their vectors. In closed form: Eigen's way for any size takes longer to compile than the rest
/// of this file.
template <int n>
struct Principal {
  Eigen::Matrix<double, n, 1> values;
  Eigen::Matrix<double, n, n> axes;

  explicit Principal(const Eigen::Matrix<double, n, n>& symmetric) {
    if constexpr (n == 1) {
      values(0) = symmetric(0, 0);
      axes(0, 0) = 1;
    } else {
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n, n>> solver;
      solver.computeDirect(symmetric);
      values = solver.eigenvalues();
      axes = solver.eigenvectors();
    }
  }
};

template <int d>
Floating<d> assess(const Surface<d>& surface, const Isometry<d>& pose, double water_level) {
  Floating<d> f;
  f.pose = pose;
  f.submerged = submerged<d>(surface, pose, water_level);
  f.draft = water_level - heights<d>(surface, pose).least - pose.translation()(d - 1);
  const double weakest = Principal<d - 1>(f.submerged.waterline_moment).values(0);
  f.metacentric_height = f.submerged.centre(d - 1) + weakest / f.submerged.volume - pose.translation()(d - 1);
  return f;
}

}  // namespace

template <int d>
Submerged<d> submerged(const Surface<d>& surface, const Isometry<d>& pose, double water_level) {
  Submerged<d> s;
  Vec<d> first = Vec<d>::Zero(), plane_first = Vec<d>::Zero();
  Eigen::Matrix<double, d, d> plane_second = Eigen::Matrix<double, d, d>::Zero();
  each_wet_part<d>(surface, about_water_plane<d>(surface, pose, water_level), [&](const FacetCorners<d>& part) {
    const CornerSums<d> sums(part);
    const double cone = cone_measure<d>(part), up = upward_measure(part);
    s.volume += cone;
    first += cone / (d + 1) * sums.first;
    // The wet surface and the water plane close each other: int f(x) n_up dA over both vanishes.
    s.waterline -= up;
    plane_first -= up / d * sums.first;
    plane_second -= up / (d * (d + 1)) * sums.second;
  });
  Vec<d> apex = pose.translation();
  apex(d - 1) = water_level;
  if (s.volume > 0) s.centre = apex + first / s.volume;
  if (s.waterline > 0) {
    const Vec<d> centroid = plane_first / s.waterline;
    plane_second -= s.waterline * centroid * centroid.transpose();
    s.waterline_moment = plane_second.template topLeftCorner<d - 1, d - 1>();
  }
  return s;
}

namespace {

/// What Newton's method needs of `submerged`, at a fifth of its price.
struct Displaced {
  double volume = 0, waterline = 0;
};

template <int d>
Displaced displaced(const Surface<d>& surface, const Isometry<d>& pose, double water_level) {
  Displaced s;
  each_wet_part<d>(surface, about_water_plane<d>(surface, pose, water_level), [&](const FacetCorners<d>& part) {
    s.volume += cone_measure<d>(part);
    s.waterline -= upward_measure(part);
  });
  return s;
}

/// At the height where a body that floats displaces `target`, sought from that of the pose.
template <int d>
Floating<d> balanced(const Surface<d>& surface, Isometry<d> trial, double target, double water_level) {
  const auto [least, most] = heights<d>(surface, trial);
  double wet = water_level - most, dry = water_level - least;
  double& height = trial.translation()(d - 1);
  // The displaced volume falls with height at the rate of the waterline: Newton, kept between bounds.
  const double resolution = 1e-15 * (dry - wet), round_off = 1e-9 * (dry - wet);
  const int iterations = 200;  // bisection alone needs about 50
  if (!(height > wet && height < dry)) height = 0.5 * (wet + dry);
  double last = dry - wet;
  for (int i = 0; i < iterations && dry - wet > resolution; ++i) {
    const Displaced s = displaced<d>(surface, trial, water_level);
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

}  // namespace

template <int d>
std::optional<Floating<d>> floating(const Surface<d>& surface, const Isometry<d>& pose, double mass, double density,
                                    double water_level) {
  if (!(mass > 0 && density > 0 && std::isfinite(mass) && std::isfinite(density)))
    throw std::invalid_argument(message("floating: mass ", mass, " and density ", density, " must be positive"));
  Isometry<d> immersed = pose;
  immersed.translation()(d - 1) = water_level - heights<d>(surface, pose).most;
  if (displaced<d>(surface, immersed, water_level).volume < mass / density) return std::nullopt;
  return balanced<d>(surface, pose, mass / density, water_level);
}

namespace {

/// Turns by a slope: a point at the horizontal distance p rises by slope . p. In space about ez x slope.
template <int d>
Eigen::Matrix<double, d, d> tilt(const Slope<d>& slope) {
  if constexpr (d == 2)
    return rotation(slope);
  else
    return rotation(Eigen::Vector3d(slope.y(), -slope.x(), 0));
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
/// round body's roll, stay as they are. `target` is the displaced volume.
template <int d, int n>
Floating<d> settled(const Surface<d>& surface, Floating<d> f, double target, double water_level,
                    const Eigen::Matrix<double, d - 1, n>& allowed) {
  using Amounts = Eigen::Matrix<double, n, 1>;
  const double extent = (surface.vertices.rowwise().maxCoeff() - surface.vertices.rowwise().minCoeff()).norm();
  const double balance = 1e-9 * extent;  // a lever that is nothing but round-off
  const double neutral = 1e-4 * extent;  // |GM| of round bodies: that of their facets (a 128-gon: 3e-4 radii)
  const double stride = std::numbers::pi / 180, arrived = 1e-13;
  const int iterations = 1000;
  const auto along = [&](const Floating<d>& at) -> Amounts { return allowed.transpose() * lever(at); };
  for (int i = 0; i < iterations; ++i) {
    const Amounts down = along(f);
    const auto& [heights, axes] = Principal<n>(allowed.transpose() * metacentric_tensor(f) * allowed);
    Amounts step;
    if (down.norm() <= balance && heights(0) < -neutral) {
      const double sense = axes.col(0).sum() < 0 ? -1 : 1;  // counter-clockwise in the plane
      step = sense * stride * axes.col(0);
    } else {
      Amounts amounts = axes.transpose() * down;
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
      const auto next = balanced<d>(surface, pose, target, water_level);
      // Near the minimum the energy is flat to round-off, the lever is not.
      const bool lower = energy(next) < energy(f), closer = along(next).norm() < down.norm();
      better = lower || (closer && heights(0) > 0);
      if (better) f = next;
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
  return settled<d, d - 1>(surface, *start, mass / density, water_level,
                           Eigen::Matrix<double, d - 1, d - 1>::Identity());
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
    f = settled<3, 1>(surface, balanced<3>(surface, pose, mass / density, water_level), mass / density, water_level,
                      axis);
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
