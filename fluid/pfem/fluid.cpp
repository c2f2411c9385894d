#include "fluid/pfem/fluid.hpp"

#include <stdexcept>

#include "fluid/pfem/fluid_state.hpp"

namespace splashdown::fluid {

template <int d>
Fluid<d>::Fluid(FluidSpec<d> spec, std::vector<std::unique_ptr<Effect<d>>> effects, const Formulation<d>& formulation)
    : s_(std::make_unique<State>(std::move(spec), std::move(effects))) {
  s_->step = formulation(s_->water);
}

template <int d>
Fluid<d>::~Fluid() = default;

template <int d>
double Fluid<d>::time() const {
  return s_->water.now.time;
}

template <int d>
double Fluid<d>::stable_dt() const {
  return is_waiting() ? s_->water.spec.step.dt_max : s_->water.stable_dt();
}

template <int d>
Status Fluid<d>::begin(double kick, double dt, const InterfaceModel& structure) {
  s_->solved = false;
  return s_->step->begin(kick, dt, structure);
}

template <int d>
const StepResult<d>& Fluid<d>::solve(std::span<const WallVelocity<d>> walls, std::span<const double> previous,
                                     const ClosedContacts& contacts) {
  s_->result = s_->step->solve(walls, previous, contacts);
  s_->solved = s_->result.status.ok();
  return s_->result;
}

template <int d>
const StepResult<d>& Fluid<d>::solve(std::span<const Twist<d>> walls, std::span<const double> previous,
                                     const ClosedContacts& contacts) {
  return solve(std::vector<WallVelocity<d>>(walls.begin(), walls.end()), previous, contacts);
}

template <int d>
const StepResult<d>& Fluid<d>::result() const {
  return s_->result;
}

template <int d>
Status Fluid<d>::acceptable() const {
  return s_->step->refusal(s_->result).status;
}

template <int d>
bool Fluid<d>::release_fragment() {
  if (!s_->solved) return false;
  const int node = s_->step->refusal(s_->result).node;
  if (node < 0) return false;
  s_->water.let_fragment_fly(node);
  s_->solved = false;
  return true;
}

template <int d>
void Fluid<d>::commit(std::span<const WallPlace<d>> places) {
  const auto scope = s_->water.timer.scope(motion);
  s_->water.accept(s_->step->taken(s_->result), places);
  s_->solved = false;
}

template <int d>
void Fluid<d>::commit(std::span<const Isometry<d>> poses) {
  commit(std::vector<WallPlace<d>>(poses.begin(), poses.end()));
}

template <int d>
void Fluid<d>::save(std::ostream& out) const {
  s_->water.save(out);
}
template <int d>
void Fluid<d>::load(std::istream& in) {
  Water<d>& water = s_->water;
  water.load(in);
  s_->solved = false;
  s_->result = {};
  s_->result.loads.resize(water.now.resting_loads.size());
  for (std::size_t w = 0; w < s_->result.loads.size(); ++w)
    s_->result.loads[w] = {.physical = water.now.resting_loads[w], .wetted = water.now.wetted[w]};
}

template <int d>
Eigen::MatrixXd Fluid<d>::added_mass(std::span<const std::size_t> walls) const {
  if (!s_->water.prepared) throw std::logic_error("fluid: the added mass is known from begin to commit");
  return s_->step->equation().added_mass_of(walls);
}
template <int d>
Eigen::MatrixXd Fluid<d>::interface_slope(std::span<const std::size_t> walls) const {
  if (!s_->water.prepared) throw std::logic_error("fluid: the slope is known from begin to commit");
  return s_->step->equation().interface_slope(walls);
}
template <int d>
std::vector<double> Fluid<d>::carried_interface_impulse() const {
  return s_->step->equation().laplacian().means(s_->step->carried_impulse());
}
template <int d>
std::span<const InterfacePiece> Fluid<d>::interface_pieces() const {
  return s_->step->equation().laplacian().pieces();
}
template <int d>
const FluidSpec<d>& Fluid<d>::spec() const {
  return s_->water.spec;
}
template <int d>
const Nodes<d>& Fluid<d>::nodes() const {
  return s_->water.prepared ? s_->water.work.nodes : s_->water.now.nodes;
}
template <int d>
const Mesh<d>& Fluid<d>::mesh() const {
  return s_->water.prepared ? s_->water.work.mesh : s_->water.now.mesh;
}
template <int d>
const Ledger& Fluid<d>::ledger() const {
  return s_->solved ? s_->result.ledger : s_->water.prepared ? s_->water.work.ledger : s_->water.now.ledger;
}
template <int d>
std::span<const double> Fluid<d>::pressure() const {
  return s_->solved ? s_->result.pressure : nodes().p;
}
template <int d>
std::span<const double> Fluid<d>::repair_pressure() const {
  return s_->solved ? std::span<const double>(s_->result.repair_pressure) : std::span<const double>();
}
template <int d>
std::span<const WallPlace<d>> Fluid<d>::wall_places() const {
  return s_->water.prepared ? s_->water.work.poses : s_->water.now.poses;
}
template <int d>
std::span<const Isometry<d>> Fluid<d>::wall_poses() const {
  s_->poses.clear();
  for (const auto& place : wall_places()) s_->poses.push_back(place.pose());
  return s_->poses;
}
template <int d>
const AtVertices<d>* Fluid<d>::wall_vertices(std::size_t wall) const {
  const WallShape<d>* shape = wall_places()[wall].shape();
  return shape ? &shape->vertices : nullptr;
}
template <int d>
const WallLayout<d>& Fluid<d>::layout() const {
  return s_->water.layout;
}

template <int d>
std::vector<WallPlace<d>> Fluid<d>::places_of(const Eigen::VectorXd& placement) const {
  constexpr Eigen::Index of_pose = d * (d + 1);
  std::vector<WallPlace<d>> places(wall_places().begin(), wall_places().end());
  Eigen::Index first = 0;
  for (std::size_t w = 0; w < places.size() && first < placement.size(); ++w) {
    const bool deforms = layout().deforms(w);
    const Eigen::Index count = deforms ? layout().count(w) : of_pose;
    if (first + count > placement.size()) break;
    const Eigen::VectorXd own = placement.segment(first, count);
    if (deforms) {
      places[w] = s_->water.walls[w].shaped(own.reshaped(d, count / d));
    } else {
      Isometry<d> pose = places[w].pose();
      pose.matrix().template topRows<d>() = own.reshaped(d, d + 1);
      places[w] = pose;
    }
    first += count;
  }
  if (first != placement.size())
    throw std::invalid_argument("fluid: " + std::to_string(placement.size()) + " numbers place none of its " +
                                std::to_string(places.size()) + " walls to the end");
  return places;
}
template <int d>
Vec<d> Fluid<d>::velocity_n(std::size_t node) const {
  const Vec<d>& before = nodes().v[node];
  return s_->solved ? s_->step->at_t_n(before, s_->result.velocity[node]) : before;
}

template <int d>
std::optional<double> Fluid<d>::pressure_at(const Vec<d>& point) const {
  constexpr double outside = 1e-9;  // barycentric coordinate below which a point is outside: roundoff
  for (const auto& cell : mesh().cells) {
    const auto at = corners(nodes().x, cell);
    const auto g = volume_gradients<d>(at);
    const double e = (at(d) - at(0)).dot(g.col(d));
    double p = 0;
    bool inside = true;
    for (int k = 0; k <= d && inside; ++k) {
      const double share = (point - at(k)).dot(g.col(k)) / e + 1.0;
      inside = share >= -outside;
      p += share * pressure()[cell[k]];
    }
    if (inside) return p;
  }
  return std::nullopt;
}

template <int d>
const std::vector<std::unique_ptr<Effect<d>>>& Fluid<d>::effects() const {
  return s_->water.effects;
}
template <int d>
std::vector<std::pair<std::string, double>> Fluid<d>::phase_seconds() const {
  return s_->water.timer.seconds();
}

template class Fluid<2>;
template class Fluid<3>;

}  // namespace splashdown::fluid
