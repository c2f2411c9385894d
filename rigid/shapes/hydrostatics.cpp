#include "rigid/shapes/hydrostatics.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "rigid/message.hpp"
#include "rigid/shapes/inclined_hull.hpp"

namespace splashdown::rigid {

namespace {

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

/// Over the weight, when the displaced volume is given: the height of the centre of mass over that of buoyancy. With respect to the
/// slope, its gradient is minus the lever and its curvature the metacentric heights.
template <int d>
double energy(const Floating<d>& f) {
  return f.pose.translation()(d - 1) - f.submerged.centre(d - 1);
}

template <int d>
Eigen::Matrix<double, d - 1, d - 1> metacentric_tensor(const Floating<d>& f) {
  return f.submerged.waterline_moment / f.submerged.volume -
         energy(f) * Eigen::Matrix<double, d - 1, d - 1>::Identity();
}

/// Where the hull floats with this attitude.
template <int d>
std::optional<Floating<d>> afloat(const FloatingHull<d>& hull, const Isometry<d>& pose, double volume,
                                  double water_level) {
  const InclinedHull<d> inclined(hull, pose.linear());
  const auto at = balanced<d>(inclined, volume, water_level - pose.translation()(d - 1));
  if (!at) return std::nullopt;
  auto f = assessed<d>(inclined, pose, *at, water_level);
  f.hollow = at->flooded > no_rim ? Hollow::flooded : hull.state;
  return f;
}

/// Where it is now, water has come over a rim.
template <int d>
bool under_water(const FloatingHull<d>& hull, const Isometry<d>& pose, double water_level) {
  const InclinedHull<d> inclined(hull, pose.linear());
  return !inclined.rims().empty() && inclined.rims().front() <= water_level - pose.translation()(d - 1);
}

template <int d>
FloatingHull<d> hull_in(const Surface<d>& surface, const Isometry<d>& pose, double water_level, Hollow hollow) {
  FloatingHull<d> hull(surface, hollow);
  if (under_water<d>(hull, pose, water_level)) hull.state = Hollow::flooded;
  return hull;
}

void expect_mass(double mass, double density) {
  if (!(mass > 0 && density > 0 && std::isfinite(mass) && std::isfinite(density)))
    throw std::invalid_argument(message("floating: mass ", mass, " and density ", density, " must be positive"));
}

/// The step of descent from an attitude: of Newton's method where the energy is convex, a degree at most.
template <int n>
struct Descent {
  using Amounts = Eigen::Matrix<double, n, 1>;
  Amounts step;
  bool convex;

