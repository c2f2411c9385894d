// A wall with the lowest natural modes of its body, in a frame that moves along. On the manifold x = c + R (X - C + sum q_k phi_k)
// with tangents P = dx/d(c, theta, q), d'Alembert's principle asks the equations of wall.hpp along P_n alone:
//
//   (1 + alpha dt/2) P_n^T M s + dt/2 (0, 0, L (q_mid + (beta + 2 c dt) dq)) = P_n^T (M v_n + I + kick F),   s = (x_{n+1} - x_n)/dt
//
// L = diag(w_k^2), q_mid, dq: mean and rate of q in the step. It is the variational integrator of this Lagrangian (Marsden, West 2001,
// section 3.5.2: as RATTLE), so that momenta stay exact while the frame turns. The modes are those of the mean axes: phi_k has no
// momentum (Canavin, Likins 1977).
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/geometry.hpp"
#include "elastic/modes/modes.hpp"
#include "elastic/stored_field.hpp"
#include "elastic/walls/wall.hpp"

namespace splashdown::elastic {
namespace {

/// Frame and amplitudes.
template <int d>
struct Posture {
  Vec<d> centre;
  Mat<d> turn;
  Eigen::VectorXd amplitudes;
};

/// What a posture has more than another. Differences of places would be roundoff in steps of microseconds.
template <int d>
using Way = Posture<d>;

/// w of the part w x of a matrix.
template <int d>
Eigen::Matrix<double, rotations<d>, 1> axis_of(const Mat<d>& matrix) {
  Eigen::Matrix<double, rotations<d>, 1> w = Eigen::Matrix<double, rotations<d>, 1>::Zero();
  for (int k = 0; k < d; ++k) w += 0.5 * moment(Vec<d>::Unit(k).eval(), matrix.col(k).eval());
  return w;
}

template <int d>
class ModalWall final : public ElasticWall<d> {
  using ElasticWall<d>::solid_, ElasticWall<d>::dynamics_, ElasticWall<d>::boundary_, ElasticWall<d>::u_,
      ElasticWall<d>::s_, ElasticWall<d>::s_next_, ElasticWall<d>::load_, ElasticWall<d>::drive_, ElasticWall<d>::dt_,
      ElasticWall<d>::at_boundary, ElasticWall<d>::spread;
  using typename ElasticWall<d>::Renewed;

 public:
  ModalWall(const Solid<d>& solid, Dynamics dynamics, int count) : ElasticWall<d>(solid, std::move(dynamics)) {
    const bool is_held = std::ranges::find(solid.held(), true) != solid.held().end();
    frame_ = is_held ? 0 : freedoms<d>;
    if (count < std::max(1, frame_))
      throw std::invalid_argument("modes of a free body include its " + std::to_string(freedoms<d>) + " rigid ones");
    const Field zero = Field::Zero(solid.size());
    auto modes = lowest_modes(solid, count, zero);
    if (!modes.status.ok()) throw std::invalid_argument(modes.status.cause);
    shapes_ = modes.shapes.rightCols(count - frame_);
    squares_ = modes.angular_frequencies.tail(count - frame_).cwiseAbs2();
    const Vec<d> centre = solid.centre(zero);
    arms_ = Eigen::Map<const Field>(solid.mesh().nodes.data(), solid.size()) - solid.uniform(centre);
    now_ = next_ = {centre, Mat<d>::Identity(), Eigen::VectorXd::Zero(count - frame_)};
    way_ = {Vec<d>::Zero(), Mat<d>::Zero(), now_.amplitudes};
    rates_ = Eigen::VectorXd::Zero(count);
    last_slopes_ = Eigen::VectorXd::Zero(squares_.size());
    last_damping_ = Eigen::VectorXd::Zero(squares_.size());
    between_ = now_.amplitudes;
    set_tangents();
  }

  void start(const Field& velocity) override {
    if (dynamics_.drive) carrier_ = carrier_of(dynamics_.drive(0));
    rates_ = inertia_.ldlt().solve(momenta_.transpose() * (velocity - solid_.uniform(carrier_)));
    last_slopes_ = rates_.tail(squares_.size());
    s_ = tangents_ * rates_ + solid_.uniform(carrier_);
  }
  Field velocity() const override { return (turns() ? tangents(now_) : tangents_) * rates_ + solid_.uniform(carrier_); }
  double strain_energy() const override { return 0.5 * squares_.dot(now_.amplitudes.cwiseAbs2()); }
  double strain_energy_between() const override { return 0.5 * squares_.dot(between_.cwiseAbs2()); }
  long iterations() const override { return iterations_; }

