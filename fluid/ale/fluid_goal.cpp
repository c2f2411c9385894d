// How far a load of a steady flow is off, by the flow on a mesh of which each cell is divided (Becker & Rannacher 2001; Venditti &
// Darmofal 2002). With residuals R of the flow U as it stands on that mesh, and z the adjoint of the load J there,
//
//   J(U) - J(divided) = R . (z - I z) + O(|U - U_divided|^2),   K^T z = dJ/dU,   z = the direction on the wall
//
// I: interpolation on the mesh before, whose test functions leave no residual. Where R (z - I z) is large the mesh is too coarse
// for this load. What the divided mesh is off itself is added by its order q, 1/(2^q - 1) of each share (core/goals/corner_order.hpp).
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "core/goals/corner_order.hpp"
#include "core/goals/refined_size.hpp"
#include "fluid/ale/fluid.hpp"
#include "fluid/ale/linear/direct_solver.hpp"

namespace splashdown::ale {
namespace {

/// Velocities and pressures of a mesh, on the one that it is divided into.
class Prolongation {
 public:
  Prolongation(const FlowMesh& before, const DividedMesh& after) : before_(&before), after_(&after) {}

  Unknowns operator()(const FlowEquations& coarse, const FlowEquations& fine, const Unknowns& at) const {
    Unknowns all = Unknowns::Zero(fine.size());
    for (int a = 0; a < after_->mesh.size(); ++a) {
      const auto& [number, place] = after_->places[static_cast<std::size_t>(a)];
      const auto& cell = before_->cells[static_cast<std::size_t>(number)];
      const auto N = shapes<2>(place);
      for (std::size_t k = 0; k < cell.size(); ++k)
        all.segment<2>(fine.velocity(a, 0)) +=
            N[static_cast<Eigen::Index>(k)] * at.segment<2>(coarse.velocity(cell[k], 0));
      if (a >= after_->mesh.corners) continue;
      for (std::size_t k = 0; k < 3; ++k)
        all[fine.pressure(a)] += place[static_cast<Eigen::Index>(k)] * at[coarse.pressure(cell[k])];
    }
    return all;
  }

 private:
  const FlowMesh* before_;
  const DividedMesh* after_;
};

/// What an error is over its part that a divided mesh shows, for each cell.
std::vector<double> whole_errors(const FlowMesh& mesh) {
  const auto node = [&](int a) { return Vec<2>(mesh.nodes.col(a)); };
  std::map<int, Vec<2>> comes, goes;  // directions of the boundary at ends of its edges
  for (const auto& edge : mesh.boundary) {
    if (edge.wall < 0) continue;
    const auto [a, b, m] = edge.nodes;
    goes[a] = -3 * node(a) + 4 * node(m) - node(b);
    comes[b] = node(a) - 4 * node(m) + 3 * node(b);
  }
  std::map<int, double> at_corner;
  for (const auto& [a, from] : comes) {
    const auto to = goes.find(a);
    if (to == goes.end()) continue;
    const Vec<2>& t = to->second;
    const double left = std::atan2(from.x() * t.y() - from.y() * t.x(), from.dot(t));
    if (left < -least_corner_turn)
      at_corner[a] = over_shown(2 * corner_exponent(std::numbers::pi - left, CornerSide::held, CornerSide::held, 1));
  }
  std::vector<double> all;
  for (const auto& cell : mesh.cells) {
    double factor = over_shown(smooth_order);
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto found = at_corner.find(cell[k]); found != at_corner.end()) factor = found->second;
    all.push_back(factor);
  }
  return all;
}

/// What nodes and corners of the mesh before have of a field after: they kept their numbers.
Unknowns restricted(const FlowEquations& coarse, const FlowEquations& fine, const FlowMesh& mesh, const Unknowns& at) {
  Unknowns all(coarse.size());
  for (int a = 0; a < mesh.size(); ++a) all.segment<2>(coarse.velocity(a, 0)) = at.segment<2>(fine.velocity(a, 0));
  for (int a = 0; a < mesh.corners; ++a) all[coarse.pressure(a)] = at[fine.pressure(a)];
  return all;
}

}  // namespace

