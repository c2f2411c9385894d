#include "apps/run/approach.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace splashdown::apps {
namespace {

template <int d>
using Box = Eigen::AlignedBox<double, d>;

template <int d>
std::vector<char> wet_bodies(const fluid::Fluid<d>& fluid, std::size_t count) {
  std::vector<char> wet(count, 0);
  for (const auto& facet : fluid.mesh().boundary)
    if (facet.wall >= 0 && static_cast<std::size_t>(facet.wall) < count) wet[static_cast<std::size_t>(facet.wall)] = 1;
  return wet;
}

/// Of the hull's fastest point, at most.
template <int d>
double hull_speed(const rigid::Surface<d>& hull, const rigid::Twist<d>& velocity) {
  const double radius = hull.vertices.colwise().norm().maxCoeff();
  return velocity.template head<d>().norm() + radius * velocity.template tail<rigid::rotations<d>>().norm();
}

}  // namespace

template <int d>
double approach_dt(const fluid::Fluid<d>& fluid, const rigid::Bodies<d>& bodies) {
  double dt = std::numeric_limits<double>::infinity();
  const auto wet = wet_bodies(fluid, bodies.size());
  if (std::find(wet.begin(), wet.end(), 0) == wet.end()) return dt;
  Box<d> liquid;
  double liquid_speed = 0;
  for (std::size_t i = 0; i < fluid.nodes().size(); ++i) {
    liquid.extend(fluid.nodes().x[i]);
    liquid_speed = std::max(liquid_speed, fluid.nodes().v[i].norm());
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (wet[b]) continue;
    const auto& hull = bodies.spec(b).surface;
    const auto& state = bodies.state(b);
    Box<d> box;
    for (Eigen::Index i = 0; i < hull.vertices.cols(); ++i)
      box.extend(state.pose * rigid::Vec<d>(hull.vertices.col(i)));
    const double reach =
        std::max(fluid.spec().step.cfl * fluid.spec().walls[b].size, 0.5 * box.exteriorDistance(liquid));
    const double speed = hull_speed<d>(hull, state.velocity) + liquid_speed;
    if (speed > 0) dt = std::min(dt, reach / speed);
  }
  return dt;
}

template double approach_dt<2>(const fluid::Fluid<2>&, const rigid::Bodies<2>&);
template double approach_dt<3>(const fluid::Fluid<3>&, const rigid::Bodies<3>&);

}  // namespace splashdown::apps
