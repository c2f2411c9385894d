#include "fluid/pfem/participant.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace splashdown::fluid {
namespace {

Eigen::VectorXd stacked(std::span<const double> numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

/// How many walls have this many coordinates. Throws std::invalid_argument for numbers that end within one.
template <int d>
std::size_t walls_in(Eigen::Index numbers, const WallLayout<d>& layout) {
  const int walls = layout.walls_of(numbers);
  if (walls < 0)
    throw std::invalid_argument("fluid: " + std::to_string(numbers) +
                                " numbers are not the coordinates of its first walls; all " +
                                std::to_string(layout.walls()) + " have " + std::to_string(layout.size()));
  return static_cast<std::size_t>(walls);
}

}  // namespace

template <int d>
coupling::Status Participant<d>::begin(const coupling::Step& step, const coupling::InterfaceModel& structure) {
  const std::size_t walls = fluid_->spec().walls.size();
  walls_in<d>(structure.modal.modes.rows(), fluid_->layout());
  if (structure.interface_operators.size() > walls)
    throw std::invalid_argument("fluid: more interface operators than walls");
  kick_ = step.kick;
  coupling::InterfaceModel all = structure;  // of all walls: those beyond the structure's do not answer
  if (const Eigen::Index modes = structure.modal.modes.cols(); modes > 0) {
    all.modal.modes.setZero(fluid_->layout().size(), modes);
    all.modal.modes.topRows(structure.modal.modes.rows()) = structure.modal.modes;
  }
  if (!all.interface_operators.empty()) all.interface_operators.resize(walls);
  if (const auto status = fluid_->begin(step.kick, step.dt, all); !status.ok()) return status;
  return {};
}

template <int d>
coupling::Status Participant<d>::solve(const coupling::Pass& pass) {
  const WallLayout<d>& layout = fluid_->layout();
  const std::size_t moved = walls_in<d>(pass.velocities.size(), layout);
  std::vector<WallVelocity<d>> walls(layout.walls());
  for (std::size_t w = 0; w < moved; ++w) walls[w] = layout.of_wall(w, pass.velocities);
  const std::span<const double> lagged(pass.lagged.data(), static_cast<std::size_t>(pass.lagged.size()));
  const StepResult<d>& found = fluid_->solve(walls, lagged, pass.contacts);
  if (!found.status.ok()) return found.status;

  solution_.velocities.resize(pass.velocities.size());
  solution_.impulse.resize(pass.velocities.size());
  solution_.imbalance.resize(pass.velocities.size());
  solution_.wetted.resize(static_cast<Eigen::Index>(moved));
  for (std::size_t w = 0; w < moved; ++w) {
    const auto of_wall = [&](Eigen::VectorXd& all) { return all.segment(layout.first(w), layout.count(w)); };
    of_wall(solution_.velocities) = layout.stacked(w, found.wall_velocities[w]);
    if (layout.deforms(w))
      of_wall(solution_.impulse) = kick_ * found.at_vertices[w].reshaped();
    else
      of_wall(solution_.impulse) = kick_ * found.loads[w].total();
    of_wall(solution_.imbalance) = layout.stacked(w, found.imbalance[w]);
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
void Participant<d>::commit(const coupling::Placement& walls) {
  fluid_->commit(fluid_->places_of(walls));
}

template <int d>
void Participant<d>::wait(double dt, const coupling::Placement& walls, const coupling::Velocities& velocities) {
  const WallLayout<d>& layout = fluid_->layout();
  std::vector<WallVelocity<d>> moving(layout.walls());
  for (std::size_t w = 0; w < walls_in<d>(velocities.size(), layout); ++w) moving[w] = layout.of_wall(w, velocities);
  fluid_->wait(dt, fluid_->places_of(walls), moving);
}

template <int d>
bool Participant<d>::rests(std::span<const coupling::WallCoordinates> walls, const Eigen::VectorXd& speeds) {
  const auto stay_away = [&] {
    if (fluid_->result().loads.size() < walls.size()) return false;  // no step has been solved
    Eigen::AlignedBox<double, d> water;
    for (const auto& x : fluid_->nodes().x) water.extend(x);
    for (std::size_t w = 0; w < walls.size(); ++w) {
      if (walls[w].stays) continue;
      if (fluid_->layout().deforms(w)) return false;  // what vibrates is never at rest for good
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