 protected:
  void prepare() override {
    if (turns()) set_tangents();
    known_ = inertia_ * rates_ + tangents_.transpose() * load_;
    if (drive_.size() > 0) {
      known_ += momenta_.transpose() * solid_.uniform(carrier_);
      next_carrier_ = carrier_of(drive_);
    }
  }

  Status move(const Eigen::VectorXd& impulse) override {
    const Eigen::VectorXd goal = known_ + answers_.transpose() * impulse;
    next_ = now_;
    way_ = {dt_ * next_carrier_, Mat<d>::Zero(), Eigen::VectorXd::Zero(squares_.size())};
    next_.centre += way_.centre;
    go_on(dt_ * rates_);
    double last = std::numeric_limits<double>::infinity();
    for (int k = 0; k < dynamics_.newton.most; ++k) {
      ++iterations_;
      look_at_next();
      const Eigen::VectorXd residual = momentum_of_trial() - goal;
      if (!residual.allFinite()) break;
      Eigen::MatrixXd J = (1 + dynamics_.damping.mass * dt_ / 2) / dt_ *
                          (turns() ? Eigen::MatrixXd(momenta_.transpose() * tangents(next_)) : inertia_);
      J.diagonal().tail(squares_.size()) += (dt_ / 4 + first_half() / 2) * squares_;
      const Eigen::VectorXd correction = J.partialPivLu().solve(residual);
      const double size = (answers_ * correction).cwiseAbs().maxCoeff();
      go_on(-correction);
      const double way = (answers_ * rates_).cwiseAbs().maxCoeff() * dt_ + size;
      if (size <= dynamics_.newton.tolerance * way || (size > 0.5 * last && size < 1e-12 * solid_.length())) {
        look_at_next();
        return {};
      }
      last = size;
    }
    return {"the solid's equations do not converge"};
  }

  Status follow(const Eigen::VectorXd& velocities) override {
    next_ = free_posture_;
    way_ = free_way_;
    look_at_next();
    Eigen::VectorXd misses = velocities - at_boundary(s_next_);
    Eigen::MatrixXd at_trial;  // of a body that turns, what answers_ are at t_n
    constexpr int most = 10;   // Gauss and Newton's method: two are usual
    for (int k = 0; k < most && misses.allFinite(); ++k) {
      if (turns()) at_trial = rows_on_surface(tangents(next_));
      if (turns() || fit_.rows() == 0) fit_.compute(turns() ? at_trial : answers_);
      const Eigen::VectorXd change = dt_ * fit_.solve(misses);
      go_on(change);
      look_at_next();
      misses = velocities - at_boundary(s_next_);
      if (((turns() ? at_trial : answers_) * change).norm() <= 1e-12 * dt_ * velocities.norm()) break;
    }
    return misses.allFinite() ? Status{} : Status{"the solid's velocities are not finite"};
  }

  Eigen::VectorXd implied() const override { return momentum_of_trial() - known_; }

  /// Of a body that turns the trial obeys the impulse itself, so that momenta stay exact.
  Renewed renewed(const Eigen::VectorXd& impulse) override {
    if (!turns()) return ElasticWall<d>::renewed(impulse);
    Renewed all;
    all.status = move(impulse);
    all.velocities = at_boundary(s_next_);
    all.free = all.velocities - answers_ * inertia_of_step().ldlt().solve(answers_.transpose() * impulse);
    return all;
  }
  double stray() const override { return std::max(stray_of(way_), stray_of(free_way_)); }

  double trial_energy() const override {
    return 0.5 * (s_next_.dot(solid_.mass() * s_next_) + squares_.dot(middle().cwiseAbs2()));
  }

  ModalInertia linearised() override {
    free_posture_ = next_;
    free_way_ = way_;
    return {answers_, inertia_of_step()};
  }

