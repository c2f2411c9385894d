#include "elastic/participant.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <istream>
#include <limits>
#include <ostream>
#include <stdexcept>

#include "core/geometry.hpp"
#include "core/stored.hpp"

namespace splashdown::elastic {
namespace {

/// Places of the nodes at rest, and of the nodes that are moved by u.
template <int d>
Field places(const Solid<d>& solid) {
  return Eigen::Map<const Field>(solid.mesh().nodes.data(), solid.mesh().nodes.size());
}

/// sum of m (x - c)(y - e)^T over the body, of two fields and their means.
template <int d>
Mat<d> spread(const Solid<d>& solid, const Field& x, const Vec<d>& c, const Field& y, const Vec<d>& e) {
  const Field p = solid.mass() * (y - solid.uniform(e));
  Mat<d> sum = Mat<d>::Zero();
  for (int a = 0; a < solid.mesh().size(); ++a) sum += (x.segment<d>(d * a) - c) * p.segment<d>(d * a).transpose();
  return sum;
}

/// Velocity of the centre and the turn that has the same angular momentum about it.
template <int d>
Twist<d> twist_of(const Solid<d>& solid, const Field& u, const Field& v) {
  const Vec<d> centre = solid.centre(u);
  const auto momenta = solid.momenta(u - solid.uniform(centre), v);
  Twist<d> twist;
  twist.template head<d>() = momenta.linear / solid.total_mass();
  const Field x = places(solid) + u;
  const Mat<d> moments = spread<d>(solid, x, centre, x, centre);
  if constexpr (d == 2)
    twist[2] = momenta.angular[0] / moments.trace();
  else
    twist.template tail<3>() = (moments.trace() * Mat<3>::Identity() - moments).inverse() * momenta.angular;
  return twist;
}

/// The rotation that fits best, sum m |x - c - R (X - C)|^2 least (Kabsch 1976).
template <int d>
Mat<d> rotation_of(const Solid<d>& solid, const Field& u) {
  const Field zero = Field::Zero(u.size()), X = places(solid);
  const Mat<d> both = spread<d>(solid, X + u, solid.centre(u), X, solid.centre(zero));
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(both, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat<d> turn = Mat<d>::Identity();
  turn(d - 1, d - 1) = (svd.matrixU() * svd.matrixV().transpose()).determinant() > 0 ? 1 : -1;
  return svd.matrixU() * turn * svd.matrixV().transpose();
}

void write(std::ostream& out, const Field& field) {
  const auto count = static_cast<std::uint64_t>(field.size());
  out.write(reinterpret_cast<const char*>(&count), sizeof count);
  out.write(reinterpret_cast<const char*>(field.data()), static_cast<std::streamsize>(count * sizeof(double)));
}

void read(std::istream& in, Field& field) {
  if (stored_count(in, sizeof(double)) != static_cast<std::size_t>(field.size()) ||
      !in.read(reinterpret_cast<char*>(field.data()), static_cast<std::streamsize>(field.size() * sizeof(double))) ||
      !field.allFinite())
    throw std::runtime_error("holds no motion of this solid");
}

}  // namespace

template <int d>
Participant<d>::Participant(std::vector<SolidSpec<d>> specs) {
  for (auto& spec : specs) {
    auto& body = bodies_.emplace_back(Moving{.spec = std::move(spec)});
    const auto& solid = *body.spec.solid;
    const Field weight = solid.mass() * solid.uniform(body.spec.gravity);
    body.scheme = body.spec.scheme({.system = &solid,
                                    .damping = body.spec.damping,
                                    .load = [weight, forces = body.spec.forces](double t) -> Field {
                                      return forces ? weight + forces(t) : weight;
                                    }});
    body.now.u = body.now.v = Field::Zero(solid.size());
    const Vec<d> centre = solid.centre(body.now.u);
    const auto& start = body.spec.body.velocity;
    const Eigen::Matrix<double, rotations<d>, 1> spin = start.template tail<rotations<d>>();
    for (int a = 0; a < solid.mesh().size(); ++a) {
      const Vec<d> arm = solid.mesh().nodes.col(a) - centre;
      body.now.v.template segment<d>(d * a) = start.template head<d>() + cross(spin, arm);
    }
    leave_out(solid.held(), body.now.v);
    if (const auto status = body.scheme->accelerate(body.now); !status.ok()) throw std::invalid_argument(status.cause);
    look(body);
  }
}

template <int d>
void Participant<d>::look(Moving& body) const {
  const auto& solid = *body.spec.solid;
  const auto& now = body.now;
  const Vec<d> before = solid.centre(Field::Zero(now.u.size()));
  body.state.pose.linear() = rotation_of<d>(solid, now.u) * body.spec.body.pose.linear();
  body.state.pose.translation() = body.spec.body.pose.translation() + solid.centre(now.u) - before;
  body.state.velocity = twist_of<d>(solid, now.u, now.v);
  body.acceleration = twist_of<d>(solid, now.u, now.a);
}

template <int d>
double Participant<d>::stable_dt() const {
  return std::numeric_limits<double>::infinity();  // all schemes are implicit
}

template <int d>
double Participant<d>::length() const {
  double longest = 0;
  for (const auto& body : bodies_) longest = std::max(longest, body.spec.solid->length());
  return longest;
}

template <int d>
void Participant<d>::begin(const coupling::Step& step) {
  if (!(step.kick > 0 && step.dt > 0)) throw std::invalid_argument("kick and dt must be positive");
  dt_ = step.dt;
}

template <int d>
const coupling::Velocities& Participant<d>::solve(const coupling::Impulse&) {
  status_ = {};
  for (auto& body : bodies_) {
    status_ = body.scheme->step(body.now, dt_, body.next);
    if (!status_.ok()) break;
  }
  return none_;
}

template <int d>
void Participant<d>::commit() {
  for (auto& body : bodies_) {
    std::swap(body.now, body.next);
    look(body);
  }
  time_ += dt_;
}

template <int d>
Deformation<d> Participant<d>::deformation(std::size_t body) const {
  const auto& [spec, scheme, now, next, state, acceleration] = bodies_.at(body);
  const auto& solid = *spec.solid;
  const auto peak = solid.peak(now.u);
  return {.strain_energy = solid.strain_energy(now.u),
          .kinetic_energy = 0.5 * now.v.dot(solid.mass() * now.v),
          .potential_energy = -now.u.dot(solid.mass() * solid.uniform(spec.gravity)),
          .von_mises = peak.value,
          .at = peak.at};
}

template <int d>
std::vector<Diagnostic> Participant<d>::displacements() const {
  std::vector<Diagnostic> all;
  for (const auto& body : bodies_)
    for (const auto& [name, place] : body.spec.points) {
      const Vec<d> u = body.spec.solid->value(body.now.u, place);
      for (int k = 0; k < d; ++k) all.push_back({name + ".u" + "xyz"[k], u[k]});
    }
  return all;
}

template <int d>
long Participant<d>::iterations() const {
  long sum = 0;
  for (const auto& body : bodies_) sum += body.scheme->iterations();
  return sum;
}

template <int d>
void Participant<d>::save(std::ostream& out) const {
  out.write(reinterpret_cast<const char*>(&time_), sizeof time_);
  for (const auto& body : bodies_)
    for (const auto* field : {&body.now.u, &body.now.v, &body.now.a}) write(out, *field);
}

template <int d>
void Participant<d>::load(std::istream& in) {
  if (!in.read(reinterpret_cast<char*>(&time_), sizeof time_) || !(time_ >= 0 && std::isfinite(time_)))
    throw std::runtime_error("holds no time");
  for (auto& body : bodies_) {
    for (auto* field : {&body.now.u, &body.now.v, &body.now.a}) read(in, *field);
    body.now.t = time_;
    look(body);
  }
}

template class Participant<2>;
template class Participant<3>;

}  // namespace splashdown::elastic
