// A wall with all nodes of its body: the exact term has all of its surface's vertices, or answers to a few loads.
#include <Eigen/SparseCholesky>
#include <stdexcept>

#include "core/mixing.hpp"
#include "elastic/modes/modes.hpp"
#include "elastic/stored_field.hpp"
#include "elastic/walls/wall.hpp"

namespace splashdown::elastic {
namespace {

/// The solid within a step from u: its force at a middle is that of the first half, c of walls/wall.hpp included. Unknowns that
/// are given are held, too.
template <int d>
class WithinStep final : public System {
 public:
  WithinStep(const Solid<d>& solid, const Field& u, double unresolved, const std::vector<Eigen::Index>& given = {})
      : solid_(solid), u_(u), unresolved_(unresolved) {
    held_ = solid.held();
    for (const auto k : given) this->hold(k);
  }
  const Sparse& mass() const override { return solid_.mass(); }
  Field internal_force(const Field& middle) const override { return solid_.force_between(u_, middle, 2 * unresolved_); }
  void stiffness(const Field& middle, Sparse& K) const override {
    solid_.stiffness_between(u_, middle, 2 * unresolved_, K);
  }
  double strain_energy(const Field& u) const override { return solid_.strain_energy(u); }
  double length() const override { return solid_.length(); }

 private:
  const Solid<d>& solid_;
  const Field& u_;  // of whom it is made for
  double unresolved_;
};

/// Numbers of unknowns within two groups; -1: in neither.
struct Groups {
  std::vector<Eigen::Index> inner, outer;                // unknowns
  std::vector<Eigen::Index> number_inner, number_outer;  // of an unknown in its group
};

template <int d>
Groups groups_of(const Solid<d>& solid, const std::vector<int>& boundary) {
  Groups all;
  std::vector<bool> is_outer(static_cast<std::size_t>(solid.size()), false);
  for (const int a : boundary)
    for (int k = 0; k < d; ++k) is_outer[static_cast<std::size_t>(d * a + k)] = true;
  all.number_inner.assign(is_outer.size(), -1);
  all.number_outer = all.number_inner;
  for (std::size_t k = 0; k < is_outer.size(); ++k) {
    if (solid.held()[k]) continue;
    auto& group = is_outer[k] ? all.outer : all.inner;
    (is_outer[k] ? all.number_outer : all.number_inner)[k] = static_cast<Eigen::Index>(group.size());
    group.push_back(static_cast<Eigen::Index>(k));
  }
  return all;
}

/// Rows and columns of a matrix by their numbers.
Sparse part_of(const Sparse& A, const std::vector<Eigen::Index>& rows, Eigen::Index row_count,
               const std::vector<Eigen::Index>& columns, Eigen::Index column_count) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index column = 0; column < A.outerSize(); ++column) {
    const auto k = columns[static_cast<std::size_t>(column)];
    if (k < 0) continue;
    for (Sparse::InnerIterator entry(A, column); entry; ++entry)
      if (const auto i = rows[static_cast<std::size_t>(entry.row())]; i >= 0) entries.emplace_back(i, k, entry.value());
  }
  Sparse part(row_count, column_count);
  part.setFromTriplets(entries.begin(), entries.end());
  return part;
}

template <int d>
class NodalWall : public ElasticWall<d> {
 protected:
  using ElasticWall<d>::solid_, ElasticWall<d>::dynamics_, ElasticWall<d>::boundary_, ElasticWall<d>::u_,
      ElasticWall<d>::s_, ElasticWall<d>::s_next_, ElasticWall<d>::load_, ElasticWall<d>::drive_, ElasticWall<d>::dt_,
      ElasticWall<d>::at_boundary, ElasticWall<d>::spread;

 public:
  NodalWall(const Solid<d>& solid, Dynamics dynamics)
      : ElasticWall<d>(solid, std::move(dynamics)),
        groups_(groups_of(solid, boundary_.nodes)),
        whole_(solid, u_, dynamics_.unresolved),
        inside_(solid, u_, dynamics_.unresolved, groups_.outer),
        whole_solver_(dynamics_.newton),
        inside_solver_(dynamics_.newton),
        p_(Field::Zero(solid.size())),
        free_middle_(p_) {
    Sparse M = solid.mass();
    leave_out(solid.held(), 1, M);
    mass_.compute(M);
    const auto vertices = d * static_cast<Eigen::Index>(boundary_.nodes.size());
    shapes_.setZero(vertices, static_cast<Eigen::Index>(groups_.outer.size()));
    Eigen::Index at = 0;
    for (const int a : boundary_.nodes)
      for (int k = 0; k < d; ++k, ++at)
        if (const auto n = groups_.number_outer[static_cast<std::size_t>(d * a + k)]; n >= 0) shapes_(at, n) = 1;
  }

