// Facets of water around a box, divided at random, with hydrostatic pressure: walls that probes can be read on.
#pragma once

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "apps/record/wall_facets.hpp"

namespace splashdown::apps {

template <int d>
struct BoxOfWater {
  std::vector<Vec<d>> x;
  std::vector<double> p;
  std::vector<Facet<d>> boundary;
  Surface<d> hull;

  WallFacets<d> wall(const Isometry<d>& pose) const { return {x, boundary, 0, pose}; }
};

inline constexpr double weight = 9810;  // of water [N/m^3]
template <int d>
double hydrostatic(const Vec<d>& x) {
  return -weight * x(d - 1);
}

/// A box of half side 1/2 around the origin, normals outward: eight corners and twelve triangles, or a square.
template <int d>
Surface<d> unit_box() {
  Surface<d> box;
  if constexpr (d == 2) {
    box.vertices.resize(2, 4);
    box.vertices << -0.5, 0.5, 0.5, -0.5, -0.5, -0.5, 0.5, 0.5;
    box.facets.resize(2, 4);
    box.facets << 0, 1, 2, 3, 1, 2, 3, 0;
  } else {
    box.vertices.resize(3, 8);
    for (int i = 0; i < 8; ++i) box.vertices.col(i) << (i & 1) - 0.5, ((i >> 1) & 1) - 0.5, (i >> 2) - 0.5;
    box.facets.resize(3, 12);
    box.facets << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
        3, 2, 5, 7, 1, 5, 7, 6, 4, 6, 3, 7,            //
        1, 3, 7, 6, 5, 4, 3, 7, 6, 2, 7, 5;
  }
  return box;
}

/// `pose` of the box. Each facet is cut in pieces at random points, so that none of its edges fits a patch.
template <int d>
BoxOfWater<d> box_of_water(const Isometry<d>& pose, int cuts = 200) {
  BoxOfWater<d> box;
  box.hull = unit_box<d>();
  for (Eigen::Index v = 0; v < box.hull.vertices.cols(); ++v) {
    const Vec<d> x = pose * Vec<d>(box.hull.vertices.col(v));
    box.x.push_back(x);
    box.p.push_back(hydrostatic<d>(x));
  }
  std::vector<std::array<int, d>> facets;
  for (Eigen::Index f = 0; f < box.hull.facets.cols(); ++f) {
    std::array<int, d> facet;
    for (int k = 0; k < d; ++k) facet[static_cast<std::size_t>(k)] = box.hull.facets(k, f);
    facets.push_back(facet);
  }
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.2, 0.8);
  for (int c = 0; c < cuts; ++c) {
    const std::size_t f = random() % facets.size();
    std::array<double, d> weights;
    double sum = 0;
    for (auto& w : weights) sum += w = share(random);
    Vec<d> x = Vec<d>::Zero();
    for (std::size_t k = 0; k < d; ++k) x += weights[k] / sum * box.x[static_cast<std::size_t>(facets[f][k])];
    const int point = static_cast<int>(box.x.size());
    box.x.push_back(x);
    box.p.push_back(hydrostatic<d>(x));
    const auto whole = facets[f];
    for (std::size_t k = 0; k < d; ++k) {
      auto piece = whole;
      piece[k] = point;
      if (k == 0)
        facets[f] = piece;
      else
        facets.push_back(piece);
    }
  }
  for (auto facet : facets) {
    std::reverse(facet.begin(), facet.end());  // out of the fluid is into the box
    box.boundary.push_back({facet, 0});
  }
  return box;
}

}  // namespace splashdown::apps
