#include "apps/new/tank.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/new/numbers.hpp"

namespace splashdown::apps {
namespace {

struct Room {
  double wall = 0, floor = 0;  ///< distance from the middle; depth [m]
};

template <int d>
Room room_of(const Measures<d>& m, double accuracy) {
  const double r = m.reach();
  if (d == 2) return {r * std::sqrt(2 / accuracy), r / std::sqrt(accuracy)};
  return {r * std::cbrt(1.5 / accuracy), r * std::cbrt(0.75 / accuracy)};
}

void tell_tank(const NewOptions& options, const Tank& tank, int up, LandingPlan& plan) {
  const double behind = -tank.min[0], beside = up == 2 ? tank.max[1] : behind, ahead = tank.max[0];
  const std::string walls = up == 2 && beside != behind
                                ? fmt::format("{:g} m behind, {:g} m beside", behind, beside)
                                : fmt::format("{:g} m {}", behind, up == 2 ? "behind and beside" : "behind");
  plan.told.push_back(
      {"tank",
       fmt::format("from the middle of the hull {}, {:g} m ahead{}; water {:g} m deep{}: walls and floor change the "
                   "added mass by {:g} % at most (a dipole's images; Lamb 1932, articles 99 and 137)",
                   walls, ahead, options.forward > 0 ? ", so that the hull stays inside at full speed" : "",
                   -tank.min[up], options.depth ? " (--depth, not by this rule)" : "", options.accuracy)});
}

}  // namespace

template <int d>
void choose_tank(const NewOptions& options, const Measures<d>& m, const Entry& entry, LandingPlan& plan) {
  auto& scene = plan.scene;
  const auto& body = scene.bodies.front();
  const auto room = room_of<d>(m, options.accuracy / 100);
  const double after = scene.time.end - entry.time, plunge = std::min(entry.speed * after, 2 * m.height);
  const double beside = std::max(room.wall, 0.5 * m.breadth + 0.5 * m.length),
               behind = std::max(room.wall, 0.75 * m.length);
  const double forward = body.velocity[0];
  const double ahead = forward == 0 ? behind
                                    : std::max(forward * (entry.time + entry.peak_time()) + behind,
                                               forward * scene.time.end + 0.75 * m.length);
  const double above = body.position[d - 1] + m.box.max()[d - 1] + 0.5 * std::max(m.length, m.height);
  Tank tank;
  tank.min[0] = -rounded_up(behind);
  tank.max[0] = rounded_up(ahead);
  if (d == 3) tank.min[1] = -rounded_up(beside), tank.max[1] = rounded_up(beside);
  tank.min[d - 1] = options.depth ? -*options.depth : -rounded_up(std::max(room.floor, plunge + 0.5 * m.height));
  tank.max[d - 1] = rounded_up(above);
  tell_tank(options, tank, d - 1, plan);
  if (options.depth && *options.depth < plunge)
    plan.told.push_back(
        {"tank", fmt::format("QUESTION: the hull may sink by {:.2g} m, and the water is {:g} m deep: will it meet "
                             "the floor?",
                             plunge, *options.depth)});
  scene.tank = tank;
  BoxRegion water{.min = tank.min, .max = tank.max};
  water.max[d - 1] = 0;
  scene.fluid->regions = {{.shape = water}};
}

template void choose_tank<2>(const NewOptions&, const Measures<2>&, const Entry&, LandingPlan&);
template void choose_tank<3>(const NewOptions&, const Measures<3>&, const Entry&, LandingPlan&);

}  // namespace splashdown::apps
