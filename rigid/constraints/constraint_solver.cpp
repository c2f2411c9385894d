#include "rigid/constraints/constraint_solver.hpp"

#include <algorithm>
#include <utility>

#include "core/dense.hpp"

namespace splashdown::rigid {

namespace {

Eigen::Index count(const std::vector<char>& chosen) { return std::count(chosen.begin(), chosen.end(), 1); }

/// Of each contact the same for all its rows.
std::vector<char> each(const std::vector<char>& contacts, Eigen::Index rows) {
  std::vector<char> all;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    all.insert(all.end(), static_cast<std::size_t>(rows) / contacts.size(), contacts[i]);
  return all;
}

Eigen::MatrixXd rows_of(const Eigen::MatrixXd& all, const std::vector<char>& chosen) {
  Eigen::MatrixXd rows(count(chosen), all.cols());
  Eigen::Index next = 0;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (chosen[i]) rows.row(next++) = all.row(static_cast<Eigen::Index>(i));
  return rows;
}

}  // namespace

struct ConstraintSolver::Found {
  Eigen::VectorXd pushes;  // of closed contacts, then of those that stick
  double weak, slow;
};

ConstraintSolver::ConstraintSolver(const Problem& p) : unit_(p.unit), resolution_(p.resolution), friction_(p.friction) {
  const auto scaled = p.unit.cwiseInverse().asDiagonal();
  const algebra::Solutions free =
      algebra::solutions_of(p.equalities * scaled, p.equal - p.equalities * p.before, negligible);
  origin_ = p.before + scaled * free.point;
  basis_ = free.directions;
  const Eigen::Index free_modes = basis_.cols(), yielding = p.yielding.size();
  modes_.setZero(p.unit.size(), free_modes + yielding);
  modes_.leftCols(free_modes) = scaled * basis_;
  inertia_ = algebra::congruence(p.inertia, modes_);
  inertia_.diagonal().tail(yielding) = p.yielding;
  known_ = modes_.transpose() * (p.impulse - p.inertia * (origin_ - p.before));
  contacts_ = p.contacts * modes_;
  contacts_.bottomRightCorner(yielding, yielding).setIdentity();
  least_ = p.least - p.contacts * origin_;
  closed_.assign(static_cast<std::size_t>(contacts_.rows()), 0);
  sticks_.assign(static_cast<std::size_t>(p.rubbing), 0);
  tangents_ = p.tangents * modes_;
  along_ = -(p.tangents * origin_);
  ways_.setZero(p.rubbing > 0 ? tangents_.rows() / p.rubbing : 0, p.rubbing);
  restrict();
}

Eigen::MatrixXd ConstraintSolver::held() const {
  const std::vector<char> stuck = each(sticks_, tangents_.rows());
  Eigen::MatrixXd rows(count(closed_) + count(stuck), modes_.cols());
  rows << rows_of(contacts_, closed_), rows_of(tangents_, stuck);
  return rows;
}

Eigen::MatrixXd ConstraintSolver::rubbed(Eigen::MatrixXd rows) const {
  Eigen::Index next = 0;
  for (std::size_t i = 0; i < closed_.size(); ++i) {
    if (!closed_[i]) continue;
    const auto c = static_cast<Eigen::Index>(i);
    if (i < sticks_.size() && !sticks_[i])
      rows.row(next) -= friction_ * ways_.col(c).transpose() * tangents_.middleRows(ways_.rows() * c, ways_.rows());
    ++next;
  }
  return rows;
}

void ConstraintSolver::restrict() {
  const std::vector<char> stuck = each(sticks_, tangents_.rows());
  Eigen::VectorXd rates(count(closed_) + count(stuck));
  rates << rows_of(least_, closed_), rows_of(along_, stuck);
  pushing_ = held();
  const algebra::Solutions left = algebra::solutions_of(pushing_, rates, negligible);
  pushed_ = left.point;
  find_leverage(rates);
  workless_ = directions_ = left.directions;
  if (ways_.isZero(0)) return;
  Eigen::MatrixXd rows = rubbed(pushing_);
  // Of contacts that repeat each other, impulses are those of least norm.
  rows -= left.idle * (left.idle.transpose() * rows);
  Eigen::MatrixXd workless = algebra::solutions_of(rows, Eigen::VectorXd::Zero(rates.size()), negligible).directions;
  if (workless.cols() != directions_.cols()) return;  // some push and rub along one line: as if they did not rub
  pushing_ = std::move(rows);
  workless_ = std::move(workless);
}

void ConstraintSolver::find_leverage(const Eigen::VectorXd& rates) {
  Eigen::MatrixXd rows = pushing_;
  Eigen::VectorXd rigid = rates;
  rigid_pushed_ = pushed_;
  if (yielding() > 0) {
    Eigen::Index next = 0;
    for (std::size_t i = 0; i < closed_.size(); ++i) {
      if (!closed_[i]) continue;
      if (static_cast<Eigen::Index>(i) >= contacts_.rows() - yielding()) {
        rows.row(next).setZero();
        rigid[next] = 0;
      }
      ++next;
    }
    rigid_pushed_ = algebra::solutions_of(rows, rigid, negligible).point;
  }
  fastest_asked_ = rigid.size() > 0 ? rigid.cwiseAbs().maxCoeff() : 0;
}

Eigen::VectorXd ConstraintSolver::amplitudes(const Eigen::VectorXd& velocity) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(modes_.cols());
  y.head(basis_.cols()) = basis_.transpose() * unit_.cwiseProduct(velocity - origin_);
  const Eigen::Index first = contacts_.rows() - yielding();
  for (Eigen::Index i = 0; i < yielding(); ++i)
    if (closed_[static_cast<std::size_t>(first + i)])
      y[basis_.cols() + i] = least_[first + i] - contacts_.row(first + i).dot(y);  // y of it is still 0
  return y;
}

