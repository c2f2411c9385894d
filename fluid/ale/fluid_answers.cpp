// Loads on walls, and how they answer velocities of walls.
#include <stdexcept>

#include "core/geometry.hpp"
#include "fluid/ale/fluid.hpp"
#include "fluid/ale/mesh/edge_rule.hpp"

namespace splashdown::ale {

/// Reactions of the discrete equations where velocities are given: the load that makes momentum balance to roundoff, and that
/// converges twice as fast as tractions of the solution's gradients do.
void AleFlow::find_loads() {
  equations_.residual(fields_, at_, reactions_);
  nodal_loads_ = -reactions_.head(2 * mesh_.size());
  add_buoyancy(nodal_loads_);
  impulse_ = impulse_of(nodal_loads_);
  for (std::size_t w = 0; w < moved_.size(); ++w) {
    auto& load = loads_[w];
    load = {};
    const Vec<2> about = poses_[w].translation();
    for (const int a : moved_[w].nodes)
      load.physical += wrench_of<2>(x_.col(a) - about, nodal_loads_.segment<2>(2 * a));
  }
  for (const auto& f : boundary_)
    loads_[static_cast<std::size_t>(f.wall)].wetted += area_vector_of<2>(f, points_).norm();
}

/// rho g . x, which the unknown pressure is without, on walls.
void AleFlow::add_buoyancy(Eigen::VectorXd& loads) const {
  if (spec_.gravity.isZero()) return;
  for (const auto& edge : mesh_.boundary) {
    if (edge.wall < 0) continue;
    at_edge_points(edge, x_, [&](const EdgePoint& point) {
      const double head = spec_.density * spec_.gravity.dot(point.x - spec_.max);
      for (int k = 0; k < 3; ++k)
        loads.segment<2>(2 * edge.nodes[static_cast<std::size_t>(k)]) += head * point.N[k] * point.normal;
    });
  }
}

/// On coordinates of all walls, of loads on nodes.
Eigen::VectorXd AleFlow::impulse_of(const Eigen::VectorXd& nodal_loads) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(coordinates(moved_.size()));
  for (const auto& wall : moved_) {
    Eigen::VectorXd of_nodes(2 * static_cast<Eigen::Index>(wall.nodes.size()));
    for (std::size_t k = 0; k < wall.nodes.size(); ++k)
      of_nodes.segment<2>(2 * static_cast<Eigen::Index>(k)) = nodal_loads.segment<2>(2 * wall.nodes[k]);
    const auto w = static_cast<std::size_t>(&wall - moved_.data());
    all.segment(wall.first, wall.motion->coordinates()) =
        kick_ * wall.motion->basis(state_.placements[w]).transpose() * of_nodes;
  }
  return all;
}

/// One solve with the factor for each motion.
void AleFlow::find_answers(const FactoredSlope& tangent, Answers& answers) const {
  const auto& motions = answers.motions;
  answers.factor = tangent.number();
  answers.impulses = Eigen::MatrixXd::Zero(motions.rows(), motions.cols());
  answers.fields = Eigen::MatrixXd::Zero(given_.free(), motions.cols());
  if (!tangent.is_ready()) return;
  const std::size_t walls = walls_with(motions.rows());
  std::vector<Eigen::MatrixXd> moved, onto;  // velocities of nodes; impulses on coordinates by those on nodes
  for (std::size_t w = 0; w < walls; ++w) {
    const auto& wall = moved_[w];
    moved.emplace_back(wall.motion->basis(answers.middle[w]) *
                       motions.middleRows(wall.first, wall.motion->coordinates()));
    onto.emplace_back(wall.motion->basis(answers.placements[w]).transpose());
  }
  for (Eigen::Index k = 0; k < motions.cols(); ++k) {
    Unknowns change = Unknowns::Zero(equations_.size());
    for (std::size_t w = 0; w < walls; ++w)
      for (std::size_t a = 0; a < moved_[w].nodes.size(); ++a)
        change.segment<2>(2 * moved_[w].nodes[a]) = moved[w].col(k).segment<2>(2 * static_cast<Eigen::Index>(a));
    answers.fields.col(k) = tangent.correction(given_.gather(tangent.times(change)));
    given_.add(answers.fields.col(k), change);
    const Eigen::VectorXd reactions = answers.kick * tangent.times(change);
    for (std::size_t w = 0; w < walls; ++w) {
      const auto& wall = moved_[w];
      Eigen::VectorXd of_nodes(2 * static_cast<Eigen::Index>(wall.nodes.size()));
      for (std::size_t a = 0; a < wall.nodes.size(); ++a)
        of_nodes.segment<2>(2 * static_cast<Eigen::Index>(a)) = reactions.segment<2>(2 * wall.nodes[a]);
      answers.impulses.col(k).segment(wall.first, wall.motion->coordinates()) = onto[w] * of_nodes;
    }
  }
}

Eigen::MatrixXd AleFlow::answer(const Eigen::MatrixXd& motions) const {
  Answers answers;
  answers.motions = motions;
  answers.middle = middle_;
  answers.placements = state_.placements;
  answers.kick = kick_;
  const FactoredSlope* tangent = is_solved_ ? tangent_ : first_;
  if (!tangent || !tangent->is_ready()) return Eigen::MatrixXd::Zero(motions.rows(), motions.cols());
  find_answers(*tangent, answers);
  return answers.impulses;
}

Eigen::MatrixXd AleFlow::added_mass(std::span<const std::size_t> walls) const {
  const Eigen::Index count = coordinates(moved_.size());
  const Eigen::MatrixXd all = answer(Eigen::MatrixXd::Identity(count, count));
  std::vector<Eigen::Index> of_walls;
  for (const std::size_t w : walls)
    for (Eigen::Index k = 0; k < moved_[w].motion->coordinates(); ++k) of_walls.push_back(moved_[w].first + k);
  return all(of_walls, of_walls);
}

}  // namespace splashdown::ale
