#include "rigid/shapes/solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "rigid/message.hpp"
#include "rigid/shapes/require.hpp"

namespace splashdown::rigid {

namespace {

using std::numbers::pi;
using Triangle = std::array<int, 3>;

void require_around(const char* shape, int around) {
  const int fewest = 8;  // an octagon is the coarsest thing that may be called round
  if (around < fewest) throw std::invalid_argument(message(shape, ": ", around, " edges around; at least ", fewest));
}

Surface<3> surface_of(const std::vector<Vec<3>>& points, const std::vector<Triangle>& triangles) {
  Surface<3> surface;
  surface.vertices.resize(3, static_cast<Eigen::Index>(points.size()));
  surface.facets.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t i = 0; i < points.size(); ++i) surface.vertices.col(static_cast<Eigen::Index>(i)) = points[i];
  for (std::size_t i = 0; i < triangles.size(); ++i)
    surface.facets.col(static_cast<Eigen::Index>(i)) << triangles[i][0], triangles[i][1], triangles[i][2];
  return surface;
}

/// A circle about the axis; a point of the axis if `count` is 1.
struct Ring {
  double r, z;
  int count;
};

/// Triangles between neighbouring rings, from the bottom to the top, about the z axis.
class RingMesh {
 public:
  void add(const Ring& ring) {
    const int first = static_cast<int>(points_.size());
    for (int i = 0; i < ring.count; ++i) {
      const double angle = 2 * pi * i / ring.count;
      points_.push_back({ring.r * std::cos(angle), ring.r * std::sin(angle), ring.z});
    }
    if (first > 0) join(first - below_, below_, first, ring.count);
    below_ = ring.count;
  }
  Surface<3> surface() const { return surface_of(points_, triangles_); }

 private:
  /// Round both rings at once; the one that lags behind takes the next step.
  void join(int a, int na, int b, int nb) {
    int i = 0, j = 0;
    const int ends_a = na > 1 ? na : 0, ends_b = nb > 1 ? nb : 0;
    while (i < ends_a || j < ends_b) {
      const bool step_a = j == ends_b || (i < ends_a && (2L * i + 1) * nb <= (2L * j + 1) * na);
      const int at_a = a + i % na, at_b = b + j % nb;
      if (step_a)
        triangles_.push_back({at_a, a + ++i % na, at_b});
      else
        triangles_.push_back({at_a, b + ++j % nb, at_b});
    }
  }

  std::vector<Vec<3>> points_;
  std::vector<Triangle> triangles_;
  int below_ = 0;
};

/// Edges on a circle of radius r of a surface that is `steep` there (the sine of the angle between its normal and the
/// axis): of equal length as on the widest circle, and no larger turns than there.
int edges_around(double r, double widest, double steep, int around) {
  const int fewest = 6;
  if (r <= 0) return 1;
  return std::max(fewest, static_cast<int>(std::ceil(around * std::max(r / widest, steep) - 1e-9)));
}

/// Before they fill the memory: a needle has as many rings as it is longer than an edge around it.
void require_few_facets(const char* shape, double rings, int around) {
  const double most = 1e6;  // as of a hull from a file
  if (!(2 * rings * around <= most))
    throw std::invalid_argument(message(shape, ": it is too long for its width: ", rings, " rings of up to ", around,
                                        " edges; a hull has ", most, " facets at most"));
}

std::vector<Vec<2>> from_axis_to_axis(std::span<const Vec<2>> profile) {
  std::vector<Vec<2>> points(profile.begin(), profile.end());
  if (points.back().x() > 0) points.emplace_back(0, points.back().y());
  if (points.front().x() > 0) points.insert(points.begin(), Vec<2>(0, points.front().y()));
  return points;
}

void require_profile(std::span<const Vec<2>> profile) {
  if (profile.size() < 2)
    throw std::invalid_argument(message("revolved: ", profile.size(), " points; a profile needs at least 2"));
  for (std::size_t i = 0; i < profile.size(); ++i)
    if (!(profile[i].x() >= 0) || !profile[i].allFinite())
      throw std::invalid_argument(message("revolved: point ", i + 1, " (", profile[i].x(), ", ", profile[i].y(),
                                          ") must be finite, with a radius that is not negative"));
  // The profile's own points first, so that messages count as the user does.
  std::vector<Vec<2>> outline(profile.begin(), profile.end());
  if (outline.back().x() > 0) outline.emplace_back(0, outline.back().y());
  if (outline.front().x() > 0) outline.emplace_back(0, outline.front().y());
  try {
    polygon(outline);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(message("revolved: with its axis the profile is no outline. ", error.what()));
  }
}

}  // namespace

