#include "elastic/goals/goals.hpp"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "elastic/modes/modes.hpp"

namespace splashdown::elastic {
namespace {

/// A solid on cells that are divided, and what fields of the one before are there.
template <int d>
class DividedSolid {
 public:
  explicit DividedSolid(const Solid<d>& before) : before_(&before), both_(before.divided()) {}
  const Solid<d>& solid() const { return both_.first; }
  Field operator()(const Field& u) const {
    Field all(solid().size());
    for (int a = 0; a < solid().mesh().size(); ++a) {
      const auto& [cell, at] = both_.second[static_cast<std::size_t>(a)];
      all.template segment<d>(d * a) = before_->value(u, {cell, at});
    }
    return all;
  }
  /// What is left of a field without what the cells before can have of it.
  Field beyond(const Field& fine) const { return fine - (*this)(Field(fine.head(before_->size()))); }
  /// Adds minus r . z, by the cells before.
  void add(const Field& r, const Field& z, double factor, GoalError& goal) const {
    const auto whole = whole_errors(*before_);
    goal.by_cell.assign(before_->mesh().cells.size(), 0);
    for (int a = 0; a < solid().mesh().size(); ++a) {
      const auto cell = static_cast<std::size_t>(both_.second[static_cast<std::size_t>(a)].cell);
      const double share = -r.template segment<d>(d * a).dot(z.template segment<d>(d * a));
      goal.add(cell, factor * whole[cell] * share);
    }
  }

 private:
  const Solid<d>* before_;
  std::pair<Solid<d>, std::vector<typename SplitCells<d>::At>> both_;
};

}  // namespace

template <int d>
GoalError deflection_goal(const Solid<d>& solid, const Field& u, const LoadOn<d>& load, const Place<d>& place,
                          const Vec<d>& direction) {
  const DividedSolid<d> divided(solid);
  const auto& fine = divided.solid();
  const Field at = divided(u);
  Field r = load(fine) - fine.internal_force(at);
  leave_out(fine.held(), r);
  Sparse K;
  fine.stiffness(at, K);
  leave_out(fine.held(), K.diagonal().cwiseAbs().maxCoeff(), K);
  Field asked = fine.point_force(in_divided<d>(place), direction);
  leave_out(fine.held(), asked);
  const Eigen::SimplicialLDLT<Sparse> factor(K);
  if (factor.info() != Eigen::Success)
    throw std::runtime_error("the adjoint of the deflection is singular; the solid buckles, or is not held");
  GoalError goal;
  goal.value = solid.value(u, place).dot(direction);
  divided.add(r, divided.beyond(factor.solve(asked)), 1, goal);
  return goal;
}

template <int d>
GoalError frequency_goal(const Solid<d>& solid, int number) {
  const auto modes = lowest_modes(solid, number, Field::Zero(solid.size()));
  if (!modes.status.ok()) throw std::runtime_error(modes.status.cause);
  const DividedSolid<d> divided(solid);
  const auto& fine = divided.solid();
  constexpr int more = 2;  // of frequencies that change places
  const auto fine_modes = lowest_modes(fine, number + more, Field::Zero(fine.size()));
  if (!fine_modes.status.ok()) throw std::runtime_error(fine_modes.status.cause);
  const double w = modes.angular_frequencies[number - 1], turn = 2 * std::numbers::pi;
  const Field x = divided(modes.shapes.col(number - 1)), Mx = fine.mass() * x;
  Sparse K;
  fine.stiffness(Field::Zero(fine.size()), K);
  Field r = K * x - w * w * Mx;
  leave_out(fine.held(), r);
  // Modes of nearly one frequency are any mixture of each other.
  constexpr double near = 0.05;
  Field adjoint = Field::Zero(fine.size());
  double overlap = 0;
  for (Eigen::Index k = 0; k < fine_modes.shapes.cols(); ++k) {
    if (std::abs(fine_modes.angular_frequencies[k] - w) > near * w) continue;
    const double share = fine_modes.shapes.col(k).dot(Mx);
    adjoint += share * fine_modes.shapes.col(k);
    overlap += share * share;
  }
  GoalError goal;
  goal.value = w / turn;
  if (!(overlap > 0)) throw std::runtime_error("the mode is another one on finer elements; use smaller ones");
  divided.add(r, divided.beyond(adjoint / overlap), 1 / (2 * turn * w), goal);
  return goal;
}

template <int d>
GoalError goal_error(const SolidGoal<d>& goal, const Solid<d>& solid, const Field& u, const LoadOn<d>& load) {
  if (goal.mode > 0) return frequency_goal(solid, goal.mode);
  return deflection_goal<d>(solid, u, load, goal.place, goal.direction);
}

template GoalError deflection_goal<2>(const Solid<2>&, const Field&, const LoadOn<2>&, const Place<2>&, const Vec<2>&);
template GoalError deflection_goal<3>(const Solid<3>&, const Field&, const LoadOn<3>&, const Place<3>&, const Vec<3>&);
template GoalError frequency_goal<2>(const Solid<2>&, int);
template GoalError frequency_goal<3>(const Solid<3>&, int);
template GoalError goal_error<2>(const SolidGoal<2>&, const Solid<2>&, const Field&, const LoadOn<2>&);
template GoalError goal_error<3>(const SolidGoal<3>&, const Solid<3>&, const Field&, const LoadOn<3>&);

}  // namespace splashdown::elastic
