#include "fluid/ale/participant.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace splashdown::ale {

double Participant::stable_dt() const { return std::numeric_limits<double>::infinity(); }

coupling::Status Participant::begin(const coupling::Step& step, const coupling::InterfaceModel& structure) {
  fluid_->walls_with(structure.modal.modes.rows());
  for (const auto& term : structure.interface_operators)
    if (term.laplacian != 0 || term.robin != 0)
      throw std::invalid_argument("ale fluid: knows no local operators on hulls");
  step_ = step;
  modal_ = structure.modal;
  is_first_pass_ = true;
  return fluid_->begin(step.kick, step.dt);
}

namespace {

/// y' with W'^T (M y' - Z^T I' - known) = 0, where I' = I - A Z (y' - y): what the next solve is asked with.
Eigen::VectorXd next_modes(const coupling::ModalInertia& modal, const coupling::ClosedContacts& contacts,
                           const Eigen::MatrixXd& answered, const Eigen::VectorXd& impulse, const Eigen::VectorXd& y) {
  const Eigen::MatrixXd matrix = modal.inertia + answered;
  Eigen::VectorXd right = modal.modes.transpose() * impulse + answered * y;
  if (!contacts.restrict_modes()) return matrix.partialPivLu().solve(right);
  if (contacts.known.size() > 0) right += contacts.known;
  if (contacts.directions.cols() == 0) return Eigen::VectorXd::Zero(y.size());
  const Eigen::MatrixXd& along = contacts.workless.size() > 0 ? contacts.workless : contacts.directions;
  const Eigen::MatrixXd reduced = along.transpose() * matrix * contacts.directions;
  return contacts.directions * reduced.colPivHouseholderQr().solve(along.transpose() * right);
}

}  // namespace

coupling::Status Participant::solve_exact(const coupling::Pass& pass) {
  const NextAmplitudes next = [&](const Eigen::MatrixXd& answered, const Eigen::VectorXd& impulse,
                                  const Eigen::VectorXd& y) {
    return next_modes(modal_, pass.contacts, answered, impulse, y);
  };
  const bool goes_on = !std::exchange(is_first_pass_, false);
  if (const auto status = fluid_->solve(pass.velocities, modal_.modes, next, goes_on); !status.ok()) return status;
  const Eigen::VectorXd& y = fluid_->amplitudes();
  solution_.velocities = pass.velocities + modal_.modes * y;
  solution_.imbalance =
      modal_.modes * (next(fluid_->answered(modal_.modes), fluid_->impulse().head(pass.velocities.size()), y) - y);
  return {};
}

coupling::Status Participant::solve(const coupling::Pass& pass) {
  const std::size_t moved = fluid_->walls_with(pass.velocities.size());
  solution_.velocities = pass.velocities;
  solution_.imbalance = coupling::Velocities::Zero(pass.velocities.size());
  solution_.lagged.resize(0);
  if (!pass.velocities.allFinite()) return {"the velocities of the bodies are not finite"};
  const auto status = modal_.modes.cols() > 0 ? solve_exact(pass) : fluid_->solve(pass.velocities);
  if (!status.ok()) return status;
  solution_.impulse = fluid_->impulse().head(pass.velocities.size());
  solution_.wetted.resize(static_cast<Eigen::Index>(moved));
  for (std::size_t w = 0; w < moved; ++w) solution_.wetted[static_cast<Eigen::Index>(w)] = fluid_->loads()[w].wetted;
  return {};
}

double Participant::roundoff() const {
  const auto& spec = fluid_->spec();
  return std::numeric_limits<double>::epsilon() * std::max(spec.min.norm(), spec.max.norm());
}

Eigen::MatrixXd Participant::added_mass(std::span<const std::size_t> walls) const { return fluid_->added_mass(walls); }

}  // namespace splashdown::ale
