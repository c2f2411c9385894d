#include "fluid/vortex/participant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace splashdown::vortex {
namespace {

constexpr Eigen::Index each = 3, numbers = 6;  // coordinates and placement of a rigid wall in the plane

/// How many walls these numbers are of.
std::size_t rigid_walls(Eigen::Index count, Eigen::Index of_each, std::size_t most) {
  if (count % of_each != 0 || static_cast<std::size_t>(count / of_each) > most)
    throw std::invalid_argument("vortex fluid: " + std::to_string(count) + " numbers are not of its " +
                                std::to_string(most) + " rigid walls, each of which has " + std::to_string(of_each));
  return static_cast<std::size_t>(count / of_each);
}

Eigen::Index first_of(std::size_t wall) { return each * static_cast<Eigen::Index>(wall); }

}  // namespace

coupling::Status Participant::begin(const coupling::Step& step, const coupling::InterfaceModel& structure) {
  const std::size_t walls = fluid_->walls().size();
  const std::size_t moved = rigid_walls(structure.modal.modes.rows(), each, walls);
  for (const auto& term : structure.interface_operators)
    if (term.laplacian != 0 || term.robin != 0)
      throw std::invalid_argument("vortex fluid: knows no local operators on hulls");
  step_ = step;
  modal_ = structure.modal;
  std::vector<char> answers(walls, 0);
  for (std::size_t w = 0; w < moved && modal_.modes.cols() > 0; ++w)
    answers[w] = modal_.modes.middleRows(first_of(w), each).cwiseAbs().maxCoeff() > 0;
  // Without modes nobody says whom the fluid moves: it may be all of them.
  if (moved == 0 && !structure.interface_operators.empty())
    std::fill_n(answers.begin(), std::min(walls, structure.interface_operators.size()), 1);
  return fluid_->begin(step.kick, step.dt, answers);
}

/// y = W w with W'^T ((M + Z^T A Z) y - Z^T (b - A s_free) - known) = 0, where I(s) = b - A s.
coupling::Velocities Participant::exact(const coupling::Pass& pass) const {
  coupling::Velocities s = pass.velocities;
  if (modal_.modes.cols() == 0) return s;
  const auto laws = fluid_->laws();
  Eigen::MatrixXd answered = modal_.modes;  // A Z
  Eigen::VectorXd impulse(s.size());        // b - A s_free
  for (Eigen::Index at = 0; at < s.size(); at += each) {
    const auto& law = laws[static_cast<std::size_t>(at / each)];
    answered.middleRows(at, each) = law.answer * modal_.modes.middleRows(at, each);
    impulse.segment(at, each) = law.constant - law.answer * s.segment(at, each);
  }
  Eigen::MatrixXd matrix = modal_.inertia + modal_.modes.transpose() * answered;
  Eigen::VectorXd right = modal_.modes.transpose() * impulse;
  const auto& contacts = pass.contacts;
  if (!contacts.restrict_modes()) return s + modal_.modes * matrix.ldlt().solve(right);
  if (contacts.known.size() > 0) right += contacts.known;
  const Eigen::MatrixXd& along = contacts.workless.size() > 0 ? contacts.workless : contacts.directions;
  if (contacts.directions.cols() == 0) return s;
  const Eigen::MatrixXd reduced = along.transpose() * matrix * contacts.directions;
  return s + modal_.modes * (contacts.directions * reduced.colPivHouseholderQr().solve(along.transpose() * right));
}

coupling::Status Participant::solve(const coupling::Pass& pass) {
  const std::size_t walls = fluid_->walls().size(), moved = rigid_walls(pass.velocities.size(), each, walls);
  solution_.velocities = exact(pass);
  if (!solution_.velocities.allFinite()) return {"the velocities of the bodies are not finite"};
  std::vector<Twist<2>> twists(walls, Twist<2>::Zero());
  for (std::size_t w = 0; w < moved; ++w) twists[w] = solution_.velocities.segment<each>(first_of(w));
  fluid_->solve(twists);
  solution_.impulse.resize(pass.velocities.size());
  solution_.imbalance = coupling::Velocities::Zero(pass.velocities.size());
  solution_.wetted.resize(static_cast<Eigen::Index>(moved));
  for (std::size_t w = 0; w < moved; ++w) {
    const auto& load = fluid_->loads()[w];
    solution_.impulse.segment<each>(first_of(w)) = step_.kick * load.total();
    solution_.wetted[static_cast<Eigen::Index>(w)] = load.wetted;
  }
  solution_.lagged.resize(0);
  return {};
}

coupling::Status Participant::acceptable() const {
  const double h = fluid_->spec().grid.h;
  for (std::size_t w = 0; w < fluid_->walls().size(); ++w) {
    if (first_of(w) >= solution_.velocities.size()) break;
    const auto& vertices = fluid_->walls()[w].surface.vertices;
    const Twist<2> s = solution_.velocities.segment<each>(first_of(w));
    const double speed = s.head<2>().norm() + std::abs(s[2]) * vertices.colwise().norm().maxCoeff();
    if (!(speed * step_.dt <= h))
      return {"body \"" + fluid_->walls()[w].name +
              "\" crosses more than a square in a step; use a smaller time.dt_max"};
  }
  return {};
}

void Participant::commit(const coupling::Placement& walls) {
  std::vector<Isometry<2>> poses(fluid_->wall_poses().begin(), fluid_->wall_poses().end());
  const std::size_t placed = rigid_walls(walls.size(), numbers, poses.size());
  for (std::size_t w = 0; w < placed; ++w)
    poses[w].matrix().topRows<2>() =
        walls.segment<numbers>(numbers * static_cast<Eigen::Index>(w)).reshaped<Eigen::ColMajor>(2, 3);
  fluid_->commit(poses);
}

double Participant::roundoff() const {
  const auto& g = fluid_->spec().grid;
  return std::numeric_limits<double>::epsilon() * std::max(g.min.norm(), g.max().norm());
}

Eigen::MatrixXd Participant::slope(std::span<const std::size_t> walls) const { return -added_mass(walls); }

Eigen::MatrixXd Participant::added_mass(std::span<const std::size_t> walls) const {
  const auto count = static_cast<Eigen::Index>(walls.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(each * count, each * count);
  for (Eigen::Index k = 0; k < count; ++k)
    all.block<each, each>(each * k, each * k) = fluid_->laws()[walls[static_cast<std::size_t>(k)]].answer;
  return all;
}

}  // namespace splashdown::vortex
