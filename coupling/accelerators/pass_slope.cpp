#include "coupling/accelerators/pass_slope.hpp"

#include <vector>

#include "algebra/dense.hpp"

namespace splashdown::coupling {
namespace {

/// Velocity change of all bodies per unit impulse on the free ones, whatever ties them.
template <int d>
Eigen::MatrixXd compliance(const rigid::Bodies<d>& bodies, const std::vector<std::size_t>& free) {
  constexpr int m = fluid::freedoms<d>;
  const rigid::Mobility<d> all = bodies.mobility();
  const Eigen::MatrixXd modes = all.modes * all.directions;
  Eigen::MatrixXd of_free(modes.cols(), m * static_cast<Eigen::Index>(free.size()));
  for (std::size_t k = 0; k < free.size(); ++k)
    of_free.middleCols<m>(m * static_cast<Eigen::Index>(k)) =
        modes.middleRows<m>(m * static_cast<Eigen::Index>(free[k])).transpose();
  return modes * algebra::symmetric_solution(algebra::congruence(all.inertia, all.directions), of_free);
}

}  // namespace

template <int d>
Eigen::MatrixXd pass_slope(const fluid::Fluid<d>& fluid, const rigid::Bodies<d>& bodies) {
  constexpr int m = fluid::freedoms<d>;
  std::vector<std::size_t> free;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies.spec(b).motion == rigid::Motion::free) free.push_back(b);
  const auto probed = static_cast<Eigen::Index>(m * free.size());
  const auto all = static_cast<Eigen::Index>(m * bodies.size());
  const auto pieces = static_cast<Eigen::Index>(fluid.interface_pieces().size());

  const Eigen::MatrixXd of_fluid = fluid.interface_slope(free);
  const Eigen::MatrixXd of_bodies = compliance<d>(bodies, free);
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

template Eigen::MatrixXd pass_slope<2>(const fluid::Fluid<2>&, const rigid::Bodies<2>&);
template Eigen::MatrixXd pass_slope<3>(const fluid::Fluid<3>&, const rigid::Bodies<3>&);

}  // namespace splashdown::coupling
