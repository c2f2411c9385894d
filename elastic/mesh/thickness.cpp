#include "elastic/mesh/thickness.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/facet_tree.hpp"

namespace splashdown::elastic {
namespace {

/// A point of the surface that stands for an area.
struct Sample {
  Vec<3> at, inward;
  double area;
};

/// Centroids of parts of facets, whose edges are about `size` long where the facets are larger.
std::vector<Sample> samples_of(const Surface<3>& surface, double size) {
  constexpr int finest = 32;  // parts along an edge
  std::vector<Sample> all;
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
    const Vec<3> a = surface.vertices.col(surface.facets(0, f)), b = surface.vertices.col(surface.facets(1, f)),
                 c = surface.vertices.col(surface.facets(2, f));
    const Vec<3> area = 0.5 * (b - a).cross(c - a);
    if (!(area.norm() > 0)) continue;
    const double longest = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
    const int n = static_cast<int>(std::clamp(std::ceil(longest / size), 1., double(finest)));
    const auto add = [&](double s, double t) {
      all.push_back({a + s / n * (b - a) + t / n * (c - a), -area.normalized(), area.norm() / (n * n)});
    };
    for (int i = 0; i < n; ++i)
      for (int k = 0; k + i < n; ++k) {
        add(i + 1. / 3, k + 1. / 3);
        if (k + i + 1 < n) add(i + 2. / 3, k + 2. / 3);
      }
  }
  return all;
}

/// Radius of the largest ball inside that touches the surface at the sample.
double ball_at(const Sample& sample, const FacetTree<3>& tree, double most) {
  double radius = most;
  constexpr int enough = 30;
  constexpr double near = 1e-6;  // relative: the ball's own side is farther
  for (int step = 0; step < enough; ++step) {
    const Vec<3> centre = sample.at + radius * sample.inward;
    const auto hit = tree.nearest(centre, radius * (1 - near));
    if (hit.facet < 0) break;
    const Vec<3> arm = hit.point - sample.at;
    const double depth = arm.dot(sample.inward);
    if (!(depth > 0)) break;
    radius = std::min(radius * (1 - near), arm.squaredNorm() / (2 * depth));
  }
  return radius;
}

}  // namespace

VolumeForecast forecast(const Surface<3>& surface, double size) {
  const FacetTree<3> tree(surface.vertices, surface.facets);
  const auto samples = samples_of(surface, size);
  const Vec<3> sides = surface.vertices.rowwise().maxCoeff() - surface.vertices.rowwise().minCoeff();
  constexpr std::size_t enough = 1000;
  const std::size_t stride = std::max<std::size_t>(1, samples.size() / enough);
  std::vector<std::pair<double, double>> thick;  // thickness and area
  double total = 0;
  for (std::size_t k = 0; k < samples.size(); k += stride) {
    thick.emplace_back(2 * ball_at(samples[k], tree, sides.minCoeff() / 2), samples[k].area);
    total += samples[k].area;
  }
  std::ranges::sort(thick);
  constexpr double few = 0.2;  // sharp edges are thin anywhere
  VolumeForecast told;
  double sum = 0;
  for (const auto& [thickness, area] : thick)
    if ((sum += area) > few * total) {
      told.thin = thickness;
      break;
    }
  constexpr double across = 1.6;  // longest edge over the thickness of a plate that is thinner than `size`, measured
  constexpr double packing = 45;  // elements in the cube of the longest edge, the same
  double weights = 0, density = 0, volume = 0;
  for (const auto& [thickness, area] : thick) {
    const double edge = std::min(size, across * std::max(thickness, told.thin)), weight = area * thickness;
    weights += weight;
    density += weight / (edge * edge * edge);
  }
  for (const auto& sample : samples) volume -= sample.area * sample.at.dot(sample.inward) / 3;
  told.elements = packing * volume * density / weights;
  return told;
}

}  // namespace splashdown::elastic