/// Of a step to a steady flow on a mesh that stands.
StepFields AleFlow::steady_fields(const Nodes& x) const {
  const Nodes none = Nodes::Zero(2, x.cols());
  StepFields fields{.x = x, .x_after = x, .before = none, .mesh_velocity = none, .theta = 1};
  if (spec_.force) fields.force = [this](const Vec<2>& place) { return spec_.force(place, time_); };
  return fields;
}

/// Of a steady flow with these unknowns.
Vec<2> AleFlow::load_at(const Unknowns& at, std::size_t wall) const {
  Eigen::VectorXd residual;
  equations_.residual(steady_fields(x_), at, residual);
  Eigen::VectorXd loads = -residual.head(2 * mesh_.size());
  add_buoyancy(loads);
  Vec<2> sum = Vec<2>::Zero();
  for (const int a : moved_[wall].nodes) sum += loads.segment<2>(2 * a);
  return sum;
}

GoalError AleFlow::load_goal(std::size_t wall, const Vec<2>& direction) const {
  if (!spec_.scheme.is_steady || state_.steps == 0 || !state_.velocity.allFinite())
    throw std::logic_error("ale fluid: loads have an error of their own in steady flows alone, after a step");
  const auto after = divided(mesh_);
  const FlowEquations fine(after.mesh, spec_.density, spec_.viscosity, open_sides(spec_));
  const GivenUnknowns given(given_unknowns(spec_, after.mesh, fine));
  const Prolongation prolonged(mesh_, after);
  Unknowns at(equations_.size());
  at << state_.velocity.reshaped(), state_.pressure;
  Unknowns flow = prolonged(equations_, fine, at);
  give_sides(spec_, after.mesh, fine, time_ - 0.5 * state_.dt, flow);
  const StepFields fields = steady_fields(after.mesh.nodes);
  Eigen::VectorXd residual;
  fine.residual(fields, flow, residual);
  Eigen::SparseMatrix<double> slope;
  fine.linearise(fields, flow, slope);

  // Minus the load is the sum of residuals on the wall.
  Unknowns z = Unknowns::Zero(fine.size());
  for (const auto& edge : after.mesh.boundary)
    if (edge.wall == static_cast<int>(wall))
      for (const int a : edge.nodes) z.segment<2>(fine.velocity(a, 0)) = direction;
  DirectSolver solver;
  if (!solver.factor(given.inner(slope).transpose()))
    throw std::runtime_error("the adjoint of the load is singular; use smaller elements");
  given.add(solver.solve(-given.gather(slope.transpose() * z)), z);

  GoalError goal;
  goal.by_cell.assign(mesh_.cells.size(), 0);
  goal.value = load_at(at, wall).dot(direction);
  const Unknowns share = residual.cwiseProduct(z - prolonged(equations_, fine, restricted(equations_, fine, mesh_, z)));
  const auto whole = whole_errors(mesh_);
  for (int a = 0; a < after.mesh.size(); ++a) {
    const auto cell = static_cast<std::size_t>(after.places[static_cast<std::size_t>(a)].cell);
    double sum = share.segment<2>(fine.velocity(a, 0)).sum();
    if (a < after.mesh.corners) sum += share[fine.pressure(a)];
    goal.add(cell, whole[cell] * sum);
  }
  return goal;
}

std::vector<GoalValue> AleFlow::goals() const {
  std::vector<GoalValue> all;
  for (const auto& [name, wall, direction] : spec_.goals) {
    const auto goal = load_goal(wall, direction);
    all.push_back({name, goal.value, goal.error, "N/m"});
  }
  return all;
}

AleFlowSpec adapted(AleFlowSpec spec, int times, double dt, double until) {
  for (int k = 0; k < times; ++k) {
    AleFlow flow(spec);
    double before = 0;
    do {
      auto status = flow.begin(0.5 * (before + dt), dt);
      if (status.ok()) status = flow.solve(Eigen::VectorXd());
      if (!status.ok()) throw std::runtime_error("the mesh could not be refined: " + status.cause);
      flow.commit({});
      before = dt;
    } while (flow.time() - 0.5 * dt < until);
    JointShares together(flow.mesh().cells.size());
    for (const auto& [name, wall, direction] : spec.goals) together.add(flow.load_goal(wall, direction).by_cell);
    spec.size = refined_size(flow.mesh().nodes, flow.mesh().cells, together.all(), refined_share);
  }
  return spec;
}

}  // namespace splashdown::ale
