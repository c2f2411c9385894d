// The smallest fluid and the smallest structure behind the seam, with everything known in closed form.
//
//   fluid       I = phi + f,   A phi = -(s - s_before),   A = G^-1,   f = -kick (C s_before + K (q - q_rest))
//   structure   s = Z a',      M (a' - a'_before) = Z^T I + kick (F - S a)
//
// G, C, K: added mass, damping and spring of the water; s, q: velocities and places of the walls' coordinates. M, S, F: inertia,
// stiffness and force of the structure's amplitudes a, whose shapes are the columns of Z.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <istream>
#include <limits>
#include <optional>
#include <ostream>
#include <utility>
#include <vector>

#include "coupling/participant.hpp"

namespace splashdown::coupling::toys {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

inline constexpr double never = std::numeric_limits<double>::infinity();

/// Each coordinate is a piece of the wall that it belongs to, on which stand-ins act alike: K = (laplacian + robin) 1.
class Water final : public FluidPart, private Linearised {
 public:
  struct State {
    double time = 0;
    Vector place, rate, impulse;  // impulse: phi of the last step
  };

  Water(Matrix added_mass, Matrix damping, Matrix spring, std::vector<std::size_t> wall_of)
      : G_(std::move(added_mass)), C_(std::move(damping)), K_(std::move(spring)), wall_of_(std::move(wall_of)) {
    now_.place = now_.rate = now_.impulse = Vector::Zero(G_.rows());
  }

  std::string unfit;  // why what was solved last may not be committed
  Vector rest;        // where the spring is relaxed; empty: at zero

  State& state() { return now_; }
  const State& state() const { return now_; }

  double time() const override { return now_.time; }
  double stable_dt() const override { return never; }
  void save(std::ostream& out) const override {
    out.write(reinterpret_cast<const char*>(&now_.time), sizeof now_.time);
    for (const auto* v : {&now_.place, &now_.rate, &now_.impulse})
      out.write(reinterpret_cast<const char*>(v->data()), v->size() * static_cast<std::streamsize>(sizeof(double)));
  }
  void load(std::istream& in) override {
    in.read(reinterpret_cast<char*>(&now_.time), sizeof now_.time);
    for (auto* v : {&now_.place, &now_.rate, &now_.impulse})
      in.read(reinterpret_cast<char*>(v->data()), v->size() * static_cast<std::streamsize>(sizeof(double)));
  }

  Status begin(const Step& step, const InterfaceModel& structure) override {
    step_ = step;
    Z_ = structure.modal.modes;
    M_ = structure.modal.inertia;
    stand_in_ = Vector::Zero(G_.rows());
    pieces_.clear();
    for (std::size_t k = 0; k < wall_of_.size() && !structure.interface_operators.empty(); ++k) {
      const InterfaceOperator& of_wall = structure.interface_operators.at(wall_of_[k]);
      stand_in_[static_cast<Eigen::Index>(k)] = of_wall.laplacian + of_wall.robin;
      if (of_wall.laplacian + of_wall.robin > 0) pieces_.push_back({wall_of_[k], 1});
    }
    return {};
  }
  Status solve(const Pass& pass) override {
    const Vector s_0 = pass.velocities.size() > 0 ? pass.velocities : Vector::Zero(G_.rows());
    const Vector away = rest.size() > 0 ? Vector(now_.place - rest) : now_.place;
    const Vector f = -step_.kick * (C_ * now_.rate + K_ * away);
    Vector lagged = Vector::Zero(G_.rows());
    if (!pieces_.empty()) lagged = pass.lagged;
    const Matrix A = G_.inverse() + Matrix(stand_in_.asDiagonal());
    phi_ = A.ldlt().solve(now_.rate - s_0 + stand_in_.cwiseProduct(lagged));
    solution_.velocities = s_0;
    const auto answer = [&](const Vector& to) -> Vector {
      const Matrix W = pass.contacts.directions.size() > 0 ? pass.contacts.directions
                                                           : Matrix(Matrix::Identity(Z_.cols(), Z_.cols()));
      return W * (W.transpose() * (M_ + Z_.transpose() * G_ * Z_) * W).ldlt().solve(W.transpose() * to);
    };
    const Vector known = pass.contacts.known.size() > 0 ? pass.contacts.known : Vector::Zero(Z_.cols());
    solution_.imbalance = Vector::Zero(G_.rows());
    if (Z_.cols() > 0) {  // without an exact term Z has no rows either
      const Vector y = answer(Z_.transpose() * (phi_ + f) + known);
      phi_ -= G_ * Z_ * y;
      solution_.velocities += Z_ * y;
      solution_.imbalance = Z_ * answer(Z_.transpose() * (phi_ + f) + known - M_ * y);
    }
    solution_.impulse = phi_ + f;
    solution_.lagged = pieces_.empty() ? Vector() : phi_;
    solution_.wetted = Vector::Ones(static_cast<Eigen::Index>(wall_of_.back()) + 1);
    return solution_.impulse.allFinite() ? Status{} : Status{"the toy's solution is not finite"};
  }
  const Solution& solution() const override { return solution_; }
  Status acceptable() const override { return {unfit}; }
  void commit(const Placement& walls) override {
    now_.time += step_.dt;
    now_.place = walls;
    now_.rate = solution_.velocities;
    now_.impulse = phi_;
  }

