// Hulls in still water, drawn at random: their lowest corner or their deck is as near to the water line as is asked for.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/unit/fluid/scenes.hpp"

namespace splashdown::fluid::scenes {

/// The part of a convex polygon below y = 0.
inline std::vector<Vec<2>> under_water(const std::vector<Vec<2>>& p) {
  std::vector<Vec<2>> below;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec<2>&a = p[i], &b = p[(i + 1) % p.size()];
    if (a.y() < 0) below.push_back(a);
    if ((a.y() < 0) != (b.y() < 0)) below.push_back(a + a.y() / (a.y() - b.y()) * (b - a));
  }
  return below;
}

/// Area that a polygon encloses, anticlockwise.
inline double area_of(const std::vector<Vec<2>>& p) {
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec<2>&a = p[i], &b = p[(i + 1) % p.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

/// Where a hull meets the water line.
enum class Afloat { box_at_small_draft, box_of_small_freeboard, tilted_box, wedge, any_corners, beside_wall };

struct HullAfloat {
  FluidSpec<2> fluid;           ///< the hull is its first wall, the tank its last
  std::vector<Vec<2>> corners;  ///< of the hull
  double near;                  ///< distance of its corner from the water line, over the size of its elements
  double water;                 ///< of the liquid that is stated [m^2]
};

/// A hull about 1 m long. `least`, `most`: bounds of `near`, whose logarithm is drawn.
inline HullAfloat hull_afloat(Afloat kind, unsigned seed, double least, double most) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const double size = between(0.04, 0.12), near = std::exp(between(std::log(least), std::log(most)));
  const double height = std::max(between(0.2, 0.5), 1.2 * near * size);
  HullAfloat hull{{}, {}, near, 0};
  auto& p = hull.corners = {{-0.5, 0}, {0.5, 0}, {0.5, height}, {-0.5, height}};
  double angle = 0;
  if (kind == Afloat::tilted_box) angle = between(0.03, 0.7);
  if (kind == Afloat::wedge)
    p = {{0, 0}, {0.5, between(0.05, 0.5)}, {0.5, 0.6}, {-0.5, 0.6}, {-0.5, between(0.05, 0.5)}};
  if (kind == Afloat::any_corners) {  // on an ellipse, so that it is convex
    p.clear();
    const int count = 3 + static_cast<int>(random() % 5);
    const double phase = between(0, 6);
    for (int k = 0; k < count; ++k) {
      const double t = phase + 2 * std::numbers::pi * (k + between(-0.3, 0.3)) / count;
      p.emplace_back(0.5 * std::cos(t), 0.3 * std::sin(t));
    }
  }
  for (Vec<2>& x : p) x = Eigen::Rotation2Dd(angle) * x;
  const auto [low, high] = std::ranges::minmax(p, {}, [](const Vec<2>& x) { return x.y(); });
  const double bottom = low.y(), top = high.y();
  const bool at_deck =
      kind == Afloat::box_of_small_freeboard || (kind != Afloat::box_at_small_draft && random() % 3 == 0);
  const double up = at_deck ? near * size - top : -near * size - bottom;
  const double gap = kind == Afloat::beside_wall ? size * between(0.5, 3) : 1;
  for (Vec<2>& x : p) x.y() += up;
  const double surface = size * between(1, 2);
  const double right = std::ranges::max(p, {}, [](const Vec<2>& x) { return x.x(); }).x() + gap;
  hull.fluid.size = {.surface = surface, .far = 3 * surface};
  hull.fluid.liquids.push_back({rectangle({-1.5, -1}, {right, 0}), {}});
  hull.fluid.walls.push_back(wall("hull", outline(p), size));
  hull.fluid.walls.push_back(wall("tank", turned_inside_out(rectangle({-1.5, -1}, {right, 1})), 3 * surface));
  hull.water = right + 1.5 - area_of(under_water(p));
  return hull;
}

}  // namespace splashdown::fluid::scenes
