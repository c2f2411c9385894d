// Rest on still water by brute force: for tests of what finds it by descent. Knows nothing of the code that it is held against.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "rigid/types.hpp"

namespace splashdown::rigid::reference {

/// Area below y = level of a polygon, and its first moments.
struct Wet {
  double area = 0;
  Vec<2> first = Vec<2>::Zero();
};

inline Wet below(const std::vector<Vec<2>>& polygon, double level) {
  std::vector<Vec<2>> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (a.y() <= level) kept.push_back(a);
    if ((a.y() <= level) != (b.y() <= level)) kept.push_back(a + (level - a.y()) / (b.y() - a.y()) * (b - a));
  }
  Wet wet;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const Vec<2>&a = kept[i], &b = kept[(i + 1) % kept.size()];
    const double cross = a.x() * b.y() - a.y() * b.x();
    wet.area += cross / 2;
    wet.first += cross / 6 * (a + b);
  }
  return wet;
}

/// Of a hull whose outline, with a hollow closed by a straight lid between its rims, is `closed`, in the frame of its centre of mass.
struct Hull {
  std::vector<Vec<2>> outline, closed;
  std::vector<Vec<2>> rims;  ///< empty: no hollow
  double mass = 0;
};

inline std::vector<Vec<2>> moved(const std::vector<Vec<2>>& points, const Vec<2>& by, double turn) {
  std::vector<Vec<2>> all;
  for (const auto& x : points) all.push_back(by + Eigen::Rotation2Dd(turn) * x);
  return all;
}

/// Energy over g of a hull with its centre of mass at `place`, water of density rho up to y = 0.
inline double energy(const Hull& hull, const Vec<2>& place, double turn, double rho) {
  const auto rims = moved(hull.rims, place, turn);
  const bool dry = !rims.empty() && std::ranges::all_of(rims, [](const Vec<2>& x) { return x.y() > 0; });
  const Wet wet = below(moved(dry ? hull.closed : hull.outline, place, turn), 0);
  return hull.mass * place.y() - rho * wet.first.y();
}

/// Downhill from a start in short steps along each coordinate, the shorter the nearer: the bottom of its basin.
inline std::vector<double> bottom(const std::function<double(const std::vector<double>&)>& of, std::vector<double> at,
                                  const std::vector<double>& steps) {
  double now = of(at);
  for (double share = 1; share > 1e-6;) {
    bool better = false;
    double best = now;
    std::vector<double> to = at;
    for (std::size_t k = 0; k < at.size(); ++k)
      for (const double way : {1., -1.}) {
        auto beside = at;
        beside[k] += way * share * steps[k];
        if (const double there = of(beside); there < best - 1e-14 * std::abs(best))
          best = there, to = beside, better = true;
      }
    if (better)
      at = to, now = best;
    else
      share *= 0.5;
  }
  return at;
}

}  // namespace splashdown::rigid::reference
