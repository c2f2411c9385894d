#include "apps/record/tables/energy.hpp"

#include <algorithm>
#include <limits>

namespace splashdown::apps {

namespace {

/// Energy per volume at a point [J/m^3].
template <int d>
double energy_at(const FluidView<d>& fluid, const Vec<d>& x) {
  return fluid.density() * fluid.potential(x);
}

/// Lowest and highest energy per volume at points.
class Extremes {
 public:
  void offer(double value) {
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
  double length() const { return high_ > low_ ? high_ - low_ : 0; }

 private:
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

/// The middle of the surface that the water would have at rest in its tank.
template <int d>
Vec<d> middle_of_level(const WallSpec<d>& tank, double volume) {
  Eigen::AlignedBox<double, d> box;
  for (Eigen::Index v = 0; v < tank.surface.vertices.cols(); ++v)
    box.extend(tank.pose * Vec<d>(tank.surface.vertices.col(v)));
  Vec<d> level = box.center();
  const double height = box.sizes()(d - 1);
  level(d - 1) = box.min()(d - 1) + std::min(height, volume / (box.volume() / height));
  return level;
}

/// Without a tank: the mean of all water.
template <int d>
double level_energy(const RecordInput<d>& input) {
  const auto& fluid = *input.fluid;
  const auto& ledger = fluid.ledger();
  const std::size_t bodies = input.bodies ? input.bodies->size() : 0;
  const auto walls = fluid.walls();
  if (walls.size() > bodies) return energy_at<d>(fluid, middle_of_level<d>(walls[bodies], ledger.volume_initial));
  return ledger.volume_initial > 0 ? ledger.potential_energy / ledger.volume_initial : 0;
}

template <int d>
double moving_hulls(const BodiesView<d>& bodies) {
  double moving = 0, all = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const double volume = hull_volume<d>(bodies.spec(b).surface);
    all += volume;
    if (bodies.spec(b).motion != BodyMotion::fixed) moving += volume;
  }
  return moving > 0 ? moving : all;
}

template <int d>
double kinetic_energy(const BodySpec<d>& body, const Isometry<d>& pose, const Twist<d>& velocity) {
  const double translation = body.mass * velocity.template head<d>().squaredNorm();
  if constexpr (d == 2) {
    return 0.5 * (translation + body.inertia(0, 0) * velocity(2) * velocity(2));
  } else {
    const Eigen::Vector3d spin = pose.linear().transpose() * velocity.template tail<3>();
    return 0.5 * (translation + spin.dot(body.inertia * spin));
  }
}

}  // namespace

template <int d>
WaterAtStart water_at_start(const RecordInput<d>& input) {
  const auto& fluid = *input.fluid;
  Extremes energy;
  for (const auto& x : fluid.points()) energy.offer(energy_at<d>(fluid, x));
  return {.level_energy = level_energy(input),
          .depth_energy = fluid.ledger().volume_initial * energy.length(),
          .hull_volume = input.bodies ? moving_hulls<d>(*input.bodies) : 0};
}

template <int d>
std::vector<BodyEnergy> body_energies(const RecordInput<d>& input) {
  std::vector<BodyEnergy> energies;
  for (std::size_t b = 0; input.bodies && b < input.bodies->size(); ++b) {
    const auto& body = input.bodies->spec(b);
    const auto& pose = input.bodies->state(b).pose;
    auto& energy = energies.emplace_back();
    energy.free = body.becomes_free();
    energy.wet = input.body_load[b].wetted > 0;
    energy.kinetic = kinetic_energy<d>(body, pose, input.body_velocity_n[b]);
    if (!energy.wet || !energy.free) continue;
    Extremes height;
    for (Eigen::Index v = 0; v < body.surface.vertices.cols(); ++v)
      height.offer(energy_at<d>(*input.fluid, pose * Vec<d>(body.surface.vertices.col(v))));
    energy.immersion = 0.5 * hull_volume<d>(body.surface) * height.length();
  }
  return energies;
}

template WaterAtStart water_at_start<2>(const RecordInput<2>&);
template WaterAtStart water_at_start<3>(const RecordInput<3>&);
template std::vector<BodyEnergy> body_energies<2>(const RecordInput<2>&);
template std::vector<BodyEnergy> body_energies<3>(const RecordInput<3>&);

}  // namespace splashdown::apps
