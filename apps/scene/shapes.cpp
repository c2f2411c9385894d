#include <cmath>
#include <stdexcept>
#include <vector>

#include "apps/scene/geometry.hpp"
#include "rigid/shapes/solids.hpp"
#include "rigid/shapes/spline.hpp"

namespace splashdown::apps {
namespace {

using rigid::Vec;

rigid::Spline spline_of(const SplineShape& s) {
  rigid::Spline spline{{}, s.degree, s.closed, s.tolerance};
  for (const auto& point : s.points) spline.points.push_back(vec<2>(point));
  return spline;
}

// The reader offers no shape of the other dimension.
template <int d>
struct MakeShape;

template <>
struct MakeShape<2> {
  template <class Other>
  rigid::Shape<2> operator()(const Other&) const {
    throw std::invalid_argument("a shape of three dimensions");
  }
  rigid::Shape<2> operator()(const PolygonShape& s) const {
    std::vector<Vec<2>> points;
    for (const auto& point : s.points) points.push_back(vec<2>(point));
    return rigid::polygon(points);
  }
  rigid::Shape<2> operator()(const WedgeShape& s) const {
    const double chine = s.breadth / 2 * std::tan(s.deadrise_deg * radians);
    const double side = s.height.value_or(chine) - chine;
    // A height given to print precision of the chine means no side at all.
    return rigid::wedge(s.deadrise_deg * radians, s.breadth, std::abs(side) < 1e-6 * chine ? 0 : side);
  }
  rigid::Shape<2> operator()(const RectangleShape& s) const { return rigid::box(s.width, s.height); }
  rigid::Shape<2> operator()(const CircleShape& s) const { return rigid::circle(s.radius); }
  rigid::Shape<2> operator()(const EllipseShape& s) const { return rigid::ellipse(s.semi_axes.x(), s.semi_axes.y()); }
  rigid::Shape<2> operator()(const SplineShape& s) const { return rigid::outline_of(spline_of(s)); }
  rigid::Shape<2> operator()(const CapsuleShape& s) const { return rigid::capsule(s.radius, s.length); }
};

template <>
struct MakeShape<3> {
  template <class Other>
  rigid::Shape<3> operator()(const Other&) const {
    throw std::invalid_argument("a shape of two dimensions");
  }
  rigid::Shape<3> operator()(const SphereShape& s) const { return rigid::sphere(s.radius); }
  rigid::Shape<3> operator()(const BoxShape& s) const { return rigid::box(s.size); }
  rigid::Shape<3> operator()(const ConeShape& s) const { return rigid::cone(s.deadrise_deg * radians, s.radius); }
  rigid::Shape<3> operator()(const CapsuleShape& s) const { return rigid::capsule_of_revolution(s.radius, s.length); }
  rigid::Shape<3> operator()(const RevolvedShape& s) const {
    std::vector<Vec<2>> profile;
    for (const auto& [r, z] : s.profile) profile.emplace_back(r, z);
    return rigid::revolved(profile);
  }
  rigid::Shape<3> operator()(const SplineShape& s) const { return rigid::solid_of(spline_of(s)); }
  rigid::Shape<3> operator()(const SurfaceShape& s) const {
    if (!s.read) throw std::invalid_argument("the file could not be read");
    return *s.read;
  }
};

}  // namespace

template <int d>
rigid::Shape<d> shape_of(const Shape& shape) {
  return std::visit(MakeShape<d>{}, shape);
}

template rigid::Shape<2> shape_of<2>(const Shape&);
template rigid::Shape<3> shape_of<3>(const Shape&);

}  // namespace splashdown::apps
