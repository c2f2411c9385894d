#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "apps/scene/geometry.hpp"
#include "core/surface/unite.hpp"
#include "rigid/shapes/solids.hpp"

namespace splashdown::apps {
namespace {

using rigid::Surface;
using rigid::Vec;
using std::numbers::pi;

template <int d>
Surface<d> shifted(Surface<d> surface, const Point& by) {
  surface.vertices.colwise() += vec<d>(by);
  return surface;
}

// The reader offers no region of the other dimension.
template <int d>
struct MakeRegion;

template <int d>
Surface<d> united_parts(const UnionRegion& region) {
  std::vector<Surface<d>> parts;
  for (const auto& part : region.parts) parts.push_back(std::visit(MakeRegion<d>{}, part.shape));
  return splashdown::united<d>(parts);
}

template <>
struct MakeRegion<2> {
  template <class Other>
  Surface<2> operator()(const Other&) const {
    throw std::invalid_argument("a region of three dimensions");
  }
  Surface<2> operator()(const BoxRegion& r) const {
    std::vector<Vec<2>> points{vec<2>(r.min), {r.max.x(), r.min.y()}};
    // A chord of 1/200 of the wavelength misses a cosine by 1.2e-4 of its amplitude.
    const double waves = r.surface_wavelength > 0 ? (r.max.x() - r.min.x()) / r.surface_wavelength : 0;
    const int pieces = std::max(1, static_cast<int>(std::ceil(200 * waves)));
    for (int i = pieces; i >= 0; --i) {
      const double s = (r.max.x() - r.min.x()) * i / pieces;
      const double wave =
          r.surface_wavelength > 0 ? std::cos(2 * pi * s / r.surface_wavelength + r.surface_phase_deg * radians) : 0;
      points.emplace_back(i == pieces ? r.max.x() : r.min.x() + s, r.max.y() + r.surface_amplitude * wave);
    }
    return rigid::polygon(points).surface;
  }
  Surface<2> operator()(const CircleRegion& r) const { return shifted<2>(rigid::circle(r.radius).surface, r.centre); }
  Surface<2> operator()(const EllipseRegion& r) const {
    return shifted<2>(rigid::ellipse(r.semi_axes.x(), r.semi_axes.y()).surface, r.centre);
  }
  Surface<2> operator()(const PolygonRegion& r) const {
    std::vector<Vec<2>> points;
    for (const auto& point : r.points) points.push_back(vec<2>(point));
    return rigid::polygon(points).surface;
  }
  Surface<2> operator()(const SplineRegion& r) const { return shifted<2>(shape_of<2>(r.shape).surface, r.position); }
  Surface<2> operator()(const UnionRegion& r) const { return united_parts<2>(r); }
};

template <>
struct MakeRegion<3> {
  template <class Other>
  Surface<3> operator()(const Other&) const {
    throw std::invalid_argument("a region of two dimensions");
  }
  Surface<3> operator()(const BoxRegion& r) const {
    return shifted<3>(rigid::box(r.max - r.min).surface, 0.5 * (r.min + r.max));
  }
  Surface<3> operator()(const RevolvedRegion& r) const { return shifted<3>(shape_of<3>(r.shape).surface, r.position); }
  Surface<3> operator()(const SplineRegion& r) const { return shifted<3>(shape_of<3>(r.shape).surface, r.position); }
  Surface<3> operator()(const UnionRegion& r) const { return r.whole ? *r.whole : united_parts<3>(r); }
  Surface<3> operator()(const SphereRegion& r) const { return shifted<3>(rigid::sphere(r.radius).surface, r.centre); }
};

}  // namespace

template <int d>
Surface<d> outline(const Region& region) {
  return std::visit(MakeRegion<d>{}, region.shape);
}

void unite_in_space(UnionRegion& region) {
  region.whole.reset();
  try {
    region.whole = std::make_shared<const Surface<3>>(united_parts<3>(region));
  } catch (const std::invalid_argument&) {  // `outline` tells why
  }
}

template Surface<2> outline<2>(const Region&);
template Surface<3> outline<3>(const Region&);

}  // namespace splashdown::apps
