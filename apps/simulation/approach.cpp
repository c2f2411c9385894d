#include "apps/simulation/approach.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "rigid/body.hpp"

namespace splashdown::apps {
namespace {

template <int d>
using Box = Eigen::AlignedBox<double, d>;

template <int d>
std::vector<char> wet_bodies(const FluidView<d>& fluid, std::size_t count) {
  std::vector<char> wet(count, 0);
  for (const auto& facet : fluid.boundary())
    if (facet.wall >= 0 && static_cast<std::size_t>(facet.wall) < count) wet[static_cast<std::size_t>(facet.wall)] = 1;
  return wet;
}

}  // namespace

template <int d>
double approach_dt(const FluidView<d>& fluid, const rigid::Bodies<d>& bodies, double cfl) {
  double dt = std::numeric_limits<double>::infinity();
  if (fluid.is_waiting()) return dt;  // all hulls are far away
  const auto wet = wet_bodies(fluid, bodies.size());
  if (std::find(wet.begin(), wet.end(), 0) == wet.end()) return dt;
  const auto points = fluid.points();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (wet[b]) continue;
    const auto& hull = bodies.spec(b).surface;
    const auto& state = bodies.state(b);
    Box<d> box;
    for (Eigen::Index i = 0; i < hull.vertices.cols(); ++i)
      box.extend(state.pose * rigid::Vec<d>(hull.vertices.col(i)));
    const double own = rigid::farthest_speed<d>(state.velocity, rigid::reach(bodies.spec(b))),
                 least = cfl * fluid.walls()[b].size;
    for (const auto& facet : fluid.boundary()) {
      if (facet.wall >= 0) continue;
      Box<d> water;
      double speed = 0;
      for (const int point : facet.nodes) {
        const auto at = static_cast<std::size_t>(point);
        water.extend(points[at]);
        speed = std::max(speed, fluid.velocity_n(at).norm());
      }
      dt = std::min(dt, std::max(least, 0.5 * box.exteriorDistance(water)) / (own + speed));
    }
  }
  return dt;
}

template double approach_dt<2>(const FluidView<2>&, const rigid::Bodies<2>&, double);
template double approach_dt<3>(const FluidView<3>&, const rigid::Bodies<3>&, double);

}  // namespace splashdown::apps
