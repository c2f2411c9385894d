// A new mesh where bodies have moved theirs too far, between steps. What the flow has is carried over where it lives: velocities
// v- of t_{n-1/2} on the nodes' places of then, of which the last step has foreseen those of walls. On the new mesh v is that with
//
//   int phi . (v - v-) - q div phi = 0,   int p div v = 0
//
// and with the velocities of walls and sides: the nearest in L2 among those that the equation of continuity allows. It is off by
// h^3, and a step from it starts like any other one.
#include <algorithm>
#include <stdexcept>

#include "core/stopwatch.hpp"
#include "fluid/ale/fluid.hpp"
#include "fluid/ale/mesh/field_on_mesh.hpp"
#include "fluid/ale/mesh_spec.hpp"

namespace splashdown::ale {
namespace {

constexpr double decline = 0.3;      // of the quality at which there was no new mesh, until another one is tried
constexpr int most_growth = 4;       // nodes over those of the first mesh
constexpr int projection_steps = 2;  // the second takes the roundoff of the first away

}  // namespace

Nodes AleFlow::places_on(const std::vector<Eigen::VectorXd>& placements, std::span<const int> walls,
                         const Nodes& at_start) const {
  Nodes places = at_start;
  for (std::size_t w = 0; w < spec_.walls.size(); ++w) {
    std::vector<Eigen::Index> points;
    for (std::size_t k = 0; k < walls.size(); ++k)
      if (walls[k] == static_cast<int>(w)) points.push_back(static_cast<Eigen::Index>(k));
    if (!points.empty())
      places(Eigen::all, points) = motion_of(w, at_start(Eigen::all, points))->positions(placements[w]);
  }
  return places;
}

MovedMesh AleFlow::mesh_around(const std::vector<Eigen::VectorXd>& placements) const {
  return moved_mesh(mesh_spec(spec_), lines_, [&](std::span<const int> walls, const Nodes& at_start) {
    return places_on(placements, walls, at_start);
  });
}

/// All that hangs on the mesh but the state.
void AleFlow::adopt(FlowMesh mesh, const Nodes& at_start, std::vector<Eigen::VectorXd> placements) {
  mesh_ = std::move(mesh);
  equations_ = FlowEquations(mesh_, spec_.density, spec_.viscosity, open_sides(spec_));
  extension_ = std::make_unique<Extension>(mesh_, spec_.extension);
  quality_ = MeshQuality(mesh_);
  place_walls(at_start);
  given_ = GivenUnknowns(given_unknowns(spec_, mesh_, equations_));
  made_at_ = std::move(placements);
  kept_ = {};
  of_step_ = {};
  of_pass_ = {};
  kept_answers_ = {};
  step_answers_ = {};
  bearable_ = worn;
  look_at_mesh();
}

/// Now, or after a step like the last one: nodes move by as much again.
bool AleFlow::is_mesh_worn() const {
  if (!spec_.remesh || x_ == mesh_.nodes) return false;
  const Stopwatch watch(mesh_seconds_);
  return quality_.least(x_) < bearable_ || quality_.least(2 * x_ - fields_.x) < bearable_;
}

/// Around the walls where they are, unless there is none or it is too large.
std::optional<MovedMesh> AleFlow::mesh_now() const {
  try {
    auto made = mesh_around(state_.placements);
    if (made.mesh.size() <= most_growth * first_size_) return made;
  } catch (const std::invalid_argument&) {
  }
  return {};
}

/// Keeps the mesh where there is no other, and tries again when it is worse: a later step may be refused.
void AleFlow::remesh() {
  const Stopwatch watch(mesh_seconds_);
  auto made = mesh_now();
  if (!made) {
    ++missed_;
    const double quality = std::min(quality_.least(x_), quality_.least(2 * x_ - fields_.x));
    bearable_ = quality - decline * std::abs(quality);
    return;
  }
  const FlowMesh old = mesh_;
  adopt(std::move(made->mesh), made->at_start, state_.placements);
  transfer(old, fields_.x_after, x_);
  ++remeshings_;
}

void AleFlow::transfer(const FlowMesh& old, const Nodes& places_then, const Nodes& places_now) {
  const State before = state_;
  const FlowEquations of_old(old, spec_.density, 0, {});
  const PlacesInMesh then(old, places_then), now(old, places_now);
  x_ = mesh_.nodes;
  const Nodes places = places_of(middle_);
  state_.velocity = projected(
      places, [&](const Vec<2>& x) { return then.quadratic(before.velocity, x); }, time_ - 0.5 * state_.dt);
  const Nodes change = before.velocity - before.before;
  state_.before = state_.velocity;
  for (int a = 0; a < mesh_.size(); ++a)
    if (wall_of_[static_cast<std::size_t>(a)] < 0) state_.before.col(a) -= then.quadratic(change, places.col(a));
  state_.pressure.resize(mesh_.corners);
  for (int k = 0; k < mesh_.corners; ++k) state_.pressure[k] = now.linear(before.pressure, x_.col(k));
  const double gained =
      equations_.kinetic_energy(places, state_.velocity) - of_old.kinetic_energy(places_then, before.velocity);
  momentum_of_remesh_ +=
      (equations_.momentum(places, state_.velocity) - of_old.momentum(places_then, before.velocity)).norm();
  ledger_.energy_remesh += gained;
  ledger_.kinetic_energy += gained;
}

/// Equations of a step without viscosity and convection, whose force is the field.
Nodes AleFlow::projected(const Nodes& places, const std::function<Vec<2>(const Vec<2>&)>& field, double time) const {
  const FlowEquations equations(mesh_, spec_.density, 0, {});
  const Nodes none = Nodes::Zero(2, mesh_.size());
  StepFields fields{.x = places, .x_after = places, .before = none, .mesh_velocity = none, .rate = 1, .theta = 0};
  Unknowns at = Unknowns::Zero(equations.size());
  give_sides(spec_, mesh_, equations, time, at);
  for (std::size_t w = 0; w < moved_.size(); ++w) {
    const Eigen::VectorXd of_nodes = moved_[w].motion->basis(middle_[w]) * state_.rates[w];
    for (std::size_t k = 0; k < moved_[w].nodes.size(); ++k)
      at.segment<2>(2 * moved_[w].nodes[k]) = of_nodes.segment<2>(2 * static_cast<Eigen::Index>(k));
  }
  FactoredSlope slope;
  double assembly = 0, factor = 0;
  if (!slope.make(equations, given_, fields, at, assembly, factor))
    throw std::runtime_error("the velocities of the fluid have no place on a new mesh");
  fields.force = field;
  Eigen::VectorXd residual;
  for (int k = 0; k < projection_steps; ++k) {
    equations.residual(fields, at, residual);
    given_.add(slope.correction(given_.gather(residual)), at);
  }
  return at.head(2 * mesh_.size()).reshaped(2, mesh_.size());
}

}  // namespace splashdown::ale
