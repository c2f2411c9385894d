// Outlines, liquids and lattices that the tests of the fluid share.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "fluid/effects/gravity/gravity.hpp"
#include "fluid/pfem/fluid.hpp"
#include "fluid/pfem/initial/initial.hpp"
#include "fluid/pfem/mesh/delaunay/delaunay.hpp"

namespace splashdown::fluid::scenes {

inline constexpr double eps = std::numeric_limits<double>::epsilon();

inline double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// Closed outline through the points, in their order.
inline Surface<2> outline(const std::vector<Vec<2>>& points) {
  const int n = static_cast<int>(points.size());
  Surface<2> s{Eigen::Matrix2Xd(2, n), Eigen::Matrix2Xi(2, n)};
  for (int i = 0; i < n; ++i) {
    s.vertices.col(i) = points[i];
    s.facets.col(i) << i, (i + 1) % n;
  }
  return s;
}
inline Surface<2> rectangle(const Vec<2>& min, const Vec<2>& max) {
  return outline({min, {max.x(), min.y()}, max, {min.x(), max.y()}});
}
inline Surface<2> ellipse(double a, double b, int segments, const Vec<2>& centre = {0, 0}) {
  std::vector<Vec<2>> p;
  for (int i = 0; i < segments; ++i) {
    const double angle = 2 * std::numbers::pi * i / segments;
    p.push_back(centre + Vec<2>(a * std::cos(angle), b * std::sin(angle)));
  }
  return outline(p);
}
/// A star about the origin: tips at `outer`, hollow corners at `inner` between them.
inline Surface<2> star(int tips, double outer, double inner) {
  std::vector<Vec<2>> p;
  for (int i = 0; i < 2 * tips; ++i) {
    const double angle = std::numbers::pi * i / tips, r = i % 2 == 0 ? outer : inner;
    p.push_back(r * Vec<2>(std::cos(angle), std::sin(angle)));
  }
  return outline(p);
}
/// The same, extruded from z = -half to half. Corner i below, 2 tips + i above.
inline Surface<3> star(int tips, double outer, double inner, double half) {
  const int n = 2 * tips;
  const Surface<2> flat = star(tips, outer, inner);
  Surface<3> s{Eigen::Matrix3Xd::Zero(3, 2 * n + 2), Eigen::Matrix3Xi(3, 4 * n)};
  s.vertices.topLeftCorner(2, n) = s.vertices.block(0, n, 2, n) = flat.vertices;
  s.vertices.row(2) << Eigen::RowVectorXd::Constant(n, -half), Eigen::RowVectorXd::Constant(n, half), -half, half;
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    s.facets.col(4 * i) << 2 * n, next, i;
    s.facets.col(4 * i + 1) << 2 * n + 1, n + i, n + next;
    s.facets.col(4 * i + 2) << i, next, n + next;
    s.facets.col(4 * i + 3) << i, n + next, n + i;
  }
  return s;
}
/// The box between two corners.
inline Surface<3> block(const Vec<3>& min, const Vec<3>& max) {
  Surface<3> s{Eigen::Matrix3Xd(3, 8), Eigen::Matrix3Xi(3, 12)};
  for (int v = 0; v < 8; ++v)
    s.vertices.col(v) << (v & 1 ? max : min).x(), (v & 2 ? max : min).y(), (v & 4 ? max : min).z();
  s.facets << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
      2, 3, 5, 7, 1, 5, 6, 7, 4, 6, 3, 7,          //
      3, 1, 7, 6, 5, 4, 7, 3, 6, 2, 7, 5;
  return s;
}

/// Tip at the origin, axis up: height and radius of the base, which is flat.
inline Surface<3> cone(double radius, double height, int segments) {
  Surface<3> s{Eigen::Matrix3Xd(3, segments + 2), Eigen::Matrix3Xi(3, 2 * segments)};
  s.vertices.col(segments).setZero();
  s.vertices.col(segments + 1) << 0, 0, height;
  for (int i = 0; i < segments; ++i) {
    const double angle = 2 * std::numbers::pi * i / segments;
    s.vertices.col(i) << radius * std::cos(angle), radius * std::sin(angle), height;
    s.facets.col(2 * i) << segments, (i + 1) % segments, i;
    s.facets.col(2 * i + 1) << segments + 1, i, (i + 1) % segments;
  }
  return s;
}

inline Surface<3> together(const Surface<3>& a, const Surface<3>& b) {
  Surface<3> both;
  both.vertices.resize(3, a.vertices.cols() + b.vertices.cols());
  both.vertices << a.vertices, b.vertices;
  both.facets.resize(3, a.facets.cols() + b.facets.cols());
  both.facets << a.facets, (b.facets.array() + static_cast<int>(a.vertices.cols())).matrix();
  return both;
}

