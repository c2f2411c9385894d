// Outlines and fluids that tests of the grid share.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "fluid/vortex/fluid.hpp"
#include "tests/unit/core/outlines.hpp"

namespace splashdown::vortex::scenes {

using outlines::box;
using outlines::polygon;
inline Surface<2> circle(double radius, int corners = 200) { return outlines::circle(radius, corners); }

/// n x n squares over [-1, 1]^2.
inline Grid square_grid(int n, double half = 1) { return {.min = {-half, -half}, .h = 2 * half / n, .nx = n, .ny = n}; }

/// Vorticity at the nodes from a function of place.
template <class Function>
NodeField sampled(const Grid& g, Function omega) {
  NodeField field(g.nodes(), 0.0);
  for (int j = 1; j < g.ny; ++j)
    for (int i = 1; i < g.nx; ++i) field[g.at(i, j)] = omega(g.node(i, j));
  return field;
}

inline double circulation(const Grid& g, const NodeField& omega) {
  double sum = 0;
  for (const double w : omega) sum += w;
  return sum * g.h * g.h;
}

/// A vortex that diffuses (Lamb 1932, article 334a): 4 nu t = core^2.
struct LambOseen {
  double circulation, core;
  double omega(const Vec<2>& x) const {
    return circulation / (std::numbers::pi * core * core) * std::exp(-x.squaredNorm() / (core * core));
  }
  Vec<2> velocity(const Vec<2>& x) const {
    const double r2 = x.squaredNorm();
    return circulation / (2 * std::numbers::pi) * (r2 > 0 ? -std::expm1(-r2 / (core * core)) / r2 : 1 / (core * core)) *
           Vec<2>(-x.y(), x.x());
  }
};

}  // namespace splashdown::vortex::scenes