  void start(const Field& velocity) override {
    s_ = velocity;
    p_ = solid_.mass() * velocity;
    damped_ = Field::Zero(solid_.size());
    let_go();
  }
  Field velocity() const override {
    if (!dynamics_.drive) return mass_.solve(p_);
    Field clamps = s_;  // of held unknowns alone
    for (Eigen::Index k = 0; k < clamps.size(); ++k)
      if (!is_held(k)) clamps[k] = 0;
    Field rest = p_ - solid_.mass() * clamps;
    leave_out(solid_.held(), rest);
    return mass_.solve(rest) + clamps;
  }
  double strain_energy() const override { return solid_.strain_energy(u_); }
  double strain_energy_between() const override { return solid_.strain_energy_between(last_start(), u_between_); }
  long iterations() const override { return whole_solver_.iterations() + inside_solver_.iterations(); }

 protected:
  void prepare() override {
    const auto& [mass, stiffness] = dynamics_.damping;
    if (mass == 0 && stiffness == 0) return;
    C_ = solid_.mass();
    C_.coeffs() *= mass;
    if (stiffness == 0) return;
    Sparse K;
    solid_.stiffness(u_ + dt_ / 2 * s_, K);
    C_.coeffs() += stiffness * K.coeffs();
  }

  Status move(const Eigen::VectorXd& impulse) override {
    Field middle = u_ + dt_ / 2 * s_;
    if (drive_.size() > 0)
      for (Eigen::Index k = 0; k < middle.size(); ++k)
        if (is_held(k)) middle[k] = u_[k] + dt_ / 2 * drive_[k];
    return move_from(std::move(middle), impulse);
  }

  /// By Newton's method from a middle of the step.
  Status move_from(Field middle, const Eigen::VectorXd& impulse) {
    const auto status = whole_solver_.solve(whole_, stage(2 / dt_ * (p_ + load_ + spread(impulse))), damping(), middle);
    s_next_ = 2 / dt_ * (middle - u_);
    return status;
  }

  Status follow(const Eigen::VectorXd& velocities) override {
    Field middle = free_middle_;
    Eigen::VectorXd outer(groups_.outer.size()), inner;
    const Field asked = spread(velocities);
    for (std::size_t k = 0; k < groups_.outer.size(); ++k) {
      const auto i = groups_.outer[k];
      const double goal = u_[i] + dt_ / 2 * asked[i];
      outer[static_cast<Eigen::Index>(k)] = goal - middle[i];
      middle[i] = goal;
    }
    if (!groups_.inner.empty()) {
      inner = inner_factor_.solve(-coupling_ * outer);
      for (std::size_t k = 0; k < groups_.inner.size(); ++k)
        middle[groups_.inner[k]] += inner[static_cast<Eigen::Index>(k)];
    }
    auto status = Status{};
    if (!groups_.inner.empty() && middle.allFinite())
      status = inside_solver_.solve(inside_, stage(2 / dt_ * (p_ + load_)), damping(), middle);
    s_next_ = 2 / dt_ * (middle - u_);
    return status;
  }

  Eigen::VectorXd implied() const override {
    const Field left = solid_.mass() * s_next_ + first_half() - p_ - load_;
    return left(groups_.outer);
  }

  ModalInertia linearised() override {
    if (Sparse A = tangent(); !is_known(A)) {
      condense(A);
      tangent_ = std::move(A);
    }
    return {shapes_, condensed_};
  }
  /// M_s about the trial, which is the one without an impulse.
  Sparse tangent() {
    free_middle_ = u_ + dt_ / 2 * s_next_;
    Sparse K;
    whole_.stiffness(free_middle_, K);
    Sparse A = solid_.mass();
    A.coeffs() += dt_ * dt_ / 4 * K.coeffs();
    if (const auto* C = damping()) A.coeffs() += dt_ / 2 * C->coeffs();
    return A;
  }
  /// Whether it is that of the step before.
  bool is_known(const Sparse& A) const {
    return A.nonZeros() == tangent_.nonZeros() && (A.coeffs() == tangent_.coeffs()).all();
  }

