#include "elastic/participant.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <istream>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <tuple>

#include "core/geometry.hpp"
#include "elastic/stored_field.hpp"

namespace splashdown::elastic {
namespace {

/// Places of the nodes at rest, and of the nodes that are moved by u.
template <int d>
Field places(const Solid<d>& solid) {
  return Eigen::Map<const Field>(solid.mesh().nodes.data(), solid.mesh().nodes.size());
}

/// Volume that a closed surface encloses.
template <int d>
double enclosed_by(const Surface<d>& surface) {
  double sum = 0;
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
    std::array<Vec<d>, d> corners;
    for (int k = 0; k < d; ++k) corners[static_cast<std::size_t>(k)] = surface.vertices.col(surface.facets(k, f));
    sum += corners[0].dot(area_vector(corners)) / d;
  }
  return sum;
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

/// NAME.ux, NAME.exy and so on.
template <int d>
void add_signal(const Solid<d>& solid, const SolidState& now, const NamedPlace<d>& point, PointSignal signal,
                std::vector<Diagnostic>& all) {
  constexpr const char* axes = "xyz";
  const auto vector = [&](const Field& field, char letter) {
    const Vec<d> value = solid.value(field, point.place);
    for (int k = 0; k < d; ++k) all.push_back({point.name + "." + letter + axes[k], value[k]});
  };
  switch (signal) {
    case PointSignal::displacement:
      return vector(now.u, 'u');
    case PointSignal::velocity:
      return vector(now.v, 'v');
    case PointSignal::acceleration:
      return vector(now.a, 'a');
    case PointSignal::strain:
      const Mat<d> E = solid.strain(now.u, point.place);
      for (int i = 0; i < d; ++i)
        for (int k = i; k < d; ++k) all.push_back({point.name + ".e" + axes[i] + axes[k], E(i, k)});
  }
}

}  // namespace

template <int d>
Participant<d>::Participant(std::vector<SolidSpec<d>> specs) {
  Eigen::Index first = 0;
  for (auto& spec : specs) {
    auto& body = bodies_.emplace_back(Moving{.spec = std::move(spec)});
    start(body);
    if (!body.wall) continue;
    const auto& surface = body.wall->boundary().surface;
    body.first = first;
    body.count = surface.vertices.size();
    walls_.push_back({.name = body.spec.body.name,
                      .first = first,
                      .count = body.count,
                      .answers = true,
                      .mass = body.spec.solid->total_mass(),
                      .volume = enclosed_by(surface)});
    first += body.count;
  }
  scales_ = Eigen::VectorXd::Ones(first);
}

template <int d>
void Participant<d>::start(Moving& body) {
  const auto& solid = *body.spec.solid;
  const Field weight = solid.mass() * solid.uniform(body.spec.gravity);
  const Dynamics dynamics{
      .system = &solid,
      .damping = body.spec.damping,
      .load = [weight, forces = body.spec.forces](double t) -> Field { return forces ? weight + forces(t) : weight; },
      .drive = body.spec.drive,
      .unresolved = body.spec.unresolved};
  body.now.u = body.now.v = body.now.a = Field::Zero(solid.size());
  const Vec<d> centre = solid.centre(body.now.u);
  const auto& velocity = body.spec.body.velocity;
  const Eigen::Matrix<double, rotations<d>, 1> spin = velocity.template tail<rotations<d>>();
  for (int a = 0; a < solid.mesh().size(); ++a) {
    const Vec<d> arm = solid.mesh().nodes.col(a) - centre;
    body.now.v.template segment<d>(d * a) = velocity.template head<d>() + cross(spin, arm);
  }
  leave_out(solid.held(), body.now.v);
  if (body.spec.drive) body.now.v += body.spec.drive(0);
  if (body.spec.wall) {
    const auto [modes, all_nodes] = *body.spec.wall;
    body.wall = modes > 0 && !all_nodes ? modal_wall<d>(solid, dynamics, modes) : nodal_wall<d>(solid, dynamics, modes);
    body.wall->start(body.now.v);
  } else {
    if (body.spec.from_equilibrium) settle(body, dynamics);
    body.scheme = body.spec.scheme(dynamics);
    if (const auto status = body.scheme->accelerate(body.now); !status.ok()) throw std::invalid_argument(status.cause);
  }
  look(body);
}

template <int d>
void Participant<d>::settle(Moving& body, const Dynamics& dynamics) {
  SolidState before = body.now, rest;
  before.t = -1;  // one step of `steady` ends at t = 0
  if (const auto status = steady(dynamics)->step(before, 1, rest); !status.ok())
    throw std::invalid_argument(status.cause);
  body.now.u = rest.u;
}

template <int d>
void Participant<d>::look(Moving& body) const {
  if (body.wall) {
    body.now.u = body.wall->displacement();
    body.now.v = body.wall->velocity();
    body.now.a = body.wall->acceleration();
  }
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
  constexpr double turn = 0.5;  // [rad]: as rigid bodies may; else all schemes are implicit
  double dt = std::numeric_limits<double>::infinity();
  for (const auto& body : bodies_)
    if (body.wall) dt = std::min(dt, turn / body.state.velocity.template tail<rotations<d>>().norm());
  return dt;
}

template <int d>
Eigen::VectorXd Participant<d>::speeds(const coupling::Velocities& velocities) const {
  Eigen::VectorXd all(static_cast<Eigen::Index>(walls_.size()));
  for (std::size_t w = 0; w < walls_.size(); ++w)
    all[static_cast<Eigen::Index>(w)] = velocities.segment(walls_[w].first, walls_[w].count)
                                            .reshaped(d, walls_[w].count / d)
                                            .colwise()
                                            .norm()
                                            .maxCoeff();
  return all;
}

template <int d>
coupling::Velocities Participant<d>::velocities() const {
  coupling::Velocities all(scales_.size());
  for (const auto& body : bodies_)
    if (body.wall) all.segment(body.first, body.count) = body.wall->velocities();
  return all;
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
  status_ = {};
  for (auto& body : bodies_) {
    if (body.wall)
      body.wall->begin(time_, step.kick, dt_);
    else if (status_.ok())
      status_ = body.scheme->step(body.now, dt_, body.next);
  }
}

template <int d>
coupling::Response Participant<d>::response() const {
  coupling::Response all{.free = coupling::Velocities::Zero(scales_.size()), .modal = {}, .contacts = {}};
  Eigen::Index modes = 0;
  for (const auto& body : bodies_)
    if (body.wall) modes += body.wall->modal().modes.cols();
  all.modal.modes = Eigen::MatrixXd::Zero(scales_.size(), modes);
  all.modal.inertia = Eigen::MatrixXd::Zero(modes, modes);
  Eigen::Index at = 0;
  for (const auto& body : bodies_) {
    if (!body.wall) continue;
    const auto& [Z, M] = body.wall->modal();
    all.free.segment(body.first, body.count) = body.wall->free();
    all.modal.modes.block(body.first, at, Z.rows(), Z.cols()) = Z;
    all.modal.inertia.block(at, at, M.rows(), M.cols()) = M;
    at += M.cols();
  }
  return all;
}

template <int d>
template <class Each>
const coupling::Velocities& Participant<d>::try_walls(const Each& each) {
  trial_.resize(scales_.size());
  for (auto& body : bodies_)
    if (body.wall) trial_.segment(body.first, body.count) = each(body);
  return trial_;
}

template <int d>
const coupling::Velocities& Participant<d>::solve(const coupling::Impulse& impulse) {
  return try_walls([&](Moving& body) { return body.wall->solve(impulse.segment(body.first, body.count)); });
}

template <int d>
const coupling::Velocities& Participant<d>::adopt(const coupling::Velocities& velocities) {
  return try_walls([&](Moving& body) { return body.wall->adopt(velocities.segment(body.first, body.count)); });
}

template <int d>
bool Participant<d>::update_contacts(const coupling::Impulse& impulse) {
  constexpr double tolerance = 1e-7;  // of velocities: below what the exact term's residual may be
  bool changes = false;
  for (auto& body : bodies_)
    if (body.wall) changes |= body.wall->update(impulse.segment(body.first, body.count), tolerance);
  return changes;
}

template <int d>
coupling::Placement Participant<d>::placement() const {
  coupling::Placement all(scales_.size());
  for (const auto& body : bodies_)
    if (body.wall) all.segment(body.first, body.count) = body.wall->placement();
  return all;
}

template <int d>
coupling::Status Participant<d>::acceptable() const {
  coupling::Status status = status_;
  for (const auto& body : bodies_)
    if (body.wall && status.ok()) status = body.wall->acceptable();
  return status;
}

template <int d>
void Participant<d>::commit() {
  for (auto& body : bodies_) {
    if (body.wall)
      body.wall->commit();
    else
      std::swap(body.now, body.next);
    look(body);
  }
  time_ += dt_;
}

template <int d>
Momenta<d> Participant<d>::momenta(std::size_t body) const {
  const auto& moving = bodies_.at(body);
  return moving.spec.solid->momenta(moving.now.u, moving.now.v);
}

template <int d>
double Participant<d>::energy(std::size_t body) const {
  const auto& [spec, now] = std::tie(bodies_.at(body).spec, bodies_.at(body).now);
  const auto* wall = bodies_.at(body).wall.get();
  return 0.5 * now.v.dot(spec.solid->mass() * now.v) +
         (wall ? wall->strain_energy() : spec.solid->strain_energy(now.u));
}

template <int d>
Deformation<d> Participant<d>::deformation(std::size_t body) const {
  const auto& moving = bodies_.at(body);
  const auto& [spec, now] = std::tie(moving.spec, moving.now);
  const auto& solid = *spec.solid;
  const auto peak = solid.peak(now.u);
  const auto* wall = moving.wall.get();
  const auto part = static_cast<std::size_t>(solid.part(peak.cell));
  return {.strain_energy = wall ? wall->strain_energy_between() : solid.strain_energy(now.u),
          .kinetic_energy = wall ? wall->kinetic_energy_between() : 0.5 * now.v.dot(solid.mass() * now.v),
          .potential_energy = -now.u.dot(solid.mass() * solid.uniform(spec.gravity)),
          .dissipated = wall ? wall->dissipated() : 0,
          .clamp_work = wall ? wall->driven() : 0,
          .von_mises = peak.value,
          .von_mises_error = solid.stress_error(now.u, peak),
          .at = peak.at,
          .part = part > 0 && part <= spec.parts.size() ? spec.parts[part - 1] : "",
          .nodes = static_cast<std::size_t>(solid.mesh().size()),
          .cells = solid.mesh().cells.size()};
}

template <int d>
DeformedSurface<d> Participant<d>::deformed(std::size_t body) const {
  const auto& [spec, now] = std::tie(bodies_.at(body).spec, bodies_.at(body).now);
  auto boundary = boundary_of<d>(spec.solid->mesh());
  const auto stress = spec.solid->nodal_stress(now.u);
  DeformedSurface<d> all{
      .surface = std::move(boundary.surface), .displacement = {}, .v = {}, .stress = {}, .von_mises = {}};
  for (std::size_t k = 0; k < boundary.nodes.size(); ++k) {
    const int a = boundary.nodes[k];
    const Vec<d> u = now.u.template segment<d>(d * a);
    all.surface.vertices.col(static_cast<Eigen::Index>(k)) += u;
    all.displacement.push_back(u);
    all.v.push_back(now.v.template segment<d>(d * a));
    all.stress.push_back(stress[static_cast<std::size_t>(a)]);
    all.von_mises.push_back(elastic::von_mises(all.stress.back()));
  }
  return all;
}

template <int d>
std::vector<Diagnostic> Participant<d>::signals() const {
  std::vector<Diagnostic> all;
  for (const auto& body : bodies_)
    for (const auto& point : body.spec.points)
      for (const auto signal : point.signals) add_signal<d>(*body.spec.solid, body.now, point, signal, all);
  return all;
}

template <int d>
std::vector<GoalValue> Participant<d>::goals() const {
  std::vector<GoalValue> all;
  for (const auto& body : bodies_) {
    const auto& spec = body.spec;
    const LoadOn<d> load = [&](const Solid<d>& solid) -> Field {
      const Field weight = solid.mass() * solid.uniform(spec.gravity);
      return spec.forces_on ? weight + spec.forces_on(solid, time_) : weight;
    };
    for (const auto& goal : spec.goals) {
      const auto found = goal_error(goal, *spec.solid, body.now.u, load);
      all.push_back({goal.name, found.value, found.error, goal.unit()});
    }
  }
  return all;
}

template <int d>
long Participant<d>::iterations() const {
  long sum = 0;
  for (const auto& body : bodies_) sum += body.wall ? body.wall->iterations() : body.scheme->iterations();
  return sum;
}

template <int d>
void Participant<d>::save(std::ostream& out) const {
  out.write(reinterpret_cast<const char*>(&time_), sizeof time_);
  for (const auto& body : bodies_) {
    if (body.wall)
      body.wall->save(out);
    else
      for (const auto* field : {&body.now.u, &body.now.v, &body.now.a}) write_field(out, *field);
  }
}

template <int d>
void Participant<d>::load(std::istream& in) {
  if (!in.read(reinterpret_cast<char*>(&time_), sizeof time_) || !(time_ >= 0 && std::isfinite(time_)))
    throw std::runtime_error("holds no time");
  for (auto& body : bodies_) {
    if (body.wall)
      body.wall->load(in);
    else
      for (auto* field : {&body.now.u, &body.now.v, &body.now.a}) read_field(in, *field);
    body.now.t = time_;
    look(body);
  }
}

template class Participant<2>;
template class Participant<3>;

}  // namespace splashdown::elastic
