#include "coupling/interface_space.hpp"

#include <cmath>

namespace splashdown::coupling {

InterfaceSpace::InterfaceSpace(const StructurePart& structure, std::span<const InterfacePiece> pieces,
                               double fluid_density)
    : walls_(structure.walls()) {
  const Eigen::Index count = structure.scales().size();
  weight_.resize(count + static_cast<Eigen::Index>(pieces.size()));
  weight_.head(count) = structure.scales();
  std::vector<double> hull(walls_.size(), 0.0);
  for (const auto& piece : pieces) hull[piece.wall] += piece.measure;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const auto& [wall, measure] = pieces[k];
    const double mass = walls_[wall].mass, with_water = mass + fluid_density * walls_[wall].volume;
    weight_[count + static_cast<Eigen::Index>(k)] = std::sqrt(measure * hull[wall] / (mass * with_water));
  }
}

Eigen::VectorXd InterfaceSpace::scaled(const Velocities& velocities) const {
  return velocities.cwiseProduct(weight_.head(velocities.size()));
}

Eigen::VectorXd InterfaceSpace::vector(const Interface& interface) const {
  Eigen::VectorXd out(weight_.size());
  out << scaled(interface.velocities), interface.lagged.cwiseProduct(weight_.tail(interface.lagged.size()));
  return out;
}

Eigen::MatrixXd InterfaceSpace::slope(const Eigen::MatrixXd& of_interface) const {
  return weight_.asDiagonal() * of_interface * weight_.cwiseInverse().asDiagonal();
}

void InterfaceSpace::add(const Eigen::VectorXd& change, Interface& interface) const {
  const Eigen::VectorXd unscaled = change.cwiseQuotient(weight_);
  for (const auto& wall : walls_)
    if (wall.answers) interface.velocities.segment(wall.first, wall.count) += unscaled.segment(wall.first, wall.count);
  interface.lagged += unscaled.tail(interface.lagged.size());
}

}  // namespace splashdown::coupling