  void accept() override {
    Eigen::MatrixXd momenta = momenta_, inertia = inertia_;
    if (turns()) {
      const Eigen::MatrixXd P = tangents(next_);
      momenta = solid_.mass() * P;
      inertia = P.transpose() * momenta;
    }
    Eigen::VectorXd momentum = (1 - dynamics_.damping.mass * dt_ / 2) * (momenta.transpose() * s_next_);
    momentum.tail(squares_.size()) -= resistance() + damping_of_second_half();
    last_slopes_ = slopes();
    last_damping_ = damping_of_second_half();
    carrier_ = next_carrier_;
    last_dt_ = dt_;
    if (drive_.size() > 0) momentum -= momenta.transpose() * solid_.uniform(carrier_);
    rates_ = inertia.ldlt().solve(momentum);
    between_ = middle();
    now_ = next_;
    u_ = displacements();
  }
  double damping_work() const override {
    const Field mean = 0.5 * (s_ + s_next_);
    return 0.5 * (last_slopes_ + slopes()).dot(last_damping_ + damping_of_first_half()) +
           dynamics_.damping.mass / 2 * mean.dot(solid_.mass() * (last_dt_ * s_ + dt_ * s_next_));
  }
  double drive_work(const Field& impulse) const override {
    const Field drag = dynamics_.damping.mass / 2 * (last_dt_ * s_ + dt_ * s_next_);
    const Field lacks = solid_.mass() * (s_next_ - s_ + drag) - load_ - impulse;
    return lacks.dot(solid_.uniform(0.5 * (carrier_ + next_carrier_)));  // no other force has a resultant
  }
  void write(std::ostream& out) const override {
    Field all(2 * d + d * d + 1);
    all << now_.centre, now_.turn.reshaped(), carrier_, last_dt_;
    write_field(out, all);
    for (const auto* field : {&now_.amplitudes, &between_, &rates_, &last_slopes_, &last_damping_})
      write_field(out, *field);
  }
  void read(std::istream& in) override {
    Field all(2 * d + d * d + 1);
    read_field(in, all);
    now_.centre = all.template head<d>();
    now_.turn = all.template segment<d * d>(d).reshaped(d, d);
    carrier_ = all.template segment<d>(d + d * d);
    last_dt_ = all[2 * d + d * d];
    for (auto* field : {&now_.amplitudes, &between_, &rates_, &last_slopes_, &last_damping_}) read_field(in, *field);
    u_ = displacements();
  }

 private:
  /// Whether tangents change: those of a body that is held do not.
  bool turns() const { return frame_ > 0; }
  void set_tangents() {
    tangents_ = tangents(now_);
    momenta_ = solid_.mass() * tangents_;
    inertia_ = tangents_.transpose() * momenta_;
    answers_ = rows_on_surface(tangents_);
  }
  Eigen::MatrixXd rows_on_surface(const Eigen::MatrixXd& tangents) const {
    Eigen::MatrixXd rows(boundary_.nodes.size() * d, tangents.cols());
    for (Eigen::Index k = 0; k < tangents.cols(); ++k) rows.col(k) = at_boundary(tangents.col(k));
    return rows;
  }
  /// What moves clamps that all move alike: the mean over held unknowns, axis by axis.
  Vec<d> carrier_of(const Field& drive) const {
    Vec<d> sum = Vec<d>::Zero(), count = sum;
    for (Eigen::Index k = 0; k < drive.size(); ++k)
      if (solid_.held()[static_cast<std::size_t>(k)]) sum[k % d] += drive[k], count[k % d] += 1;
    return sum.cwiseQuotient(count.cwiseMax(1));
  }
  Eigen::VectorXd slopes() const { return way_.amplitudes / dt_; }
  /// beta + 2 c dt: in the first half of a step damping has it in place of beta.
  double first_half() const { return dynamics_.damping.stiffness + 2 * dynamics_.unresolved * dt_; }
  /// dt/2 (beta + 2 c dt) L dq of the trial.
  Eigen::VectorXd damping_of_first_half() const { return dt_ / 2 * first_half() * squares_.cwiseProduct(slopes()); }
  /// dt/2 beta L dq - c dt L (q_mid - q_mid of the step before).
  Eigen::VectorXd damping_of_second_half() const {
    return dt_ * squares_.cwiseProduct(dynamics_.damping.stiffness / 2 * slopes() -
                                       dynamics_.unresolved * (middle() - between_));
  }
  /// q_mid of the trial.
  Eigen::VectorXd middle() const { return now_.amplitudes + 0.5 * way_.amplitudes; }
  Field places(const Posture<d>& posture) const {
    Field x = arms_ + shapes_ * posture.amplitudes;
    if (!turns()) return x + solid_.uniform(posture.centre);
    for (Eigen::Index a = 0; a < x.size(); a += d) x.segment<d>(a) = posture.centre + posture.turn * x.segment<d>(a);
    return x;
  }
  /// Columns: translations, turns about the centre, modes as they are turned.
  Eigen::MatrixXd tangents(const Posture<d>& posture) const {
    Eigen::MatrixXd P(solid_.size(), frame_ + shapes_.cols());
    const Field x = places(posture);
    for (Eigen::Index a = 0; a < x.size(); a += d) {
      if (frame_ > 0) {
        const Vec<d> arm = x.segment<d>(a) - posture.centre;
        P.block<d, d>(a, 0).setIdentity();
        for (int k = 0; k < rotations<d>; ++k)
          P.col(d + k).segment<d>(a) = cross(Eigen::Matrix<double, rotations<d>, 1>::Unit(k).eval(), arm);
      }
      P.block(a, frame_, d, shapes_.cols()) = posture.turn * shapes_.middleRows(a, d);
    }
    return P;
  }
  /// The trial, along tangents. exp(w) - 1 = (h - h^T) h with h = exp(w/2).
  void go_on(const Eigen::VectorXd& change) {
    if (frame_ > 0) {
      const Eigen::Matrix<double, rotations<d>, 1> w = change.segment<rotations<d>>(d);
      const Mat<d> half = rotation((0.5 * w).eval());
      next_.centre += change.head<d>();
      way_.centre += change.head<d>();
      way_.turn += (half - half.transpose()) * half * next_.turn;
      next_.turn = rotation(w) * next_.turn;
    }
    way_.amplitudes += change.tail(shapes_.cols());
    next_.amplitudes = now_.amplitudes + way_.amplitudes;
  }
  /// How far places are from those of another posture, which has the turn R: shift + way.turn (X - C + sum q_k phi_k) + R way.q_k phi_k.
  Field moved(const Posture<d>& to, const Way<d>& way, const Mat<d>& R) const {
    Field x = shapes_ * way.amplitudes;
    const Field arms = frame_ > 0 ? Field(arms_ + shapes_ * to.amplitudes) : Field();
    for (Eigen::Index a = 0; a < x.size(); a += d) {
      const Vec<d> own = x.segment<d>(a);
      x.segment<d>(a) = way.centre + R * own;
      if (frame_ > 0) x.segment<d>(a) += way.turn * arms.segment<d>(a);
    }
    return x;
  }
  /// Of a step on the surface: what its velocities are not those along tangents.
  double stray_of(const Way<d>& way) const {
    if (!turns()) return 0;
    Eigen::VectorXd along(frame_ + shapes_.cols());
    along << way.centre, axis_of<d>(way.turn * now_.turn.transpose()), way.amplitudes;
    Posture<d> to = now_;
    to.amplitudes += way.amplitudes;
    return (at_boundary(moved(to, way, now_.turn)) - answers_ * along).norm() / dt_;
  }
  void look_at_next() { s_next_ = moved(next_, way_, now_.turn) / dt_; }
  Field displacements() const {
    const Mat<d> one = Mat<d>::Identity();
    return moved(now_, {now_.centre - solid_.centre(Field::Zero(solid_.size())), now_.turn - one, now_.amplitudes},
                 one);
  }
  /// dt/2 L q_mid of the trial.
  Eigen::VectorXd resistance() const { return dt_ / 2 * squares_.cwiseProduct(middle()); }
  /// P_n^T M_s P_n.
  Eigen::MatrixXd inertia_of_step() const {
    Eigen::MatrixXd inertia = (1 + dynamics_.damping.mass * dt_ / 2) * inertia_;
    inertia.diagonal().tail(squares_.size()) += dt_ / 2 * (dt_ / 2 + first_half()) * squares_;
    return inertia;
  }
  /// Left side of the equations.
  Eigen::VectorXd momentum_of_trial() const {
    Eigen::VectorXd sum = (1 + dynamics_.damping.mass * dt_ / 2) * (momenta_.transpose() * s_next_);
    sum.tail(squares_.size()) += resistance() + damping_of_first_half();
    return sum;
  }

