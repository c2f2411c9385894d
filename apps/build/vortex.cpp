#include <algorithm>
#include <cmath>

#include "apps/build/build.hpp"
#include "apps/effects/wind/wind.hpp"
#include "apps/scene/geometry.hpp"

namespace splashdown::apps {
namespace {

/// Squares along an axis, a multiple of what far fields are coarsened by; where more do no harm, a length that fast transforms like.
int squares(double length, double h, bool exact) {
  constexpr double roundoff = 1e-9;
  if (exact) return static_cast<int>(std::lround(length / h));
  constexpr int unit = vortex::FarField::coarsening;
  for (int n = std::max(16, static_cast<int>(std::ceil(length / h - roundoff)));; ++n) {
    int rest = n;
    for (const int factor : {2, 3, 5, 7})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1 && n % unit == 0) return n;
  }
}

/// Linear between rows, constant before the first and after the last.
std::function<Vec<2>(double)> stream_of(const std::vector<std::vector<double>>& rows) {
  if (rows.empty()) return {};
  return [rows](double time) {
    const auto velocity = [](const std::vector<double>& row) { return Vec<2>(row[1], row[2]); };
    const auto next = std::ranges::upper_bound(rows, time, {}, [](const auto& row) { return row[0]; });
    if (next == rows.begin()) return velocity(rows.front());
    if (next == rows.end()) return velocity(rows.back());
    const auto& last = *(next - 1);
    const double share = (time - last[0]) / ((*next)[0] - last[0]);
    return Vec<2>(velocity(last) + share * (velocity(*next) - velocity(last)));
  };
}

}  // namespace

vortex::GridFlowSpec vortex_spec(const Scene& scene) {
  const auto& fluid = *scene.vortex;
  vortex::GridFlowSpec spec;
  spec.density = fluid.density;
  spec.viscosity = fluid.viscosity / fluid.density;
  const Vec<2> size = vec<2>(fluid.max - fluid.min);
  const bool exact = fluid.sides == "slip" && !scene.tank;  // its sides are where walls are
  spec.grid = {.h = fluid.size, .nx = squares(size.x(), fluid.size, exact), .ny = squares(size.y(), fluid.size, exact)};
  // What fast transforms add goes to both sides.
  spec.grid.min = 0.5 * (vec<2>(fluid.min + fluid.max) - fluid.size * Vec<2>(spec.grid.nx, spec.grid.ny));
  spec.sides = fluid.sides == "slip" ? vortex::SideKind::slip : vortex::SideKind::free;
  spec.stream = stream_of(fluid.stream);
  if (const auto* table = scene.effects.find<WindTable>())
    spec.stream = [wind = wind_of<2>(*table, scene)](double time) { return wind.at(Vec<2>::Zero(), time); };
  if (scene.gravity) spec.gravity = vec<2>(scene.gravity->acceleration);
  spec.penalisation.smoothing = fluid.smoothing;
  spec.penalisation.rate = fluid.rate;
  spec.penalisation.passes = fluid.passes;
  spec.remeshing = fluid.kernel == "m6" ? vortex::Remeshing::m6 : vortex::Remeshing::m4;
  spec.paths = fluid.paths == "rk4" ? vortex::PathRule::rk4 : vortex::PathRule::rk2;
  spec.diffusion_order = fluid.stencil == "fourth_order" ? 4 : 2;
  spec.cfl = scene.time.cfl;
  for (const auto& body : scene.bodies) {
    const auto made = body_spec<2>(body);
    spec.walls.push_back({.name = made.name,
                          .surface = made.surface,
                          .pose = made.pose,
                          .velocity = made.velocity,
                          .size = fluid.size,
                          .sticks = true});
  }
  if (scene.tank) spec.walls.push_back({.name = "tank", .surface = tank_outline<2>(*scene.tank), .size = fluid.size});
  return spec;
}

}  // namespace splashdown::apps
