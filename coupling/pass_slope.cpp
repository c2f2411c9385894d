#include "coupling/pass_slope.hpp"

#include <cmath>
#include <vector>

namespace splashdown::coupling {
namespace {

template <int d>
Eigen::VectorXd velocities(std::span<const rigid::BodyState<d>> states) {
  constexpr int m = fluid::freedoms<d>;
  Eigen::VectorXd out(m * static_cast<Eigen::Index>(states.size()));
  for (std::size_t b = 0; b < states.size(); ++b) out.segment<m>(m * static_cast<Eigen::Index>(b)) = states[b].velocity;
  return out;
}

/// Velocity change of all bodies per unit impulse on the free ones, whatever joins them.
template <int d>
Eigen::MatrixXd compliance(rigid::Bodies<d>& bodies, const std::vector<std::size_t>& free, double kick) {
  constexpr int m = fluid::freedoms<d>;
  std::vector<rigid::Wrench<d>> loads(bodies.size(), rigid::Wrench<d>::Zero());
  const Eigen::VectorXd unloaded = velocities<d>(bodies.solve(loads));
  Eigen::MatrixXd out(unloaded.size(), m * static_cast<Eigen::Index>(free.size()));
  Eigen::Index column = 0;
  for (const std::size_t b : free) {
    const auto& spec = bodies.spec(b);
    const double gyration = std::sqrt(spec.inertia.trace() / fluid::rotations<d> / spec.mass);
    for (int k = 0; k < m; ++k, ++column) {
      const double impulse = k < d ? spec.mass : spec.mass * gyration;  // some 1 m/s: far from roundoff
      loads[b](k) = impulse / kick;
      out.col(column) = (velocities<d>(bodies.solve(loads)) - unloaded) / impulse;
      loads[b](k) = 0;
    }
  }
  return out;
}

}  // namespace

template <int d>
Eigen::MatrixXd pass_slope(const fluid::Fluid<d>& fluid, rigid::Bodies<d>& bodies, double kick) {
  constexpr int m = fluid::freedoms<d>;
  std::vector<std::size_t> free;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies.spec(b).motion == rigid::Motion::free) free.push_back(b);
  const auto probed = static_cast<Eigen::Index>(m * free.size());
  const auto all = static_cast<Eigen::Index>(m * bodies.size());
  const auto pieces = static_cast<Eigen::Index>(fluid.interface_pieces().size());

  const Eigen::MatrixXd of_fluid = fluid.interface_slope(free);
  const Eigen::MatrixXd of_bodies = compliance<d>(bodies, free, kick);
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(all + pieces, all + pieces);
  const auto set_columns = [&](Eigen::Index to, Eigen::Index from, Eigen::Index count) {
    slope.block(0, to, all, count) = of_bodies * of_fluid.block(0, from, probed, count);
    slope.block(all, to, pieces, count) = of_fluid.block(probed, from, pieces, count);
  };
  for (std::size_t k = 0; k < free.size(); ++k)
    set_columns(m * static_cast<Eigen::Index>(free[k]), m * static_cast<Eigen::Index>(k), m);
  set_columns(all, probed, pieces);
  return slope;
}

template Eigen::MatrixXd pass_slope<2>(const fluid::Fluid<2>&, rigid::Bodies<2>&, double);
template Eigen::MatrixXd pass_slope<3>(const fluid::Fluid<3>&, rigid::Bodies<3>&, double);

}  // namespace splashdown::coupling
