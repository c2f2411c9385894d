#include "apps/scene/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "core/geometry.hpp"
#include "rigid/shapes/solids.hpp"
#include "rigid/shapes/spline.hpp"

namespace splashdown::apps {

Waypoint Oscillation::at(double time) const {
  const double angle = 2 * std::numbers::pi * frequency * time;
  Waypoint point{time, centre + amplitude * std::sin(angle + phase_deg * radians), attitude};
  point.attitude.pitch_deg += pitch_deg * std::sin(angle + pitch_phase_deg * radians);
  return point;
}

Waypoint Oscillation::rate_at(double time) const {
  const double rate = 2 * std::numbers::pi * frequency, angle = rate * time;
  return {time,
          rate * std::cos(angle + phase_deg * radians) * amplitude,
          {.pitch_deg = rate * pitch_deg * std::cos(angle + pitch_phase_deg * radians)}};
}
namespace {

using rigid::Surface;
using rigid::Vec;

using Turn = Eigen::AngleAxisd;

}  // namespace

template <int d>
std::optional<double> deadrise(const Body& body) {
  const bool is_round =
      std::holds_alternative<CircleShape>(body.shape) || std::holds_alternative<EllipseShape>(body.shape) ||
      std::holds_alternative<CapsuleShape>(body.shape) || std::holds_alternative<SphereShape>(body.shape);
  if (is_round) return {};
  const auto hull = outline<d>(body);
  Eigen::Index lowest = 0;
  hull.vertices.row(d - 1).minCoeff(&lowest);
  double least = 90 * radians;
  for (Eigen::Index i = 0; i < hull.facets.cols(); ++i) {
    if ((hull.facets.col(i).array() != lowest).all()) continue;
    std::array<Vec<d>, d> corner;
    for (int k = 0; k < d; ++k) corner[static_cast<std::size_t>(k)] = hull.vertices.col(hull.facets(k, i));
    const Vec<d> n = area_vector(corner);
    least = std::min(least, std::atan2(n.template head<d - 1>().norm(), std::abs(n[d - 1])));
  }
  // Chords of a curve turn by so much where it has no corner.
  const bool chords = std::holds_alternative<SplineShape>(body.shape) && least > 1e-6 && least <= rigid::largest_turn;
  return chords ? std::nullopt : std::optional(least);
}

template <int d>
rigid::MassProperties<d> mass_properties(const Body& body) {
  constexpr int n = rigid::rotations<d>;
  if (body.whole)
    return {body.whole->mass, vec<d>(body.whole->centre), body.whole->inertia.template bottomRightCorner<n, n>()};
  auto properties = shape_of<d>(body.shape).at_unit_density;
  if (body.mass)
    properties = rigid::with_mass(properties, *body.mass);
  else if (body.density)
    properties = rigid::with_density(properties, *body.density);
  if (body.centre_of_mass) properties.centre = vec<d>(*body.centre_of_mass);
  if (body.inertia) properties.inertia = body.inertia->bottomRightCorner<n, n>();
  return properties;
}

template <>
Eigen::Matrix2d rotation<2>(const Attitude& attitude) {
  return Eigen::Rotation2Dd(attitude.pitch_deg * radians).toRotationMatrix();
}

template <>
Eigen::Matrix3d rotation<3>(const Attitude& a) {
  return (Turn(a.heading_deg * radians, Vec<3>::UnitZ()) * Turn(-a.pitch_deg * radians, Vec<3>::UnitY()) *
          Turn(a.roll_deg * radians, Vec<3>::UnitX()))
      .toRotationMatrix();
}

template <>
rigid::Rotation<2> angular_velocity<2>(const Attitude&, const Attitude& rate) {
  return rigid::Rotation<2>(rate.pitch_deg * radians);
}

template <>
rigid::Rotation<3> angular_velocity<3>(const Attitude& a, const Attitude& rate) {
  // The nose-up turn is about the axis that the heading has turned, the roll about the nose itself.
  const Vec<3> across = rotation<3>({.heading_deg = a.heading_deg}) * Vec<3>::UnitY();
  const Vec<3> nose = rotation<3>({.heading_deg = a.heading_deg, .pitch_deg = a.pitch_deg}) * Vec<3>::UnitX();
  return radians * (rate.heading_deg * Vec<3>::UnitZ() - rate.pitch_deg * across + rate.roll_deg * nose);
}

template <int d>
rigid::Isometry<d> shape_pose(const Point& position, const Attitude& attitude) {
  rigid::Isometry<d> pose = rigid::Isometry<d>::Identity();
  pose.linear() = rotation<d>(attitude);
  pose.translation() = vec<d>(position);
  return pose;
}

template <int d>
Surface<d> outline(const Body& body) {
  auto surface = shape_of<d>(body.shape).surface;
  surface.vertices = shape_pose<d>(body) * surface.vertices;
  return surface;
}

template <>
Surface<2> tank_outline<2>(const Tank& tank) {
  Surface<2> surface;
  surface.vertices.resize(2, 4);
  surface.vertices.row(0) << tank.min.x(), tank.min.x(), tank.max.x(), tank.max.x();
  surface.vertices.row(1) << tank.min.y(), tank.max.y(), tank.max.y(), tank.min.y();
  surface.facets.resize(2, 4);
  surface.facets << 0, 1, 2, 3, 1, 2, 3, 0;
  return surface;
}

template <>
Surface<3> tank_outline<3>(const Tank& tank) {
  Surface<3> surface = rigid::box(tank.max - tank.min).surface;
  surface.vertices.colwise() += 0.5 * (tank.min + tank.max);
  surface.facets.row(1).swap(surface.facets.row(2));
  return surface;
}

template <int d>
Extents<d> extents(const Surface<d>& surface) {
  Extents<d> box;
  for (Eigen::Index i = 0; i < surface.vertices.cols(); ++i) box.extend(surface.vertices.col(i));
  return box;
}

template <int d>
std::string text(const Vec<d>& x, int digits) {
  const double round_off = 1e-12;  // of coordinates in metres: shown as the zero that is meant
  std::string list;
  for (int k = 0; k < d; ++k)
    list += fmt::format("{}{:.{}g}", k > 0 ? ", " : "", std::abs(x[k]) < round_off ? 0. : x[k], digits);
  return "(" + list + ")";
}

template <int d>
std::string text(const Extents<d>& box) {
  std::string list;
  for (int k = 0; k < d; ++k) list += fmt::format("{}[{:g}, {:g}]", k > 0 ? " x " : "", box.min()[k], box.max()[k]);
  return list;
}

template rigid::MassProperties<2> mass_properties<2>(const Body&);
template rigid::MassProperties<3> mass_properties<3>(const Body&);
template rigid::Isometry<2> shape_pose<2>(const Point&, const Attitude&);
template rigid::Isometry<3> shape_pose<3>(const Point&, const Attitude&);
template Surface<2> outline<2>(const Body&);
template Surface<3> outline<3>(const Body&);
template std::optional<double> deadrise<2>(const Body&);
template std::optional<double> deadrise<3>(const Body&);
template Extents<2> extents<2>(const Surface<2>&);
template Extents<3> extents<3>(const Surface<3>&);
template std::string text<2>(const Vec<2>&, int);
template std::string text<3>(const Vec<3>&, int);
template std::string text<2>(const Extents<2>&);
template std::string text<3>(const Extents<3>&);

}  // namespace splashdown::apps