  void accept() override {
    damped_ = damping_of_second_half();
    p_ = solid_.mass() * s_next_ - dt_ / 2 * force() - damped_;
    let_go();
    u_between_ = u_ + dt_ / 2 * s_next_;
    u_ += dt_ * s_next_;
  }
  double damping_work() const override { return 0.5 * (s_ + s_next_).dot(damped_ + first_half() - dt_ / 2 * force()); }
  double drive_work(const Field& impulse) const override {
    const Field rows = solid_.mass() * s_next_ + first_half() - reactions_ - load_ - impulse;
    double sum = 0;
    for (Eigen::Index k = 0; k < rows.size(); ++k)
      if (is_held(k)) sum += 0.5 * (s_[k] + s_next_[k]) * rows[k];
    return sum;
  }
  void write(std::ostream& out) const override {
    write_field(out, u_);
    write_field(out, u_between_);
    for (const auto* field : {&p_, &damped_, &reactions_}) write_field(out, *field);
  }
  void read(std::istream& in) override {
    read_field(in, u_);
    read_field(in, u_between_);
    for (auto* field : {&p_, &damped_, &reactions_}) read_field(in, *field);
  }

 private:
  bool is_held(Eigen::Index k) const { return solid_.held()[static_cast<std::size_t>(k)]; }
  /// Of p what stands in held rows is what clamps answer for.
  void let_go() {
    const Field all = p_;
    leave_out(solid_.held(), p_);
    reactions_ = all - p_;
  }
  const Sparse* damping() const { return C_.nonZeros() > 0 ? &C_ : nullptr; }
  Stage stage(const Field& g) const { return {.mass = 4 / (dt_ * dt_), .damping = 2 / dt_, .p = u_, .q = u_, .g = g}; }
  Field middle() const { return u_ + dt_ / 2 * s_next_; }
  /// Where the last step began.
  Field last_start() const { return 2 * u_between_ - u_; }
  /// f_n of the trial.
  Field force() const { return solid_.force_between(u_, middle()); }
  /// dt/2 (f_n + C s) + c dt^2 K s of the trial.
  Field first_half() const {
    Field all = dt_ / 2 * whole_.internal_force(middle());
    if (const auto* C = damping()) all += dt_ / 2 * (*C * s_next_);
    return all;
  }
  /// dt/2 C s - c dt (f_n - f_{n-1}) of the trial, with the stresses of both where the step ends. So that the moment stays, it
  /// also takes back what the first half did in the middle instead of the beginning.
  Field damping_of_second_half() const {
    Field all = Field::Zero(solid_.size());
    if (const auto* C = damping()) all = dt_ / 2 * (*C * s_next_);
    if (const double c = dynamics_.unresolved; c > 0) {
      const Field end = u_ + dt_ * s_next_;
      all -= c * dt_ *
             (solid_.carried_force(u_, middle(), end) - solid_.carried_force(last_start(), u_between_, end) +
              solid_.turned_change(u_, middle()));
    }
    return all;
  }
  /// What the inside leaves of A on the surface.
  void condense(const Sparse& A) {
    const auto& [inner, outer, number_inner, number_outer] = groups_;
    const auto m = static_cast<Eigen::Index>(inner.size()), n = static_cast<Eigen::Index>(outer.size());
    condensed_ = part_of(A, number_outer, n, number_outer, n);
    if (m == 0) return;
    coupling_ = part_of(A, number_inner, m, number_outer, n);
    inner_factor_.compute(part_of(A, number_inner, m, number_inner, m));
    constexpr Eigen::Index together = 64;  // columns: their answers need m numbers each
    for (Eigen::Index from = 0; from < n; from += together) {
      const auto count = std::min(together, n - from);
      const Eigen::MatrixXd columns = coupling_.middleCols(from, count);
      condensed_.middleCols(from, count) -= coupling_.transpose() * inner_factor_.solve(columns);
    }
    condensed_ = 0.5 * (condensed_ + condensed_.transpose()).eval();
  }