MassProperties<3> mass_properties_of_revolution(std::span<const Vec<2>> points) {
  auto profile = from_axis_to_axis(points);
  if (signed_area(profile) < 0) std::reverse(profile.begin(), profile.end());

  constexpr std::array<double, 3> node{-0.7745966692414834, 0, 0.7745966692414834},
      weight{5. / 9, 8. / 9, 5. / 9};                    // Gauss, on [-1, 1]
  double volume = 0, first = 0, second = 0, fourth = 0;  // int r^2, r^2 z, r^2 z^2, r^4 dz
  const double origin = profile.front().y();
  for (std::size_t i = 1; i < profile.size(); ++i)
    for (std::size_t g = 0; g < node.size(); ++g) {
      const double share = 0.5 * (1 + node[g]);
      const Vec<2> x = profile[i - 1] + share * (profile[i] - profile[i - 1]);
      const double dz = 0.5 * weight[g] * (profile[i].y() - profile[i - 1].y());
      const double r2 = x.x() * x.x(), z = x.y() - origin;
      volume += pi * r2 * dz;
      first += pi * r2 * z * dz;
      second += pi * r2 * z * z * dz;
      fourth += pi * r2 * r2 * dz;
    }
  MassProperties<3> p;
  p.mass = volume;
  p.centre.z() = origin + first / volume;
  const double across = fourth / 4 + second - first * first / volume;
  p.inertia.diagonal() << across, across, fourth / 2;
  return p;
}

