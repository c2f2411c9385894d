#include "apps/scene/tank_sides.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace splashdown::apps {
namespace {

template <int d>
bool is_filled_to_the_top(const Scene& scene) {
  if (!scene.fluid) return false;
  const auto tank = extents<d>(*scene.tank);
  const double roundoff = 1e-9 * tank.diagonal().norm();
  return std::ranges::any_of(scene.fluid->regions, [&](const Region& region) {
    return extents<d>(outline<d>(region)).max()[d - 1] > tank.max()[d - 1] - roundoff;
  });
}

template <int d>
std::string side_name(int axis, bool upper, double at) {
  if (axis == d - 1) return upper ? "the tank's top" : "the tank's floor";
  return fmt::format("the tank's side at {} = {:.4g} m", "xy"[axis], at);
}

}  // namespace

template <int d>
std::vector<TankSide<d>> tank_sides(const Scene& scene) {
  if (!scene.tank) return {};
  using rigid::Vec;
  const Vec<d> min = vec<d>(scene.tank->min), max = vec<d>(scene.tank->max);
  const bool has_top = is_filled_to_the_top<d>(scene);
  std::vector<TankSide<d>> sides;
  for (int k = 0; k < d; ++k) {
    sides.push_back({side_name<d>(k, false, min[k]), min, Vec<d>::Unit(k)});
    if (k < d - 1 || has_top) sides.push_back({side_name<d>(k, true, max[k]), max, -Vec<d>::Unit(k)});
  }
  return sides;
}

template std::vector<TankSide<2>> tank_sides<2>(const Scene&);
template std::vector<TankSide<3>> tank_sides<3>(const Scene&);

}  // namespace splashdown::apps