Eigen::VectorXd ConstraintSolver::velocity(const Eigen::VectorXd& impulse) const {
  if (directions_.cols() == 0) return origin_ + modes_ * pushed_;
  const Eigen::VectorXd left = workless_.transpose() * (known_ + modes_.transpose() * impulse - inertia_ * pushed_);
  const Eigen::VectorXd w = algebra::least_squares(algebra::between(workless_, inertia_, directions_), left);
  return origin_ + modes_ * (pushed_ + directions_ * w);
}

Eigen::VectorXd ConstraintSolver::unspent(const Eigen::VectorXd& velocity, const Eigen::VectorXd& impulse) const {
  return known_ + modes_.transpose() * impulse - inertia_ * amplitudes(velocity);
}

bool ConstraintSolver::update_contacts(const Eigen::VectorXd& velocity, const Eigen::VectorXd& impulse) {
  if (closed_.empty()) return false;
  const Eigen::VectorXd y = amplitudes(velocity);
  // Impulses r, t of what is held: its rows, transposed, balance with them what is left.
  const Eigen::VectorXd left = -unspent(velocity, impulse);
  Eigen::VectorXd pushes(pushing_.rows());
  if (pushing_.rows() > 0) pushes = algebra::least_squares(pushing_.transpose(), left);
  const Found found{.pushes = pushes,
                    .weak = negligible * pushes.cwiseAbs().sum(),
                    .slow = resolution_ + negligible * contacts_.leftCols(basis_.cols()).rowwise().norm().maxCoeff() *
                                              y.head(basis_.cols()).norm()};
  const Eigen::MatrixXd slide = (tangents_ * y - along_).reshaped(ways_.rows(), ways_.cols());
  bool changes = open_and_close(contacts_ * y - least_, slide, found);
  if (!changes) changes = stick_and_slide(slide, found);  // else the impulses are those of other contacts
  if (!changes) return false;
  ++changes_;
  constexpr int enough = 25;
  if (changes_ == enough) {
    std::ranges::fill(sticks_, 0);
    ways_.setZero();
    smooth_ = true;
  }
  restrict();
  return true;
}

std::optional<Eigen::VectorXd> ConstraintSolver::settled(const Eigen::VectorXd& impulse) {
  constexpr int most = 100;  // more changes than contacts in a scene
  Eigen::VectorXd found = velocity(impulse);
  for (int i = 0; update_contacts(found, impulse); ++i) {
    if (i == most) return {};
    found = velocity(impulse);
  }
  return found;
}

bool ConstraintSolver::open_and_close(const Eigen::VectorXd& rate, const Eigen::MatrixXd& slide, const Found& found) {
  constexpr int together = 5;
  bool any = false;
  Eigen::Index push = 0;
  for (std::size_t i = 0; i < closed_.size() && !(any && changes_ >= together); ++i) {
    const auto c = static_cast<Eigen::Index>(i);
    const double pushes = closed_[i] ? found.pushes[push++] : 0;
    // Of contacts that cannot all be closed at once, those that the compromise leaves apart open.
    const bool opens = closed_[i] && (pushes < -found.weak || rate[c] > found.slow);
    const bool closes = !closed_[i] && rate[c] < -found.slow;
    const bool rubs = i < sticks_.size() && !smooth_;
    const bool slides = rubs && closed_[i] && !ways_.col(c).isZero(0);
    // What is driven the other way by its friction sticks; so may what pulls only because it slides.
    if (slides && (opens || slide.col(c).dot(ways_.col(c)) < -found.slow)) {
      sticks_[i] = 1;
      ways_.col(c).setZero();
      any = true;
    } else if (opens || closes) {
      closed_[i] = !closed_[i];
      any = true;
      if (!rubs) continue;
      const bool moves = slide.col(c).norm() > found.slow;
      sticks_[i] = closed_[i] && !moves;
      ways_.col(c) =
          closed_[i] && moves ? slide.col(c).normalized().eval() : Eigen::VectorXd::Zero(ways_.rows()).eval();
    }
  }
  return any;
}

bool ConstraintSolver::stick_and_slide(const Eigen::MatrixXd& slide, const Found& found) {
  // Rounds after which directions, and what sticks, stay: friction takes energy all the same.
  constexpr int turning = 5, sliding = 15;
  if (sticks_.empty() || smooth_ || changes_ >= sliding) return false;
  constexpr double settled = 0.02;  // [rad]: mu is known to two digits
  bool any = false;
  Eigen::Index push = 0, pull = count(closed_);
  for (std::size_t i = 0; i < sticks_.size(); ++i) {
    if (!closed_[i]) continue;
    const auto c = static_cast<Eigen::Index>(i);
    const double most = friction_ * std::max(found.pushes[push++], 0.0);
    if (sticks_[i]) {
      const Eigen::VectorXd pulls = found.pushes.segment(pull, ways_.rows());
      pull += pulls.size();
      if (pulls.norm() <= most + found.weak) continue;
      sticks_[i] = 0;
      ways_.col(c) = -pulls.normalized();
      any = true;
    } else if (changes_ < turning && slide.col(c).norm() > found.slow) {
      const Eigen::VectorXd way = slide.col(c).normalized();
      if ((way - ways_.col(c)).norm() <= settled) continue;
      ways_.col(c) = (way + ways_.col(c)).normalized();  // where a body turns about a point near it, it overshoots
      any = true;
    }
  }
  return any;
}

}  // namespace splashdown::rigid
