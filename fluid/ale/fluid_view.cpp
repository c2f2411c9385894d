// How the flow is looked at.
#include <algorithm>
#include <cmath>

#include "core/leapfrog.hpp"
#include "fluid/ale/fluid.hpp"

namespace splashdown::ale {

/// What of it a mesh decides.
void AleFlow::look_at_mesh() {
  pieces_ = straight_pieces(mesh_.cells);
  boundary_.clear();
  for (const auto& edge : mesh_.boundary)
    if (edge.wall >= 0) {
      boundary_.push_back({{edge.nodes[0], edge.nodes[2]}, edge.wall});
      boundary_.push_back({{edge.nodes[2], edge.nodes[1]}, edge.wall});
    }
}

void AleFlow::look() {
  points_.resize(static_cast<std::size_t>(mesh_.size()));
  for (int a = 0; a < mesh_.size(); ++a) points_[static_cast<std::size_t>(a)] = x_.col(a);
  poses_.clear();
  vertices_.resize(moved_.size());
  for (std::size_t w = 0; w < moved_.size(); ++w) {
    const auto& placement = state_.placements[w];
    poses_.push_back(moved_[w].motion->pose(placement));
    if (spec_.walls[w].deforms) vertices_[w] = placement.reshaped(2, placement.size() / 2);
  }
  pressure_.clear();
  finds_ = false;
}

PointPlace AleFlow::place(std::size_t point) const { return {.wall = wall_of_[point]}; }

std::span<const double> AleFlow::pressure() const {
  if (!pressure_.empty()) return pressure_;
  const Eigen::VectorXd p = is_solved_ ? Eigen::VectorXd(at_.tail(mesh_.corners)) : state_.pressure;
  pressure_.resize(points_.size());
  for (int k = 0; k < mesh_.corners; ++k) pressure_[static_cast<std::size_t>(k)] = p[k];
  for (const auto& cell : mesh_.cells)
    for (std::size_t e = 0; e < 3; ++e)
      pressure_[static_cast<std::size_t>(cell[3 + e])] = 0.5 * (p[cell[static_cast<std::size_t>(cell_edges[e][0])]] +
                                                                p[cell[static_cast<std::size_t>(cell_edges[e][1])]]);
  for (std::size_t a = 0; a < points_.size(); ++a)
    pressure_[a] += spec_.density * spec_.gravity.dot(points_[a] - spec_.max);
  return pressure_;
}

Vec<2> AleFlow::velocity_n(std::size_t point) const {
  const Vec<2> before = state_.velocity.col(static_cast<Eigen::Index>(point));
  if (!is_solved_) return before;
  const Vec<2> after = at_.segment<2>(2 * static_cast<Eigen::Index>(point));
  return velocity_at_t_n(before, after, state_.dt, dt_);
}

std::optional<double> AleFlow::pressure_at(const Vec<2>& point) const {
  if (!finds_) finder_.place(pieces_, points_);
  finds_ = true;
  const auto found = finder_.find(point);
  if (!found) return {};
  const auto p = pressure();
  double sum = 0;
  for (int k = 0; k < 3; ++k)
    sum += found->at[k] * p[static_cast<std::size_t>(pieces_[found->piece][static_cast<std::size_t>(k)])];
  return sum;
}

std::vector<Diagnostic> AleFlow::diagnostics() const {
  return {{"newton_iterations", static_cast<double>(iterations_)},
          {"mesh_stretch", equations_.least_stretch(x_)},
          {"divergence", std::sqrt(equations_.divergence(x_, state_.velocity))},
          {"remeshings", static_cast<double>(remeshings_)},
          {"momentum_remesh", momentum_of_remesh_},
          {"remeshings_missed", static_cast<double>(missed_)}};
}

}  // namespace splashdown::ale
