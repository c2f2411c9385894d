#include "apps/scene_geometry.hpp"

#include <cmath>
#include <numbers>

namespace splashdown::apps {
namespace {

using rigid::Surface;
using rigid::Vec;
using std::numbers::pi;

constexpr double radians = pi / 180;

std::vector<Vec<2>> planar(const std::vector<Point>& points) {
  std::vector<Vec<2>> result;
  for (const auto& point : points) result.push_back(apps::planar(point));
  return result;
}

struct MakeShape {
  rigid::Shape<2> operator()(const PolygonShape& s) const { return rigid::polygon(planar(s.points)); }
  rigid::Shape<2> operator()(const WedgeShape& s) const {
    const double chine = s.breadth / 2 * std::tan(s.deadrise_deg * radians);
    const double side = s.height.value_or(chine) - chine;
    // A height given to print precision of the chine means no side at all.
    return rigid::wedge(s.deadrise_deg * radians, s.breadth, std::abs(side) < 1e-6 * chine ? 0 : side);
  }
  rigid::Shape<2> operator()(const BoxShape& s) const { return rigid::box(s.width, s.height); }
  rigid::Shape<2> operator()(const CircleShape& s) const { return rigid::circle(s.radius); }
  rigid::Shape<2> operator()(const EllipseShape& s) const {
    return rigid::ellipse(s.semi_axes.x(), s.semi_axes.y());
  }
  rigid::Shape<2> operator()(const CapsuleShape& s) const { return rigid::capsule(s.radius, s.length); }
};

Surface<2> shifted(Surface<2> surface, const Point& by) {
  surface.vertices.colwise() += apps::planar(by);
  return surface;
}

struct MakeRegion {
  Surface<2> operator()(const BoxRegion& r) const {
    std::vector<Vec<2>> points{apps::planar(r.min), {r.max.x(), r.min.y()}};
    // A chord of 1/200 of the wavelength misses a cosine by 1.2e-4 of its amplitude.
    const double waves = r.surface_wavelength > 0 ? (r.max.x() - r.min.x()) / r.surface_wavelength : 0;
    const int pieces = std::max(1, static_cast<int>(std::ceil(200 * waves)));
    for (int i = pieces; i >= 0; --i) {
      const double s = (r.max.x() - r.min.x()) * i / pieces;
      const double wave = r.surface_wavelength > 0
                              ? std::cos(2 * pi * s / r.surface_wavelength + r.surface_phase_deg * radians)
                              : 0;
      points.emplace_back(i == pieces ? r.max.x() : r.min.x() + s, r.max.y() + r.surface_amplitude * wave);
    }
    return rigid::polygon(points).surface;
  }
  Surface<2> operator()(const CircleRegion& r) const {
    return shifted(rigid::circle(r.radius).surface, r.centre);
  }
  Surface<2> operator()(const EllipseRegion& r) const {
    return shifted(rigid::ellipse(r.semi_axes.x(), r.semi_axes.y()).surface, r.centre);
  }
  Surface<2> operator()(const PolygonRegion& r) const { return rigid::polygon(planar(r.points)).surface; }
};

double cross(const Vec<2>& a, const Vec<2>& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The pieces' interiors cross in one point, off all ends by the tolerance.
bool cross_properly(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c, const Vec<2>& e, double tolerance) {
  const auto beside = [&](const Vec<2>& from, const Vec<2>& to, const Vec<2>& x) {
    return cross(to - from, x - from) / (to - from).norm();
  };
  const double ac = beside(a, b, c), ae = beside(a, b, e), ca = beside(c, e, a), cb = beside(c, e, b);
  const auto opposite = [&](double p, double q) {
    return (p > tolerance && q < -tolerance) || (p < -tolerance && q > tolerance);
  };
  return opposite(ac, ae) && opposite(ca, cb);
}

Vec<2> start(const Surface<2>& s, Eigen::Index facet) { return s.vertices.col(s.facets(0, facet)); }
Vec<2> end(const Surface<2>& s, Eigen::Index facet) { return s.vertices.col(s.facets(1, facet)); }

/// Some vertex or edge middle of `a` lies inside `b`.
bool reaches_into(const Surface<2>& a, const Surface<2>& b, double tolerance) {
  for (Eigen::Index i = 0; i < a.facets.cols(); ++i)
    for (const Vec<2>& x : {start(a, i), Vec<2>(0.5 * (start(a, i) + end(a, i)))})
      if (signed_distance(b, x) < -tolerance) return true;
  return false;
}

}  // namespace

rigid::Shape<2> shape_of(const Shape& shape) { return std::visit(MakeShape{}, shape); }

rigid::MassProperties<2> mass_properties(const Body& body) {
  auto properties = shape_of(body.shape).at_unit_density;
  if (body.mass)
    properties = rigid::with_mass(properties, *body.mass);
  else if (body.density)
    properties = rigid::with_density(properties, *body.density);
  if (body.centre_of_mass) properties.centre = planar(*body.centre_of_mass);
  if (body.inertia) properties.inertia(0, 0) = *body.inertia;
  return properties;
}

rigid::Isometry<2> shape_pose(const Point& position, double pitch_deg) {
  rigid::Isometry<2> pose = rigid::Isometry<2>::Identity();
  pose.translate(planar(position));
  if (pitch_deg != 0) pose.rotate(Eigen::Rotation2Dd(pitch_deg * radians));
  return pose;
}

Surface<2> outline(const Region& region) { return std::visit(MakeRegion{}, region.shape); }

Surface<2> outline(const Body& body) {
  auto surface = shape_of(body.shape).surface;
  surface.vertices = shape_pose(body) * surface.vertices;
  return surface;
}

Surface<2> tank_outline(const Tank& tank) {
  Surface<2> surface;
  surface.vertices.resize(2, 4);
  surface.vertices.row(0) << tank.min.x(), tank.min.x(), tank.max.x(), tank.max.x();
  surface.vertices.row(1) << tank.min.y(), tank.max.y(), tank.max.y(), tank.min.y();
  surface.facets.resize(2, 4);
  surface.facets << 0, 1, 2, 3, 1, 2, 3, 0;
  return surface;
}

Extents extents(const Surface<2>& surface) {
  Extents box;
  for (Eigen::Index i = 0; i < surface.vertices.cols(); ++i) box.extend(surface.vertices.col(i));
  return box;
}

double signed_distance(const Surface<2>& surface, const Vec<2>& point) {
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (Eigen::Index i = 0; i < surface.facets.cols(); ++i) {
    const Vec<2> a = start(surface, i), b = end(surface, i), edge = b - a;
    const double along = std::clamp((point - a).dot(edge) / edge.squaredNorm(), 0., 1.);
    nearest = std::min(nearest, (point - a - along * edge).norm());
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * edge.x())
      inside = !inside;
  }
  return inside ? -nearest : nearest;
}

bool overlap(const Surface<2>& a, const Surface<2>& b) {
  const auto box_a = extents(a), box_b = extents(b);
  const double tolerance = 1e-9 * (box_a.diagonal().norm() + box_b.diagonal().norm());
  if (!box_a.intersects(box_b)) return false;
  for (Eigen::Index i = 0; i < a.facets.cols(); ++i)
    for (Eigen::Index j = 0; j < b.facets.cols(); ++j)
      if (cross_properly(start(a, i), end(a, i), start(b, j), end(b, j), tolerance)) return true;
  if (reaches_into(a, b, tolerance) || reaches_into(b, a, tolerance)) return true;
  // Two outlines that coincide: neither crosses the other.
  return box_a.center().isApprox(box_b.center()) &&
         std::abs((box_a.sizes() - box_b.sizes()).norm()) < tolerance;
}

}  // namespace splashdown::apps
