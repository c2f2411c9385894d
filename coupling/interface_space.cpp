#include "coupling/interface_space.hpp"

#include <cmath>

#include "rigid/shapes/mass_properties.hpp"

namespace splashdown::coupling {

template <int d>
InterfaceSpace<d>::InterfaceSpace(const rigid::Bodies<d>& bodies, std::span<const fluid::InterfacePiece> pieces,
                                  double fluid_density) {
  constexpr int m = fluid::freedoms<d>, rotations = fluid::rotations<d>;
  const auto count = static_cast<Eigen::Index>(bodies.size());
  weight_.setOnes(m * count + static_cast<Eigen::Index>(pieces.size()));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto& spec = bodies.spec(b);
    free_.push_back(spec.motion == rigid::Motion::free);
    if (!free_[b]) continue;
    const double gyration = std::sqrt(spec.inertia.trace() / rotations / spec.mass);
    weight_.segment(m * static_cast<Eigen::Index>(b) + d, rotations).setConstant(gyration);
  }
  std::vector<double> hull(bodies.size(), 0.0);
  for (const auto& piece : pieces) hull[piece.wall] += piece.measure;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const auto& [wall, measure] = pieces[k];
    const auto& spec = bodies.spec(wall);
    const double moved = spec.mass + fluid_density * rigid::mass_properties<d>(spec.surface).mass;
    weight_[m * count + static_cast<Eigen::Index>(k)] = std::sqrt(measure * hull[wall]) / moved;
  }
}

template <int d>
Eigen::VectorXd InterfaceSpace<d>::velocities(const std::vector<fluid::Twist<d>>& twists) const {
  constexpr int m = fluid::freedoms<d>;
  Eigen::VectorXd out(m * static_cast<Eigen::Index>(twists.size()));
  for (std::size_t b = 0; b < twists.size(); ++b) out.segment<m>(m * static_cast<Eigen::Index>(b)) = twists[b];
  return out.cwiseProduct(weight_.head(out.size()));
}

template <int d>
Eigen::VectorXd InterfaceSpace<d>::vector(const Interface<d>& interface) const {
  const auto impulses = static_cast<Eigen::Index>(interface.impulses.size());
  Eigen::VectorXd out(weight_.size());
  out << velocities(interface.twists),
      Eigen::Map<const Eigen::VectorXd>(interface.impulses.data(), impulses).cwiseProduct(weight_.tail(impulses));
  return out;
}

template <int d>
Eigen::MatrixXd InterfaceSpace<d>::slope(const Eigen::MatrixXd& of_interface) const {
  return weight_.asDiagonal() * of_interface * weight_.cwiseInverse().asDiagonal();
}

template <int d>
void InterfaceSpace<d>::add(const Eigen::VectorXd& change, Interface<d>& interface) const {
  constexpr int m = fluid::freedoms<d>;
  const Eigen::VectorXd unscaled = change.cwiseQuotient(weight_);
  for (std::size_t b = 0; b < free_.size(); ++b)
    if (free_[b]) interface.twists[b] += unscaled.segment<m>(m * static_cast<Eigen::Index>(b));
  const auto impulses = static_cast<Eigen::Index>(interface.impulses.size());
  Eigen::Map<Eigen::VectorXd>(interface.impulses.data(), impulses) += unscaled.tail(impulses);
}

template class InterfaceSpace<2>;
template class InterfaceSpace<3>;

}  // namespace splashdown::coupling