  int frame_;               // columns of P that belong to it
  Eigen::MatrixXd shapes_;  // of the modes besides
  Eigen::VectorXd squares_;
  Field arms_;                            // X - C
  Posture<d> now_, next_, free_posture_;  // at t_n, of the trial, of the one without an impulse
  Way<d> way_, free_way_;                 // from now_ to these two
  Eigen::VectorXd between_;               // amplitudes in the middle of the last step
  Eigen::VectorXd rates_;                 // v_n = P_n times these, and the carrier
  Vec<d> carrier_ = Vec<d>::Zero(), next_carrier_ = Vec<d>::Zero();  // clamps' velocity of the last step, of this one
  Eigen::VectorXd last_slopes_, last_damping_;                       // of the last step: dq, dt/2 beta L dq
  double last_dt_ = 0;
  Eigen::MatrixXd tangents_, momenta_, inertia_, answers_;       // P, M P, P^T M P and rows of P on the surface, at t_n
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> fit_;  // least squares of velocities on the surface
  Eigen::VectorXd known_;
  long iterations_ = 0;
};

}  // namespace

template <int d>
std::unique_ptr<ElasticWall<d>> modal_wall(const Solid<d>& solid, Dynamics dynamics, int modes) {
  return std::make_unique<ModalWall<d>>(solid, std::move(dynamics), modes);
}

template std::unique_ptr<ElasticWall<2>> modal_wall<2>(const Solid<2>&, Dynamics, int);
template std::unique_ptr<ElasticWall<3>> modal_wall<3>(const Solid<3>&, Dynamics, int);

}  // namespace splashdown::elastic