template <int d>
Surface<d> turned_inside_out(Surface<d> s) {
  s.facets.row(0).swap(s.facets.row(1));
  return s;
}

template <int d>
WallSpec<d> wall(const std::string& name, Surface<d> surface, double size) {
  WallSpec<d> w;
  w.name = name;
  w.surface = std::move(surface);
  w.size = size;
  return w;
}
inline WallSpec<2> wall(const std::string& name, Surface<2> surface, double size) {
  return wall<2>(name, std::move(surface), size);
}

inline std::vector<std::unique_ptr<Effect<2>>> no_effects() { return {}; }
inline std::vector<std::unique_ptr<Effect<2>>> gravity(const Vec<2>& g) {
  std::vector<std::unique_ptr<Effect<2>>> effects;
  effects.push_back(std::make_unique<Gravity<2>>(g));
  return effects;
}

/// Water of the given width and depth under y = 0 in an open tank.
inline FluidSpec<2> still_water(double width, double depth, double h) {
  FluidSpec<2> spec;
  spec.size = {.surface = h, .far = h};
  spec.liquids.push_back({rectangle({-0.5 * width, -depth}, {0.5 * width, 0}), {}});
  const double freeboard = depth;
  spec.walls.push_back(wall("tank", turned_inside_out(rectangle({-0.5 * width, -depth}, {0.5 * width, freeboard})), h));
  return spec;
}

/// Walls of a spec in their initial poses.
struct Placed {
  explicit Placed(const FluidSpec<2>& spec) {
    for (const auto& w : spec.walls) walls.emplace_back(w), poses.push_back(w.pose);
  }
  WallsAt<2> at() const { return {walls, poses}; }
  std::vector<Wall<2>> walls;
  std::vector<WallPlace<2>> poses;
};

/// Each node begins as many facets as it ends: the boundary is closed.
inline bool closed(const std::vector<Facet<2>>& boundary, std::size_t nodes) {
  std::vector<int> balance(nodes, 0);
  for (const auto& f : boundary) ++balance[f.nodes[0]], --balance[f.nodes[1]];
  for (int b : balance)
    if (b != 0) return false;
  return true;
}

/// Unit cube of lattice nodes, the inner ones shaken, wetting wall 0 everywhere but at the top, where p = 0.
template <int d>
struct Lattice {
  explicit Lattice(int n, double shake = 0.3, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-shake / n, shake / n);
    const int count = static_cast<int>(std::lround(std::pow(n + 1, d)));
    for (int i = 0; i < count; ++i) {
      Vec<d> x;
      bool inner = true;
      for (int k = 0, rest = i; k < d; ++k, rest /= n + 1) {
        const int at = rest % (n + 1);
        x[k] = static_cast<double>(at) / n;
        inner = inner && at > 0 && at < n;
      }
      const bool top = x[d - 1] == 1;
      if (inner)
        for (int k = 0; k < d; ++k) x[k] += any(random);
      WallTie tie;
      if (!inner && !top) tie.wall = 0;
      nodes.add(x, Vec<d>::Zero(), 0, tie, top);
    }
    const auto all = delaunay<d>(std::span<const Vec<d>>(nodes.x), {});
    mesh.cells = all.cells;
    for (std::size_t c = 0; c < all.cells.size(); ++c)
      for (int k = 0; k <= d; ++k)
        if (all.neighbours[c][k] < 0) add_facet(all.cells[c], k);
  }

  void add_facet(const std::array<int, d + 1>& cell, int opposite) {
    Facet<d> f;
    for (int k = 0, j = 0; k <= d; ++k)
      if (k != opposite) f.nodes[j++] = cell[k];
    Vec<d> out = Vec<d>::Zero();
    for (int n : f.nodes) out += (nodes.x[n] - nodes.x[cell[opposite]]) / d;
    if (out.dot(area_vector_of<d>(f, nodes.x)) < 0) std::swap(f.nodes[0], f.nodes[1]);
    bool top = true;
    for (int n : f.nodes) top = top && nodes.surface[n];
    f.wall = top ? -1 : 0;
    mesh.boundary.push_back(f);
  }

  Nodes<d> nodes;
  Mesh<d> mesh;
};

/// Independent random numbers in (-1, 1).
template <class Vector>
Vector random_vector(std::mt19937& random, Vector out) {
  std::uniform_real_distribution<double> any(-1, 1);
  for (auto& v : out.reshaped()) v = any(random);
  return out;
}

}  // namespace splashdown::fluid::scenes
