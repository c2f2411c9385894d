// Where a pressure patch is: a convex piece of space in the frame of a body, cut out of the body's hull.
//
// A disc is a prism of 32 sides around the hull's normal, of the disc's area, as deep as its radius to both sides; in two
// dimensions a rectangle, that is a piece of 2 radius of the outline. It takes the facets that face as the hull does at
// its centre: in a thin plate not those of the other side. A box takes all that is inside it.
// Facets are cut exactly, and pressure is linear on a facet: so are integrals.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/geometry.hpp"

namespace splashdown::apps {

template <int d>
struct PatchRegion {
  struct Side {
    Vec<d> normal;
    double offset;  ///< inside: normal . x <= offset
  };
  std::vector<Side> sides;
  std::optional<Vec<d>> facing;  ///< only facets of the hull whose normal has a part along it
};

inline constexpr std::size_t disc_sides = 32;

template <int d>
PatchRegion<d> box_region(const Vec<d>& min, const Vec<d>& max) {
  PatchRegion<d> region;
  for (int k = 0; k < d; ++k) {
    region.sides.push_back({Vec<d>::Unit(k), max(k)});
    region.sides.push_back({-Vec<d>::Unit(k), -min(k)});
  }
  return region;
}

template <int d>
PatchRegion<d> disc_region(const Vec<d>& centre, double radius, const Vec<d>& normal) {
  PatchRegion<d> region;
  region.facing = normal;
  const auto bound = [&](const Vec<d>& direction, double reach) {
    region.sides.push_back({direction, direction.dot(centre) + reach});
  };
  bound(normal, radius);
  bound(-normal, radius);
  const Vec<d> across = normal.unitOrthogonal();
  if constexpr (d == 2) {
    bound(across, radius);
    bound(-across, radius);
  } else {
    const double step = 2 * std::numbers::pi / disc_sides;
    const double reach = radius * std::sqrt(std::numbers::pi / (disc_sides * std::tan(0.5 * step)));  // equal areas
    for (std::size_t k = 0; k < disc_sides; ++k)
      bound(Eigen::AngleAxisd(step * static_cast<double>(k), normal) * across, reach);
  }
  return region;
}

struct PatchIntegral {
  double area = 0, force = 0;  ///< of the region's part of a facet [m, m^2]; integral of the pressure over it [N/m, N]
};

namespace patch_detail {

/// The corners of what is left of a facet: position and pressure, in order. A cut adds one at most.
template <int d>
struct Piece {
  using Corner = Eigen::Matrix<double, d + 1, 1>;
  std::array<Corner, d + 2 + disc_sides + 1> corners;
  std::size_t size = 0;

  void add(const Corner& corner) {
    if (size < corners.size()) corners[size++] = corner;  // roundoff may cross a side twice: a corner of no area
  }
};

template <int d>
Piece<d> cut(const Piece<d>& piece, const typename PatchRegion<d>::Side& side) {
  Piece<d> rest;
  const auto excess = [&](std::size_t i) { return side.normal.dot(piece.corners[i].template head<d>()) - side.offset; };
  // A segment has one edge, a polygon as many as corners.
  for (std::size_t i = 0; i < piece.size; ++i) {
    const double here = excess(i);
    if (here <= 0) rest.add(piece.corners[i]);
    if (d == 2 && i + 1 == piece.size) break;
    const std::size_t next = (i + 1) % piece.size;
    const double there = excess(next);
    if ((here <= 0) == (there <= 0)) continue;
    rest.add(piece.corners[i] + here / (here - there) * (piece.corners[next] - piece.corners[i]));
  }
  return rest;
}

}  // namespace patch_detail

/// Of a facet of the hull or of the mesh on it, oriented like the hull, both in the body's frame.
template <int d>
PatchIntegral integrate(const PatchRegion<d>& region, const std::array<Vec<d>, d>& facet,
                        const std::array<double, d>& pressure) {
  if (region.facing && !(area_vector(facet).dot(*region.facing) > 0)) return {};
  for (const auto& side : region.sides) {
    bool outside = true;
    for (const auto& x : facet) outside = outside && side.normal.dot(x) >= side.offset;
    if (outside) return {};
  }
  patch_detail::Piece<d> piece;
  for (std::size_t k = 0; k < d; ++k) {
    typename patch_detail::Piece<d>::Corner corner;
    corner << facet[k], pressure[k];
    piece.add(corner);
  }
  for (const auto& side : region.sides) piece = patch_detail::cut<d>(piece, side);
  PatchIntegral integral;
  // A segment, or the fan of triangles of a convex polygon.
  for (std::size_t k = d - 1; k < piece.size; ++k) {
    std::array<Vec<d>, d> simplex;
    double sum = 0;
    for (std::size_t j = 0; j < d; ++j) {
      const auto& corner = piece.corners[j == 0 ? 0 : k + j + 1 - d];
      simplex[j] = corner.template head<d>();
      sum += corner(d);
    }
    const double area = area_vector(simplex).norm();
    integral.area += area;
    integral.force += area * sum / d;
  }
  return integral;
}

/// What the region holds of a surface [m, m^2].
template <int d, class Surface>
double patch_area(const PatchRegion<d>& region, const Surface& surface) {
  double area = 0;
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
    std::array<Vec<d>, d> facet;
    for (int k = 0; k < d; ++k) facet[static_cast<std::size_t>(k)] = surface.vertices.col(surface.facets(k, f));
    area += integrate<d>(region, facet, {}).area;
  }
  return area;
}

}  // namespace splashdown::apps