Shape<3> sphere(double radius, int around) {
  require_positive("sphere", "radius", radius);
  require_around("sphere", around);
  // The icosahedron's corners and faces, and points (weights of three corners, sum n) on a grid on each face.
  const double g = std::numbers::phi;
  const std::array<Vec<3>, 12> corner{Vec<3>(-1, g, 0), {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                      {0, -1, -g},      {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  constexpr std::array<Triangle, 20> face{{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                           {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                           {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                           {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
  const double edge = std::atan(2.);                                        // seen from the centre
  const int n = 2 * static_cast<int>(std::ceil(around * edge / (4 * pi)));  // even: vertices on all axes
  std::vector<Vec<3>> points;
  std::vector<Triangle> triangles;
  std::map<std::vector<std::pair<int, int>>, int> known;  // by corners and weights: faces share their edges
  const auto vertex = [&](const Triangle& f, int i, int j) {
    const std::array<int, 3> weight{n - i - j, i, j};
    std::vector<std::pair<int, int>> key;
    Vec<3> x = Vec<3>::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      if (weight[k] > 0) key.emplace_back(f[k], weight[k]);
      x += weight[k] * corner[static_cast<std::size_t>(f[k])];
    }
    std::sort(key.begin(), key.end());
    const auto [place, is_new] = known.try_emplace(key, static_cast<int>(points.size()));
    if (is_new) points.push_back(radius * x.normalized());
    return place->second;
  };
  for (const auto& f : face)
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        triangles.push_back({vertex(f, i, j), vertex(f, i + 1, j), vertex(f, i, j + 1)});
        if (i + j + 1 < n) triangles.push_back({vertex(f, i + 1, j), vertex(f, i + 1, j + 1), vertex(f, i, j + 1)});
      }
  MassProperties<3> p;
  p.mass = 4. / 3 * pi * radius * radius * radius;
  p.inertia.diagonal().setConstant(0.4 * p.mass * radius * radius);
  return {surface_of(points, triangles), p};
}

Shape<3> box(const Vec<3>& size) {
  const char* const axes[] = {"length along x", "length along y", "length along z"};
  for (int k = 0; k < 3; ++k) require_positive("box", axes[k], size[k]);
  std::vector<Vec<3>> points;
  for (int i = 0; i < 8; ++i)
    points.push_back(Vec<3>((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, (i >> 2) - 0.5).cwiseProduct(size));
  const std::vector<Triangle> triangles{{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                        {1, 3, 7}, {1, 7, 5}, {3, 2, 6}, {3, 6, 7}, {2, 0, 4}, {2, 4, 6}};
  MassProperties<3> p;
  p.mass = size.prod();
  const Vec<3> squares = size.cwiseAbs2();
  p.inertia.diagonal() = p.mass / 12 * (Vec<3>::Constant(squares.sum()) - squares);
  return {surface_of(points, triangles), p};
}

Shape<3> cone(double deadrise, double radius, int around) {
  if (!(deadrise > 0 && deadrise < pi / 2))
    throw std::invalid_argument(
        message("cone: deadrise is ", deadrise * 180 / pi, " degrees; it must lie between 0 and 90"));
  require_positive("cone", "radius", radius);
  const double height = radius * std::tan(deadrise);
  const std::array<Vec<2>, 3> profile{Vec<2>(0, 0), {radius, height}, {0, height}};
  return revolved(profile, around);
}

Shape<3> capsule_of_revolution(double radius, double straight, int around) {
  require_positive("capsule", "radius", radius);
  require_positive("capsule", "straight length", straight);
  require_around("capsule", around);
  const double step = 2 * pi * radius / around, half = straight / 2;
  require_few_facets("capsule", straight / step, around);
  const int arcs = std::max(2, static_cast<int>(std::ceil(around / 4.))),
            bands = std::max(1, static_cast<int>(std::ceil(straight / step)));
  RingMesh mesh;
  const auto ring = [&](double angle, double shift) {  // angle from the equator, at the end of the straight part
    const double r = std::abs(angle) < pi / 2 * (1 - 1e-9) ? radius * std::cos(angle) : 0;
    mesh.add({r, shift + radius * std::sin(angle), edges_around(r, radius, 0, around)});
  };
  for (int i = arcs; i > 0; --i) ring(-pi / 2 * i / arcs, -half);
  for (int i = 0; i <= bands; ++i) mesh.add({radius, straight * i / bands - half, around});
  for (int i = 1; i <= arcs; ++i) ring(pi / 2 * i / arcs, half);
  Shape<3> shape{mesh.surface(), {}};
  const Eigen::Matrix<double, 3, Eigen::Dynamic> about_z = shape.surface.vertices;
  shape.surface.vertices << about_z.row(2), about_z.row(0), about_z.row(1);  // z, x, y to x, y, z: a rotation

  // The two half spheres' centroids lie 3 r / 8 from their flats.
  const double r2 = radius * radius, cylinder = pi * r2 * straight, ball = 4. / 3 * pi * r2 * radius;
  auto& p = shape.at_unit_density;
  p.mass = cylinder + ball;
  const double along = cylinder * r2 / 2 + 0.4 * ball * r2;
  const double across =
      cylinder * (r2 / 4 + straight * straight / 12) + ball * (0.4 * r2 + half * half + 2 * half * 3. / 8 * radius);
  p.inertia.diagonal() << along, across, across;
  return shape;
}

Shape<3> revolved(std::span<const Vec<2>> profile, int around) {
  require_around("revolved", around);
  require_profile(profile);
  auto points = from_axis_to_axis(profile);
  double widest = 0;
  for (const auto& point : points) widest = std::max(widest, point.x());
  if (signed_area(points) < 0) std::reverse(points.begin(), points.end());
  const double step = 2 * pi * widest / around;
  double rings = static_cast<double>(points.size());
  for (std::size_t i = 1; i < points.size(); ++i) rings += (points[i] - points[i - 1]).norm() / step;
  require_few_facets("revolved", rings, around);
  const auto steep = [&](std::size_t piece) {  // of the piece that ends at this point
    if (piece == 0 || piece == points.size()) return 0.;
    const Vec<2> along = points[piece] - points[piece - 1];
    return std::abs(along.y()) / along.norm();
  };
  RingMesh mesh;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) {
      const Vec<2> from = points[i - 1], along = points[i] - from;
      const int pieces = static_cast<int>(std::ceil(along.norm() / step));
      for (int k = 1; k < pieces; ++k) {
        const Vec<2> x = from + along * k / pieces;
        mesh.add({x.x(), x.y(), edges_around(x.x(), widest, steep(i), around)});
      }
    }
    const double r = points[i].x();
    mesh.add({r, points[i].y(), edges_around(r, widest, std::max(steep(i), steep(i + 1)), around)});
  }
  return {mesh.surface(), mass_properties_of_revolution(points)};
}

}  // namespace splashdown::rigid
