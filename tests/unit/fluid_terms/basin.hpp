// A basin of water with a flat or wavy surface, stepped by the fluid alone.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "fluid/effects/gravity/gravity.hpp"
#include "fluid/pfem/fluid.hpp"
#include "tests/unit/coupling/watched.hpp"

namespace splashdown::fluid::testing {

struct Basin {
  double length = 1, depth = 0.5, size = 0.05;
  double amplitude = 0;  ///< of the surface, cos(2 pi x / length)
  bool sticks = false;
  double cfl = 0.5, dt_max = 0.01;

  FluidSpec<2> spec() const {
    FluidSpec<2> out;
    out.size = {.surface = size, .far = size};
    out.step = {.cfl = cfl, .dt_max = dt_max};
    WallSpec<2> tank;
    tank.name = "tank";
    tank.surface = box(Vec<2>(0, -depth), Vec<2>(length, 0.5 * depth), true);
    tank.size = size;
    tank.sticks = sticks;
    out.walls.push_back(tank);
    LiquidSpec<2> water;
    water.boundary = wavy_box();
    out.liquids.push_back(water);
    return out;
  }

  static Surface<2> box(const Vec<2>& low, const Vec<2>& high, bool clockwise) {
    Surface<2> s;
    s.vertices.resize(2, 4);
    s.vertices << low.x(), high.x(), high.x(), low.x(), low.y(), low.y(), high.y(), high.y();
    if (clockwise) s.vertices = s.vertices.rowwise().reverse().eval();
    return close(std::move(s));
  }

  Surface<2> wavy_box() const {
    const int steps = amplitude == 0 ? 1 : 400;
    Surface<2> s;
    s.vertices.resize(2, steps + 3);
    s.vertices.col(0) = Vec<2>(0, -depth);
    s.vertices.col(1) = Vec<2>(length, -depth);
    for (int k = 0; k <= steps; ++k) {
      const double x = length * (1 - static_cast<double>(k) / steps);
      s.vertices.col(k + 2) = Vec<2>(x, amplitude * std::cos(2 * std::numbers::pi * x / length));
    }
    return close(std::move(s));
  }

 private:
  static Surface<2> close(Surface<2> s) {
    const int n = static_cast<int>(s.vertices.cols());
    s.facets.resize(2, n);
    for (int k = 0; k < n; ++k) s.facets.col(k) << k, (k + 1) % n;
    return s;
  }
};

template <class... Effects>
coupling::scenes::Watched<2> water(const Basin& basin, std::unique_ptr<Effects>... effects) {
  std::vector<std::unique_ptr<Effect<2>>> list;
  (list.push_back(std::move(effects)), ...);
  return coupling::scenes::Watched<2>(std::make_unique<Fluid<2>>(basin.spec(), std::move(list)));
}

inline std::unique_ptr<Gravity<2>> gravity() { return std::make_unique<Gravity<2>>(Vec<2>(0, -9.81)); }

/// Steps to `end`; calls `look(fluid, dt)` between attempt and commit. False if a step is refused.
template <class Look>
bool run(coupling::scenes::Watched<2>& stepper, double end, Look look) {
  while (stepper.fluid().time() < end * (1 - 1e-12)) {
    const double dt = std::min(stepper.stable_dt(), end - stepper.fluid().time());
    if (!stepper.attempt(dt).cause.empty()) return false;
    look(stepper.fluid(), dt);
    stepper.commit();
  }
  return true;
}

inline double max_speed(const Fluid<2>& fluid) {
  double squared = 0;
  for (std::size_t i = 0; i < fluid.nodes().size(); ++i) squared = std::max(squared, fluid.velocity_n(i).squaredNorm());
  return std::sqrt(squared);
}

inline double kinetic_energy(const Fluid<2>& fluid) {
  const auto& x = fluid.nodes().x;
  double sum = 0;
  for (const auto& cell : fluid.mesh().cells)
    for (int n : cell) sum += volume<2>(corners(x, cell)) / 3 * fluid.velocity_n(n).squaredNorm();
  return 0.5 * fluid.spec().density * sum;
}

}  // namespace splashdown::fluid::testing
