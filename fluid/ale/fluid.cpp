#include "fluid/ale/fluid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/geometry.hpp"
#include "core/stopwatch.hpp"
#include "fluid/ale/mesh_spec.hpp"

namespace splashdown::ale {
namespace {

/// Speed of the fastest node.
double fastest_of(const Nodes& velocity) { return velocity.colwise().norm().maxCoeff(); }

constexpr double least_allowed = 0.05;  // of the area that a cell was made with, anywhere in it

}  // namespace

MeshSpec mesh_spec(const AleFlowSpec& spec) {
  MeshSpec mesh{.min = spec.min,
                .max = spec.max,
                .far = spec.far,
                .growth = spec.growth,
                .hulls = {},
                .corner = spec.corner,
                .size = spec.size};
  for (const auto& wall : spec.walls) {
    Hole hull{.outline = wall.surface, .size = wall.size};
    hull.outline.vertices = wall.pose * hull.outline.vertices;
    mesh.hulls.push_back(std::move(hull));
  }
  return mesh;
}

AleFlow::AleFlow(AleFlowSpec spec)
    : spec_(std::move(spec)),
      lines_(divided_lines(mesh_spec(spec_))),
      mesh_(flow_mesh(mesh_spec(spec_), lines_)),
      equations_(mesh_, spec_.density, spec_.viscosity, open_sides(spec_)),
      extension_(std::make_unique<Extension>(mesh_, spec_.extension)),
      quality_(mesh_),
      given_({}) {
  first_size_ = mesh_.size();
  place_walls(mesh_.nodes);
  first_placements();
  given_ = GivenUnknowns(given_unknowns(spec_, mesh_, equations_));
  x_ = mesh_.nodes;
  start();
  look_at_mesh();
  loads_.resize(spec_.walls.size());
  ledger_.kinetic_energy = equations_.kinetic_energy(x_, state_.velocity);
  ledger_.potential_energy = potential_energy(x_);
  ledger_.volume = ledger_.volume_initial = (spec_.max - spec_.min).prod();
  look();
}

/// Nodes of walls and what moves them, by where they were at t = 0. Nodes that two walls share belong to the first of them.
void AleFlow::place_walls(const Nodes& at_start) {
  wall_of_.assign(static_cast<std::size_t>(mesh_.size()), -1);
  moved_.clear();
  moved_.resize(spec_.walls.size());
  for (const auto& edge : mesh_.boundary)
    for (const int a : edge.nodes) {
      auto& wall = wall_of_[static_cast<std::size_t>(a)];
      if (edge.wall >= 0 && (wall < 0 || edge.wall < wall)) wall = edge.wall;
    }
  for (int a = 0; a < mesh_.size(); ++a)
    if (const int wall = wall_of_[static_cast<std::size_t>(a)]; wall >= 0)
      moved_[static_cast<std::size_t>(wall)].nodes.push_back(a);
  Eigen::Index first = 0;
  for (std::size_t w = 0; w < moved_.size(); ++w) {
    auto& wall = moved_[w];
    wall.motion = motion_of(w, at_start(Eigen::all, wall.nodes));
    wall.first = first;
    first += wall.motion->coordinates();
    wall.numbers = wall.motion->first().size();
  }
}

std::unique_ptr<MovingWall> AleFlow::motion_of(std::size_t wall, const Nodes& at_start) const {
  const auto make =
      wall < spec_.motions.size() && spec_.motions[wall] ? spec_.motions[wall] : rigid_wall(spec_.walls[wall].pose);
  return make(at_start);
}

void AleFlow::first_placements() {
  for (std::size_t w = 0; w < moved_.size(); ++w) {
    const auto& spec = spec_.walls[w];
    state_.placements.push_back(moved_[w].motion->first());
    Eigen::VectorXd rates = Eigen::VectorXd::Zero(moved_[w].motion->coordinates());
    if (rates.size() == spec.velocity.size()) rates = spec.velocity;
    state_.rates.push_back(std::move(rates));
  }
  made_at_ = state_.placements;
}

std::vector<char> AleFlow::given_unknowns(const AleFlowSpec& spec, const FlowMesh& mesh,
                                          const FlowEquations& equations) {
  std::vector<char> given(static_cast<std::size_t>(equations.size()), 0);
  bool is_open = false;
  for (const auto& edge : mesh.boundary)
    for (const int a : edge.nodes)
      for (int axis = 0; axis < 2; ++axis) {
        auto& is_given = given[static_cast<std::size_t>(equations.velocity(a, axis))];
        if (edge.wall >= 0) is_given = 1;
        if (edge.side < 0) continue;
        const auto kind = spec.sides[static_cast<std::size_t>(edge.side)];
        const bool along_x = edge.side == left || edge.side == right;  // its normal
        if (kind == BoundaryKind::inflow || kind == BoundaryKind::no_slip) is_given = 1;
        if (kind == BoundaryKind::slip && along_x == (axis == 0)) is_given = 1;
        is_open = is_open || kind == BoundaryKind::outflow;
      }
  if (!is_open) given[static_cast<std::size_t>(equations.pressure(0))] = 1;  // its level is nobody's
  return given;
}

void AleFlow::start() {
  auto& s = state_;
  s.velocity.setZero(2, mesh_.size());
  if (spec_.start)
    for (int a = 0; a < mesh_.size(); ++a) s.velocity.col(a) = spec_.start(mesh_.nodes.col(a), 0);
  Unknowns at = Unknowns::Zero(equations_.size());
  at.head(2 * mesh_.size()) = s.velocity.reshaped();
  Eigen::VectorXd rates(0);
  for (const auto& of_wall : s.rates) {
    rates.conservativeResize(rates.size() + of_wall.size());
    rates.tail(of_wall.size()) = of_wall;
  }
  give(wall_velocities(s.placements, rates), at);
  s.velocity = at.head(2 * mesh_.size()).reshaped(2, mesh_.size());
  s.before = s.velocity;
  s.pressure.setZero(mesh_.corners);
  s.fastest = fastest_of(s.velocity);
}

Eigen::Index AleFlow::coordinates(std::size_t walls) const {
  return walls == 0 ? 0 : moved_[walls - 1].first + moved_[walls - 1].motion->coordinates();
}

Eigen::Index AleFlow::placement_numbers(std::size_t walls) const {
  Eigen::Index sum = 0;
  for (std::size_t w = 0; w < walls; ++w) sum += moved_[w].numbers;
  return sum;
}

std::size_t AleFlow::walls_with(Eigen::Index count) const {
  for (std::size_t walls = 0; walls <= moved_.size(); ++walls)
    if (coordinates(walls) == count) return walls;
  throw std::invalid_argument("ale fluid: " + std::to_string(count) + " numbers are not of the first of its " +
                              std::to_string(moved_.size()) + " walls");
}

Eigen::VectorXd AleFlow::all_rates(const Eigen::VectorXd& of_first) const {
  Eigen::VectorXd rates = Eigen::VectorXd::Zero(coordinates(moved_.size()));
  rates.head(of_first.size()) = of_first;
  return rates;
}

Nodes AleFlow::places_of(const std::vector<Eigen::VectorXd>& placements) const {
  const Stopwatch watch(mesh_seconds_);
  bool moves = false;
  Nodes d = Nodes::Zero(2, mesh_.size());
  for (std::size_t w = 0; w < moved_.size(); ++w) {
    const auto& wall = moved_[w];
    if (placements[w] == made_at_[w]) continue;
    const Nodes places = wall.motion->positions(placements[w]);
    for (std::size_t k = 0; k < wall.nodes.size(); ++k)
      d.col(wall.nodes[k]) = places.col(static_cast<Eigen::Index>(k)) - mesh_.nodes.col(wall.nodes[k]);
    moves = true;
  }
  if (!moves) return mesh_.nodes;
  extension_->extend(d);
  return mesh_.nodes + d;
}

Nodes AleFlow::wall_velocities(const std::vector<Eigen::VectorXd>& placements, const Eigen::VectorXd& rates) const {
  Nodes v = Nodes::Zero(2, mesh_.size());
  for (std::size_t w = 0; w < moved_.size(); ++w) {
    const auto& wall = moved_[w];
    const auto s = rates.segment(wall.first, wall.motion->coordinates());
    if (s.isZero(0)) continue;
    const Eigen::VectorXd of_nodes = wall.motion->basis(placements[w]) * s;
    for (std::size_t k = 0; k < wall.nodes.size(); ++k)
      v.col(wall.nodes[k]) = of_nodes.segment<2>(2 * static_cast<Eigen::Index>(k));
  }
  return v;
}

/// Velocities at sides at a time. Where sides meet, those at rest come before those that slip.
void AleFlow::give_sides(const AleFlowSpec& spec, const FlowMesh& mesh, const FlowEquations& equations, double time,
                         Unknowns& at) {
  for (const BoundaryKind kind : {BoundaryKind::slip, BoundaryKind::inflow, BoundaryKind::no_slip})
    for (const auto& edge : mesh.boundary) {
      if (edge.side < 0 || spec.sides[static_cast<std::size_t>(edge.side)] != kind) continue;
      const int normal = edge.side == left || edge.side == right ? 0 : 1;
      for (const int a : edge.nodes) {
        if (kind == BoundaryKind::inflow && spec.inflow)
          at.segment<2>(equations.velocity(a, 0)) = spec.inflow(mesh.nodes.col(a), time);
        else if (kind != BoundaryKind::slip)
          at.segment<2>(equations.velocity(a, 0)).setZero();
        else
          at[equations.velocity(a, normal)] = 0;
      }
    }
}

/// Velocities at sides and walls, of the end of the step under way; walls come before sides.
void AleFlow::give(const Nodes& walls, Unknowns& at) const {
  give_sides(spec_, mesh_, equations_, is_begun_ ? time_ + 0.5 * dt_ : time_, at);
  for (const auto& wall : moved_)
    for (const int a : wall.nodes) at.segment<2>(equations_.velocity(a, 0)) = walls.col(a);
}

Status AleFlow::begin(double kick, double dt) {
  kick_ = kick;
  dt_ = dt;
  is_begun_ = true;
  is_solved_ = false;
  step_answers_.factor = -1;
  answers_ = &kept_answers_;
  middle_ = state_.placements;
  for (std::size_t w = 0; w < moved_.size(); ++w)
    if (!state_.rates[w].isZero(0))
      middle_[w] = moved_[w].motion->moved(state_.placements[w], state_.rates[w], 0.5 * dt);
  fields_.x = x_;
  fields_.x_after = places_of(middle_);
  fields_.before = state_.velocity;
  const auto& scheme = spec_.scheme;
  fields_.rate = scheme.is_steady ? 0 : 1 / kick;
  fields_.theta = scheme.is_steady || state_.steps < scheme.damped_steps ? 1 : scheme.theta;
  fields_.force = {};
  if (spec_.force)
    fields_.force = [this](const Vec<2>& x) { return spec_.force(x, time_ + (fields_.theta - 0.5) * kick_); };
  first_ = &kept_;
  if (kept_.suits(fields_)) return {};
  first_ = &of_step_;
  Eigen::VectorXd rates(coordinates(moved_.size()));
  for (std::size_t w = 0; w < moved_.size(); ++w)
    rates.segment(moved_[w].first, state_.rates[w].size()) = state_.rates[w];
  move_walls(rates);
  if (factor(of_step_)) return {};
  return {"the equations of the fluid are singular; use smaller elements or a smaller time.dt_max"};
}

/// The end of the step has these velocities of walls, the mesh those that fluid and walls share in its middle; all else is a guess.
void AleFlow::move_walls(const Eigen::VectorXd& rates) {
  if (!is_solved_) at_ = guess();
  const Nodes walls = wall_velocities(middle_, rates);
  give(walls, at_);
  fields_.mesh_velocity.setZero(2, mesh_.size());
  for (const auto& wall : moved_)
    for (const int a : wall.nodes)
      fields_.mesh_velocity.col(a) = fields_.theta * walls.col(a) + (1 - fields_.theta) * state_.velocity.col(a);
  if (fields_.mesh_velocity.isZero(0)) return;
  const Stopwatch watch(mesh_seconds_);
  extension_->extend(fields_.mesh_velocity);
}

Status AleFlow::acceptable() const {
  auto placements = state_.placements;
  bool moves = false;
  for (std::size_t w = 0; w < moved_.size(); ++w) {
    const Eigen::VectorXd s = rates_.segment(moved_[w].first, moved_[w].motion->coordinates());
    if (s.isZero(0)) continue;
    placements[w] = moved_[w].motion->moved(placements[w], s, dt_);
    moves = true;
  }
  if (!moves || equations_.least_stretch(places_of(placements)) > least_allowed) return {};
  if (spec_.remesh && bearable_ < worn)
    return {
        "the mesh of the fluid folds, and there is no new one around the bodies; use smaller elements where they come "
        "near"};
  if (spec_.remesh) return {"the mesh of the fluid folds within a step; use a smaller time.dt_max"};
  if (spec_.extension == ExtensionLaw::laplace)
    return {"the mesh of the fluid folds where bodies have moved it; use fluid.ale.extension = \"biharmonic\""};
  return {
      "the mesh of the fluid folds where bodies have moved it; end the run earlier, or start it with bodies midway"};
}

void AleFlow::commit(const Eigen::VectorXd& placements) {
  Eigen::Index at = 0;
  for (std::size_t w = 0; w < moved_.size() && at < placements.size(); ++w) {
    state_.placements[w] = placements.segment(at, moved_[w].numbers);
    at += moved_[w].numbers;
  }
  book_work();
  for (std::size_t w = 0; w < moved_.size(); ++w)
    state_.rates[w] = rates_.segment(moved_[w].first, moved_[w].motion->coordinates());
  state_.before = state_.velocity;
  state_.velocity = at_.head(2 * mesh_.size()).reshaped(2, mesh_.size());
  state_.pressure = at_.tail(mesh_.corners);
  state_.fastest = std::max(state_.fastest, fastest_of(state_.velocity));
  state_.kick = kick_;
  state_.dt = dt_;
  ++state_.steps;
  time_ += dt_;
  if (tangent_ != &kept_) std::swap(kept_, *tangent_);
  if (answers_ != &kept_answers_) std::swap(kept_answers_, step_answers_);
  answers_ = &kept_answers_;
  tangent_ = first_ = &kept_;
  is_begun_ = is_solved_ = false;
  x_ = places_of(state_.placements);
  book_energy(fields_.x);
  if (is_mesh_worn()) remesh();
  look();
}

std::vector<std::pair<std::string, double>> AleFlow::phase_seconds() const {
  return {
      {"assembly", assembly_seconds_}, {"factor", factor_seconds_}, {"solve", solve_seconds_}, {"mesh", mesh_seconds_}};
}

}  // namespace splashdown::ale
