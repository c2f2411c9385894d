#include "fluid/ale/participant.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace splashdown::ale {

double Participant::stable_dt() const { return std::numeric_limits<double>::infinity(); }

coupling::Status Participant::begin(const coupling::Step& step, const coupling::InterfaceModel& structure) {
  fluid_->walls_with(structure.modal.modes.rows());
  for (const auto& term : structure.interface_operators)
    if (term.laplacian != 0 || term.robin != 0)
      throw std::invalid_argument("ale fluid: knows no local operators on hulls");
  step_ = step;
  modal_ = structure.modal;
  const auto status = fluid_->begin(step.kick, step.dt);
  if (!status.ok() || modal_.modes.cols() == 0) return status;
  answered_ = modal_.modes.transpose() * fluid_->answer(modal_.modes);
  of_factor_ = fluid_->factorisations();
  return status;
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
  constexpr double agreed = 1e-9;  // of velocities: Newton's method squares what is left
  constexpr int most = 30;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(modal_.modes.cols());
  Eigen::MatrixXd answered = answered_;
  long of_factor = of_factor_;
  for (int k = 0; k < most; ++k) {
    solution_.velocities = pass.velocities + modal_.modes * y;
    if (!solution_.velocities.allFinite()) return {"the velocities of the bodies are not finite"};
    if (const auto status = fluid_->solve(solution_.velocities, k > 0); !status.ok()) return status;
    if (of_factor != fluid_->factorisations()) answered = modal_.modes.transpose() * fluid_->answer(modal_.modes);
    of_factor = fluid_->factorisations();
    const Eigen::VectorXd next =
        next_modes(modal_, pass.contacts, answered, fluid_->impulse().head(pass.velocities.size()), y);
    const Eigen::VectorXd change = modal_.modes * (next - y);
    solution_.imbalance = change;
    const double scale = std::max(solution_.velocities.cwiseAbs().maxCoeff(), pass.velocities.cwiseAbs().maxCoeff());
    if (change.cwiseAbs().maxCoeff() <= agreed * scale) return {};
    y = next;
  }
  return {"fluid and bodies do not agree; use a smaller time.dt_max"};
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
