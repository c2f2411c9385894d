#include "fluid/pfem/participant.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace splashdown::fluid {
namespace {

template <int d>
Eigen::Index index(std::size_t wall) {
  return freedoms<d> * static_cast<Eigen::Index>(wall);
}

Eigen::VectorXd stacked(std::span<const double> numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

/// How many walls these numbers are of, each having so many.
std::size_t walls_in(Eigen::Index numbers, int each, std::size_t most) {
  if (numbers % each != 0 || static_cast<std::size_t>(numbers / each) > most)
    throw std::invalid_argument("fluid: " + std::to_string(numbers) + " numbers are not of its " +
                                std::to_string(most) + " rigid walls, each of which has " + std::to_string(each));
  return static_cast<std::size_t>(numbers / each);
}

}  // namespace

template <int d>
coupling::Status Participant<d>::begin(const coupling::Step& step, const coupling::InterfaceModel& structure) {
  const std::size_t walls = fluid_->spec().walls.size();
  walls_in(structure.modal.modes.rows(), freedoms<d>, walls);
  if (structure.interface_operators.size() > walls)
    throw std::invalid_argument("fluid: more interface operators than walls");
  kick_ = step.kick;
  coupling::InterfaceModel all = structure;  // of all walls: those beyond the structure's do not answer
  if (const Eigen::Index modes = structure.modal.modes.cols(); modes > 0) {
    all.modal.modes.setZero(index<d>(walls), modes);
    all.modal.modes.topRows(structure.modal.modes.rows()) = structure.modal.modes;
  }
  if (!all.interface_operators.empty()) all.interface_operators.resize(walls);
  if (const auto status = fluid_->begin(step.kick, step.dt, all); !status.ok()) return status;
  return {};
}

template <int d>
coupling::Status Participant<d>::solve(const coupling::Pass& pass) {
  const std::size_t moved = walls_in(pass.velocities.size(), freedoms<d>, fluid_->spec().walls.size());
  std::vector<Twist<d>> walls(fluid_->spec().walls.size(), Twist<d>::Zero());
  for (std::size_t w = 0; w < moved; ++w) walls[w] = pass.velocities.segment<freedoms<d>>(index<d>(w));
  const std::span<const double> lagged(pass.lagged.data(), static_cast<std::size_t>(pass.lagged.size()));
  const StepResult<d>& found = fluid_->solve(walls, lagged, pass.contacts);
  if (!found.status.ok()) return found.status;

  solution_.velocities.resize(index<d>(moved));
  solution_.impulse.resize(index<d>(moved));
  solution_.imbalance.resize(index<d>(moved));
  solution_.wetted.resize(static_cast<Eigen::Index>(moved));
  for (std::size_t w = 0; w < moved; ++w) {
    const auto of_wall = [w](Eigen::VectorXd& all) { return all.segment<freedoms<d>>(index<d>(w)); };
    of_wall(solution_.velocities) = found.wall_velocities[w];
    of_wall(solution_.impulse) = kick_ * found.loads[w].total();
    of_wall(solution_.imbalance) = found.imbalance[w];
    solution_.wetted[static_cast<Eigen::Index>(w)] = found.loads[w].wetted;
  }
  solution_.lagged = stacked(found.interface_impulse);
  return {};
}

template <int d>
Eigen::VectorXd Participant<d>::first_guess() const {
  return stacked(fluid_->carried_interface_impulse());
}

template <int d>
std::vector<Isometry<d>> Participant<d>::placed(const coupling::Placement& walls) const {
  constexpr int numbers = d * (d + 1);
  std::vector<Isometry<d>> poses(fluid_->wall_poses().begin(), fluid_->wall_poses().end());
  const std::size_t placed = walls_in(walls.size(), numbers, poses.size());
  for (std::size_t w = 0; w < placed; ++w)
    poses[w].matrix().template topRows<d>() =
        walls.segment<numbers>(numbers * static_cast<Eigen::Index>(w)).template reshaped<Eigen::ColMajor>(d, d + 1);
  return poses;
}

template <int d>
void Participant<d>::commit(const coupling::Placement& walls) {
  fluid_->commit(placed(walls));
}

template <int d>
void Participant<d>::wait(double dt, const coupling::Placement& walls, const coupling::Velocities& velocities) {
  std::vector<Twist<d>> twists(fluid_->spec().walls.size(), Twist<d>::Zero());
  for (std::size_t w = 0; w < walls_in(velocities.size(), freedoms<d>, twists.size()); ++w)
    twists[w] = velocities.segment<freedoms<d>>(index<d>(w));
  fluid_->wait(dt, placed(walls), twists);
}

template <int d>
bool Participant<d>::rests(std::span<const coupling::WallCoordinates> walls, const Eigen::VectorXd& speeds) {
  const auto stay_away = [&] {
    if (fluid_->result().loads.size() < walls.size()) return false;  // no step has been solved
    Eigen::AlignedBox<double, d> water;
    for (const auto& x : fluid_->nodes().x) water.extend(x);
    for (std::size_t w = 0; w < walls.size(); ++w) {
      if (walls[w].stays) continue;
      const auto& vertices = fluid_->spec().walls[w].surface.vertices;
      const double radius = vertices.cols() > 0 ? vertices.colwise().norm().maxCoeff() : 0.0;
      const double moves = 2 * fluid_->spec().step.dt_max * speeds[static_cast<Eigen::Index>(w)];
      if (fluid_->result().loads[w].wetted > 0 ||
          water.exteriorDistance(fluid_->wall_poses()[w].translation()) <= 2 * radius + moves)
        return false;
    }
    return true;
  };
  fluid_->set_waiting((fluid_->is_waiting() || fluid_->is_at_rest()) && stay_away());
  return fluid_->is_waiting();
}

template <int d>
double Participant<d>::roundoff() const {
  double farthest = 0;
  for (const auto& node : fluid_->nodes().x) farthest = std::max(farthest, node.norm());
  return std::numeric_limits<double>::epsilon() * farthest;
}

template class Participant<2>;
template class Participant<3>;

}  // namespace splashdown::fluid