  Descent(const Amounts& down, const Eigen::Matrix<double, n, n>& tensor, double extent) {
    const double balance = 1e-9 * extent;  // a lever that is nothing but round-off
    const double neutral = facets_share * extent, stride = std::numbers::pi / 180;
    const auto& [heights, axes] = Principal<n>(tensor);
    convex = heights(0) > 0;
    if (down.norm() <= balance && heights(0) < -neutral) {
      const double sense = axes.col(0).sum() < 0 ? -1 : 1;  // counter-clockwise in the plane
      step = sense * stride * axes.col(0);
      return;
    }
    Amounts amounts = axes.transpose() * down;
    for (Eigen::Index k = 0; k < amounts.size(); ++k) {
      const bool indifferent = std::abs(heights(k)) <= neutral && std::abs(amounts(k)) <= 0.1 * neutral;
      amounts(k) = indifferent ? 0 : amounts(k) / std::max(std::abs(heights(k)), neutral);
    }
    step = axes * amounts;
    if (step.norm() > stride) step *= stride / step.norm();
  }
};

/// Where GM vanishes, what comes after it in the energy decides: a place lower by more than the facets of round bodies make it.
template <int d, int n>
std::optional<Floating<d>> beside(const FloatingHull<d>& hull, const Floating<d>& f, double volume, double water_level,
                                  const Eigen::Matrix<double, d - 1, n>& allowed) {
  const double neutral = facets_share * hull.extent, lower = 1e-6 * hull.extent, turn = 5 * std::numbers::pi / 180;
  const Principal<n> principal(allowed.transpose() * metacentric_tensor(f) * allowed);
  for (Eigen::Index k = 0; k < n; ++k) {
    if (std::abs(principal.values(k)) > neutral) continue;
    Isometry<d> pose = f.pose;
    pose.linear() = tilt<d>(allowed * (turn * principal.axes.col(k))) * f.pose.linear();
    const auto next = afloat<d>(hull, pose, volume, water_level);
    if (next && next->hollow == f.hollow && energy(*next) < energy(f) - lower) return next;
  }
  return {};
}

}  // namespace

template <int d>
Floating<d> assessed(const InclinedHull<d>& hull, const Isometry<d>& pose, const Immersion& at, double water_level) {
  Floating<d> f;
  f.pose = pose;
  f.pose.translation()(d - 1) = water_level - at.level;
  f.submerged = hull.submerged(at.level, at.flooded);
  f.submerged.centre += f.pose.translation();
  f.draft = at.level - hull.lowest();
  f.freeboard = hull.rim_above(at.level, at.flooded) - at.level;
  const double weakest = Principal<d - 1>(f.submerged.waterline_moment).values(0);
  f.metacentric_height = f.submerged.centre(d - 1) + weakest / f.submerged.volume - f.pose.translation()(d - 1);
  return f;
}

template <int d>
Submerged<d> submerged(const Surface<d>& surface, const Isometry<d>& pose, double water_level, Hollow hollow) {
  const FloatingHull<d> hull(surface, hollow);
  const double level = water_level - pose.translation()(d - 1);
  auto s = InclinedHull<d>(hull, pose.linear()).submerged(level, level);
  s.centre += pose.translation();
  return s;
}

template <int d>
std::vector<Vec<d>> hollow_bottoms(const Surface<d>& surface, const Isometry<d>& pose) {
  const Hollows<d> hollows(surface);
  const Eigen::Matrix<double, d, Eigen::Dynamic> turned = pose.linear() * surface.vertices;
  const auto rims = hollows.rims(turned);
  std::vector<Vec<d>> bottoms;
  if (rims.empty()) return bottoms;
  for (const int v : hollows.bottoms(turned))
    if (rims[static_cast<std::size_t>(v)] > no_rim) bottoms.push_back(turned.col(v) + pose.translation());
  return bottoms;
}

template <int d>
std::optional<Floating<d>> floating(const Surface<d>& surface, const Isometry<d>& pose, double mass, double density,
                                    double water_level, Hollow hollow) {
  expect_mass(mass, density);
  return afloat<d>(hull_in<d>(surface, pose, water_level, hollow), pose, mass / density, water_level);
}

/// Ends in the minimum that the body would come to; never at an unstable balance. Indifferent directions, a round body's roll, stay as
/// they are. A hull whose hollow is flooded on the way goes on with it flooded.
template <int d, int n>
std::optional<Floating<d>> settled(FloatingHull<d>& hull, const Isometry<d>& pose, double volume, double water_level,
                                   const Eigen::Matrix<double, d - 1, n>& allowed) {
  const double arrived = 1e-13;
  const int iterations = 1000;
  const auto along = [&](const Floating<d>& at) -> Eigen::Matrix<double, n, 1> {
    return allowed.transpose() * lever(at);
  };
  auto f = afloat<d>(hull, pose, volume, water_level);
  for (int i = 0; f && i < iterations; ++i) {
    const auto down = along(*f);
    auto [step, convex] = Descent<n>(down, allowed.transpose() * metacentric_tensor(*f) * allowed, hull.extent);
    std::optional<Floating<d>> better;
    for (; step.norm() >= arrived && !better; step *= 0.5) {
      Isometry<d> trial = f->pose;
      trial.linear() = tilt<d>(allowed * step) * f->pose.linear();
      const auto next = afloat<d>(hull, trial, volume, water_level);
      if (!next || next->hollow != hull.state) {
        hull.state = Hollow::flooded;
        return settled<d, n>(hull, trial, volume, water_level, allowed);
      }
      // Near the minimum the energy is flat to round-off, the lever is not.
      const bool lower = energy(*next) < energy(*f), closer = along(*next).norm() < down.norm();
      if (lower || (closer && convex)) better = next;
    }
    if (!better) better = beside<d, n>(hull, *f, volume, water_level, allowed);
    if (!better) break;
    f = better;
  }
  return f;
}

template <int d>
double metacentric_height(const Floating<d>& f, const Slope<d>& direction) {
  return direction.dot(metacentric_tensor(f) * direction);
}

Slope<3> length_axis(const Floating<3>& floating) {
  const Slope<3> nose = floating.pose.linear().col(0).head<2>();
  const double upright = 0.1;
  return nose.norm() > upright ? Slope<3>(nose.normalized()) : Slope<3>::UnitX();
}

template <int d>
std::optional<Floating<d>> floating_stable(const Surface<d>& surface, const Isometry<d>& pose, double mass,
                                           double density, double water_level, Hollow hollow) {
  expect_mass(mass, density);
  auto hull = hull_in<d>(surface, pose, water_level, hollow);
  return settled<d, d - 1>(hull, pose, mass / density, water_level, Eigen::Matrix<double, d - 1, d - 1>::Identity());
}

template Floating<2> assessed<2>(const InclinedHull<2>&, const Isometry<2>&, const Immersion&, double);
template Submerged<2> submerged<2>(const Surface<2>&, const Isometry<2>&, double, Hollow);
template std::vector<Vec<2>> hollow_bottoms<2>(const Surface<2>&, const Isometry<2>&);
template std::optional<Floating<2>> floating<2>(const Surface<2>&, const Isometry<2>&, double, double, double, Hollow);
template double metacentric_height<2>(const Floating<2>&, const Slope<2>&);
template std::optional<Floating<2>> floating_stable<2>(const Surface<2>&, const Isometry<2>&, double, double, double,
                                                       Hollow);
template Floating<3> assessed<3>(const InclinedHull<3>&, const Isometry<3>&, const Immersion&, double);
template Submerged<3> submerged<3>(const Surface<3>&, const Isometry<3>&, double, Hollow);
template std::vector<Vec<3>> hollow_bottoms<3>(const Surface<3>&, const Isometry<3>&);
template std::optional<Floating<3>> floating<3>(const Surface<3>&, const Isometry<3>&, double, double, double, Hollow);
template double metacentric_height<3>(const Floating<3>&, const Slope<3>&);
template std::optional<Floating<3>> floating_stable<3>(const Surface<3>&, const Isometry<3>&, double, double, double,
                                                       Hollow);
template std::optional<Floating<3>> settled<3, 1>(FloatingHull<3>&, const Isometry<3>&, double, double,
                                                  const Eigen::Matrix<double, 2, 1>&);

}  // namespace splashdown::rigid