  Groups groups_;
  WithinStep<d> whole_, inside_;
  StageSolver whole_solver_, inside_solver_;
  Eigen::SimplicialLDLT<Sparse> mass_, inner_factor_;
  Field p_, free_middle_;
  Field reactions_ = p_, damped_ = p_;  // held rows of p; damping of the last step's second half
  Field u_between_ = Field::Zero(solid_.size());
  Sparse C_, coupling_;
  Eigen::MatrixXd shapes_, condensed_;

 protected:
  Sparse tangent_;
};

/// All nodes, of which the exact term knows the answers to a few loads: F = M phi, the inertia of the lowest modes at rest,
///
///   Z = M_s^-1 F,   Z^T M_s Z = Z^T F,   on the surface.
///
/// What else an impulse does is found by passes, which are mixed. Modes that are stiff and narrow answer little to it: they contract.
template <int d>
class LoadedWall final : public NodalWall<d> {
  using NodalWall<d>::solid_, NodalWall<d>::u_, NodalWall<d>::s_next_, NodalWall<d>::dt_, NodalWall<d>::at_boundary,
      NodalWall<d>::boundary_, NodalWall<d>::tangent_;
  using typename ElasticWall<d>::Renewed;

 public:
  LoadedWall(const Solid<d>& solid, Dynamics dynamics, int modes) : NodalWall<d>(solid, std::move(dynamics)) {
    const auto lowest = lowest_modes(solid, modes, Field::Zero(solid.size()));
    if (!lowest.status.ok()) throw std::invalid_argument(lowest.status.cause);
    loads_ = solid.mass() * lowest.shapes;
    for (auto column : loads_.colwise())
      for (Eigen::Index k = 0; k < column.size(); ++k)
        if (solid.held()[static_cast<std::size_t>(k)]) column[k] = 0;
  }

 protected:
  ModalInertia linearised() override {
    free_ = s_next_;
    mixing_.forget();
    if (Sparse A = this->tangent(); !this->is_known(A)) {
      Sparse free = A;
      leave_out(solid_.held(), 1, free);
      factor_.compute(free);
      answers_ = factor_.solve(loads_);
      tangent_ = std::move(A);
      on_surface_.resize(static_cast<Eigen::Index>(boundary_.nodes.size()) * d, answers_.cols());
      for (Eigen::Index k = 0; k < answers_.cols(); ++k) on_surface_.col(k) = at_boundary(answers_.col(k));
      const Eigen::MatrixXd inertia = answers_.transpose() * loads_;
      inertia_ = 0.5 * (inertia + inertia.transpose());
    }
    return {on_surface_, inertia_};
  }

  /// Within the span of the answers.
  Status follow(const Eigen::VectorXd& velocities) override {
    const Eigen::VectorXd y = on_surface_.colPivHouseholderQr().solve(velocities - at_boundary(free_));
    s_next_ = free_ + answers_ * y;
    return y.allFinite() ? Status{} : Status{"the solid's velocities are not finite"};
  }

  Renewed renewed(const Eigen::VectorXd& impulse) override {
    Renewed all;
    all.status = this->move_from(u_ + dt_ / 2 * s_next_, impulse);
    const Eigen::VectorXd y = inertia_.ldlt().solve(on_surface_.transpose() * impulse);
    free_ += mixing_.way(s_next_ - answers_ * y - free_);
    all.velocities = at_boundary(s_next_);
    all.free = at_boundary(free_);
    return all;
  }

 private:
  Eigen::MatrixXd loads_, answers_, on_surface_, inertia_;  // F; Z in all nodes and on the surface; Z^T F
  Eigen::SimplicialLDLT<Sparse> factor_;
  Field free_;  // of all nodes, without what the answers hold of an impulse
  Mixing mixing_{solid_.size()};
};

}  // namespace

template <int d>
std::unique_ptr<ElasticWall<d>> nodal_wall(const Solid<d>& solid, Dynamics dynamics, int modes) {
  if (modes > 0) return std::make_unique<LoadedWall<d>>(solid, std::move(dynamics), modes);
  return std::make_unique<NodalWall<d>>(solid, std::move(dynamics));
}

template std::unique_ptr<ElasticWall<2>> nodal_wall<2>(const Solid<2>&, Dynamics, int);
template std::unique_ptr<ElasticWall<3>> nodal_wall<3>(const Solid<3>&, Dynamics, int);

}  // namespace splashdown::elastic