  std::span<const InterfacePiece> pieces() const override { return pieces_; }
  Vector first_guess() const override { return pieces_.empty() ? Vector() : now_.impulse; }
  const Linearised* linearised() const override { return this; }
  double density() const override { return 0; }
  double roundoff() const override { return std::numeric_limits<double>::epsilon(); }

 private:
  std::vector<Eigen::Index> coordinates(std::span<const std::size_t> walls) const {
    std::vector<Eigen::Index> all;
    for (const std::size_t wall : walls)
      for (std::size_t k = 0; k < wall_of_.size(); ++k)
        if (wall_of_[k] == wall) all.push_back(static_cast<Eigen::Index>(k));
    return all;
  }
  Matrix slope(std::span<const std::size_t> walls) const override {
    const auto some = coordinates(walls);
    const auto count = static_cast<Eigen::Index>(some.size());
    const Matrix inverse = (G_.inverse() + Matrix(stand_in_.asDiagonal())).inverse();
    if (pieces_.empty()) return -inverse(some, some);
    Matrix all(count + G_.rows(), count + G_.rows());
    all << -inverse(some, some), (inverse * stand_in_.asDiagonal())(some, Eigen::all),  //
        -inverse(Eigen::all, some), inverse * stand_in_.asDiagonal();
    return all;
  }
  Matrix added_mass(std::span<const std::size_t> walls) const override {
    const auto some = coordinates(walls);
    return G_(some, some);
  }

  Matrix G_, C_, K_, Z_, M_;
  std::vector<std::size_t> wall_of_;  // of each coordinate
  State now_;
  Step step_;
  Vector stand_in_, phi_;
  std::vector<InterfacePiece> pieces_;
  Solution solution_;
};

/// Amplitudes of shapes, rigid or elastic. All of its walls answer.
class Modal : public StructurePart {
 public:
  struct Made {
    Matrix shapes, inertia, stiffness;  // Z, M, S
    Vector force;                       // F
    std::vector<WallCoordinates> walls;
  };
  explicit Modal(Made made) : made_(std::move(made)), scales_(Vector::Ones(made_.shapes.rows())) {
    amplitude_ = rate_ = next_amplitude_ = next_rate_ = Vector::Zero(made_.shapes.cols());
  }

  Vector& amplitude() { return amplitude_; }
  const Vector& amplitude() const { return amplitude_; }
  const Vector& rate() const { return rate_; }
  const Vector& trial_rate() const { return next_rate_; }

  double time() const override { return time_; }
  double stable_dt() const override { return never; }
  void save(std::ostream& out) const override {
    out.write(reinterpret_cast<const char*>(&time_), sizeof time_);
    for (const auto* v : {&amplitude_, &rate_})
      out.write(reinterpret_cast<const char*>(v->data()), v->size() * static_cast<std::streamsize>(sizeof(double)));
  }
  void load(std::istream& in) override {
    in.read(reinterpret_cast<char*>(&time_), sizeof time_);
    for (auto* v : {&amplitude_, &rate_})
      in.read(reinterpret_cast<char*>(v->data()), v->size() * static_cast<std::streamsize>(sizeof(double)));
  }

  std::string name() const override { return "modal"; }
  const std::vector<WallCoordinates>& walls() const override { return made_.walls; }
  const Vector& scales() const override { return scales_; }
  double length() const override { return 1; }
  Vector speeds(const Velocities& velocities) const override {
    Vector all(static_cast<Eigen::Index>(made_.walls.size()));
    for (Eigen::Index w = 0; w < all.size(); ++w) {
      const auto& wall = made_.walls[static_cast<std::size_t>(w)];
      all[w] = velocities.segment(wall.first, wall.count).norm();
    }
    return all;
  }
  Velocities velocities() const override { return made_.shapes * rate_; }

  void begin(const Step& step) override {
    step_ = step;
    free_ = rate_ + made_.inertia.ldlt().solve(step.kick * (made_.force - made_.stiffness * amplitude_));
  }
  Response response() const override {
    const Eigen::Index count = free_.size();
    return {.free = made_.shapes * free_,
            .modal = {made_.shapes, made_.inertia},
            .contacts = {.directions = Matrix::Identity(count, count), .known = Vector::Zero(count)}};
  }
  const Velocities& solve(const Impulse& impulse) override {
    return move(free_ + made_.inertia.ldlt().solve(made_.shapes.transpose() * impulse));
  }
  const Velocities& adopt(const Velocities& velocities) override {
    return move(made_.shapes.colPivHouseholderQr().solve(velocities));
  }
  Placement placement() const override { return made_.shapes * next_amplitude_; }
  void commit() override {
    amplitude_ = next_amplitude_;
    rate_ = next_rate_;
    time_ += step_.dt;
  }

 protected:
  const Made& made() const { return made_; }
  const Vector& next_amplitude() const { return next_amplitude_; }

 private:
  const Velocities& move(const Vector& rate) {
    next_rate_ = rate;
    next_amplitude_ = amplitude_ + step_.dt * rate;
    return trial_ = made_.shapes * rate;
  }

  Made made_;
  Vector scales_, amplitude_, rate_, next_amplitude_, next_rate_, free_;
  Velocities trial_;
  Step step_;
  double time_ = 0;
};

/// Coordinates of one wall, each a mass of its own.
inline std::vector<WallCoordinates> one_wall(Eigen::Index count, double mass) {
  return {{.name = "wall", .first = 0, .count = count, .answers = true, .mass = mass, .volume = 0}};
}

}  // namespace splashdown::coupling::toys
