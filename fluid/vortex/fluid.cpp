#include "fluid/vortex/fluid.hpp"

#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <numbers>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "core/geometry.hpp"
#include "core/parallel.hpp"
#include "core/stopwatch.hpp"

namespace splashdown::vortex {
namespace {

constexpr double diffusion_limit = 0.2;  // nu dt/h^2: the splitting's error grows beyond
constexpr long starting_steps = 3;       // without a prediction worth having

double speed_of(const WallSpec<2>& wall, const Twist<2>& twist) {
  const auto& vertices = wall.surface.vertices;
  const double reach = vertices.cols() > 0 ? vertices.colwise().norm().maxCoeff() : 0;
  return twist.head<2>().norm() + std::abs(twist[2]) * reach;
}

}  // namespace

GridFlow::GridFlow(GridFlowSpec spec)
    : spec_(std::move(spec)),
      stream_function_(spec_.grid, spec_.sides, spec_.diffusion_order),
      advection_(spec_.grid, spec_.remeshing, spec_.paths) {
  check();
  const std::size_t nodes = spec_.grid.nodes();
  omega_ = spec_.vorticity.empty() ? NodeField(nodes, 0.0) : spec_.vorticity;
  for (const auto& wall : spec_.walls) {
    penalised_.emplace_back(spec_.grid, wall, spec_.penalisation.smoothing, stream(0));
    poses_.push_back(wall.pose);
    twists_.push_back(wall.velocity);
  }
  loads_.resize(spec_.walls.size());
  solve_velocity(omega_, 0, 0, velocity_);
  before_ = velocity_;
  speed_ = largest_speed();
  buoyant_at_start_ = buoyant_energy();
  trial_velocity_ = velocity_;
  ledger_.kinetic_energy = kinetic_energy();
  const Vec<2> size = spec_.grid.max() - spec_.grid.min;
  ledger_.volume = ledger_.volume_initial = size.prod();
  add_samples();
}

void GridFlow::check() const {
  const auto& g = spec_.grid;
  if (g.nx < 16 || g.ny < 16 || g.nx % FarField::coarsening != 0 || g.ny % FarField::coarsening != 0 || !(g.h > 0))
    throw std::invalid_argument("vortex fluid: a grid needs 16 squares or more each way, in fours, not " +
                                std::to_string(g.nx) + " x " + std::to_string(g.ny));
  if (!spec_.vorticity.empty() && spec_.vorticity.size() != g.nodes())
    throw std::invalid_argument("vortex fluid: vorticity needs one number a node");
}

void GridFlow::solve_velocity(NodeField& omega, double spread, double at_time, FaceField& velocity) {
  stream_function_.solve(omega, spread, psi_);
  velocities_of(spec_.grid, psi_, stream(at_time), velocity);
}

double GridFlow::largest_speed() const {
  const auto& g = spec_.grid;
  double squared = 0;
  const auto row = static_cast<std::size_t>(g.nx + 1);
  for (std::size_t j = 0; j < static_cast<std::size_t>(g.ny); ++j)
    for (std::size_t k = j * row; k < (j + 1) * row - 1; ++k)
      squared = std::max(squared, velocity_.u[k] * velocity_.u[k] + velocity_.v[k] * velocity_.v[k]);
  return std::sqrt(squared);
}

double GridFlow::stable_dt() const {
  double speed = std::max(speed_, stream(time_).norm());
  for (std::size_t w = 0; w < spec_.walls.size(); ++w) speed = std::max(speed, speed_of(spec_.walls[w], twists_[w]));
  const double h = spec_.grid.h, infinity = std::numeric_limits<double>::infinity();
  return std::min(speed > 0 ? spec_.cfl * h / speed : infinity,
                  spec_.viscosity > 0 ? diffusion_limit * h * h / spec_.viscosity : infinity);
}

/// A pass leaves 1 - M_f/(M_f + M_a) of an error in a rigid motion: slender bodies, beside whose filling much moves
/// with them, take more, and most before there is a prediction.
int GridFlow::passes_of(std::size_t wall, bool answers) const {
  constexpr int at_start = 8, few = 4, slender = 8;
  const auto& m = penalised_[wall].moments();
  if (m.is_inside_out()) return 1;
  const auto& p = spec_.penalisation;
  const double filling = m.area,
               moved = std::numbers::pi * m.length * m.length / 16;  // of a plate as long as half the outline
  const double share = filling / (filling + moved);
  const bool is_slender = share < 0.2;                                           // a plate of 1 : 4 or thinner
  if (steps_ <= 1 && is_slender) return static_cast<int>(std::ceil(5 / share));  // e^-5
  if (steps_ < starting_steps) return std::max(at_start, answers ? p.passes : p.prescribed_passes);
  if (!answers) return p.prescribed_passes;
  return p.passes > 0 ? p.passes : is_slender ? slender : few;
}

Status GridFlow::begin(double kick, double dt, std::span<const char> answers) {
  kick_ = kick;
  dt_ = dt;
  is_begun_ = false;
  pressure_.clear();
  const double ratio = kick_before_ > 0 ? kick / kick_before_ : 0;
  const double ahead = kick_before_ > 0 ? 0.5 * ratio : 0;
  if (kick * speed_ * (1 + ahead) > 2 * spec_.grid.h || dt * speed_ > spec_.grid.h)
    return {"the fluid crosses more than a square in a step; use a smaller time.dt_max or time.cfl"};
  {
    const Stopwatch watch(advection_seconds_);
    trial_omega_ = omega_;
    for (const auto& wall : penalised_) wall.predict_before(trial_omega_, ratio);
    advection_.move(trial_omega_, {velocity_, before_, ahead}, kick);
  }
  const double middle = time_ + 0.5 * dt;
  for (std::size_t w = 0; w < penalised_.size(); ++w) {
    const Stopwatch watch(bodies_seconds_);
    penalised_[w].cover_at(moved<2>(poses_[w], twists_[w], 0.5 * dt), trial_omega_, ratio);
    if (!penalised_[w].is_on_grid())
      return {"body \"" + spec_.walls[w].name +
              "\" leaves the grid; use a larger [fluid.grid], or an earlier time.end"};
  }
  for (std::size_t w = 0; w < penalised_.size(); ++w)
    for (std::size_t other = 0; other < w; ++other) penalised_[w].divide_with(penalised_[other]);
  {
    const Stopwatch watch(poisson_seconds_);
    solve_velocity(trial_omega_, spec_.viscosity * kick, middle, trial_velocity_);
  }
  const Stopwatch watch(bodies_seconds_);
  const auto& rate = spec_.penalisation.rate;
  const double share = rate ? *rate * kick / (1 + *rate * kick) : 1;
  laws_.resize(penalised_.size());
  for (std::size_t w = 0; w < penalised_.size(); ++w) {
    penalised_[w].make_rigid(trial_velocity_, share, passes_of(w, w < answers.size() && answers[w]), projections_);
    laws_[w] = penalised_[w].law(spec_.density, kick, ratio, spec_.gravity);
  }
  is_begun_ = true;
  return {};
}

void GridFlow::solve(std::span<const Twist<2>> twists) {
  trial_twists_.assign(twists.begin(), twists.end());
  trial_twists_.resize(penalised_.size(), Twist<2>::Zero());
  pressure_.clear();
  for (std::size_t w = 0; w < penalised_.size(); ++w) {
    loads_[w] = {};
    loads_[w].physical = (laws_[w].constant - laws_[w].answer * trial_twists_[w]) / kick_;
    loads_[w].wetted = penalised_[w].moments().length;
  }
}

/// Perturbations of the stream, outside of the bodies [J/m].
double GridFlow::kinetic_energy() const {
  const Vec<2> far = stream(time_);
  const auto& g = spec_.grid;
  const auto row = static_cast<std::size_t>(g.nx + 1);
  std::vector<double> rows(static_cast<std::size_t>(g.ny), 0.0);
  in_pieces(rows.size(), 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last; ++j)
      for (std::size_t k = j * row; k < (j + 1) * row - 1; ++k) {
        const double u = trial_velocity_.u[k] - far.x(), v = trial_velocity_.v[k] - far.y();
        rows[j] += u * u + v * v;
      }
  });
  double sum = 0;
  for (const double x : rows) sum += x;
  for (const auto& wall : penalised_) {
    const auto& [box, chi] = wall.chi();
    for (int j = 0; j < box.height && !chi.u.empty(); ++j)
      for (int i = 0; i < box.width; ++i) {
        const std::size_t k = box.at(i, j), at = g.at(box.i0 + i, box.j0 + j);
        const double u = trial_velocity_.u[at] - far.x(), v = trial_velocity_.v[at] - far.y();
        sum -= chi.u[k] * u * u + chi.v[k] * v * v;
      }
  }
  return 0.5 * spec_.density * g.h * g.h * sum;
}

/// What displaced fluid lacks of potential energy [J/m].
double GridFlow::buoyant_energy() const {
  double sum = 0;
  for (std::size_t w = 0; w < penalised_.size(); ++w) {
    const auto& m = penalised_[w].moments();
    if (!m.is_inside_out()) sum += spec_.density * m.area * spec_.gravity.dot(poses_[w] * m.centroid);
  }
  return sum;
}

void GridFlow::book(double kick) {
  const Vec<2> far = stream(time_);
  for (std::size_t w = 0; w < loads_.size(); ++w) {
    const Wrench<2> impulse = kick * loads_[w].total();
    ledger_.work_on_walls += impulse.dot(trial_twists_[w]);
    ledger_.work_of_effects += impulse.head<2>().dot(far);  // of the stream, in whose frame energies are
  }
  ledger_.kinetic_energy = kinetic_energy();
  ledger_.potential_energy = buoyant_energy() - buoyant_at_start_;
}

void GridFlow::commit(std::span<const Isometry<2>> poses) {
  {
    const Stopwatch watch(bodies_seconds_);
    for (std::size_t w = 0; w < penalised_.size(); ++w)
      penalised_[w].settle(trial_twists_[w], trial_omega_, steps_ > 0);
  }
  std::copy(poses.begin(), poses.end(), poses_.begin());
  twists_ = trial_twists_;
  omega_.swap(trial_omega_);
  if (steps_ < starting_steps) solve_velocity(omega_, 0, time_ + 0.5 * dt_, trial_velocity_);
  time_ += dt_;
  book(kick_);
  std::swap(before_, velocity_);
  std::swap(velocity_, trial_velocity_);
  kick_before_ = kick_;
  dt_before_ = dt_;
  ++steps_;
  speed_ = largest_speed();
  is_begun_ = false;
  pressure_.clear();
  place_samples();
}

std::vector<std::pair<std::string, double>> GridFlow::phase_seconds() const {
  return {{"advection", advection_seconds_}, {"poisson", poisson_seconds_}, {"penalisation", bodies_seconds_}};
}

namespace {

void put(std::ostream& out, std::span<const double> numbers) {
  out.write(reinterpret_cast<const char*>(numbers.data()), static_cast<std::streamsize>(numbers.size_bytes()));
}
void get(std::istream& in, std::span<double> numbers) {
  if (!in.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(numbers.size_bytes())))
    throw std::runtime_error("the fields of the grid end early");
  if (!std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); }))
    throw std::runtime_error("holds numbers that are not finite");
}

}  // namespace

void GridFlow::save(std::ostream& out) const {
  const double numbers[] = {time_,
                            kick_before_,
                            dt_before_,
                            static_cast<double>(steps_),
                            ledger_.work_on_walls,
                            ledger_.work_of_effects,
                            ledger_.kinetic_energy,
                            ledger_.potential_energy};
  put(out, numbers);
  for (std::size_t w = 0; w < poses_.size(); ++w) {
    put(out, {poses_[w].matrix().data(), 9});
    put(out, {twists_[w].data(), 3});
    penalised_[w].save(out);
  }
  for (const auto* field : {&omega_, &velocity_.u, &velocity_.v, &before_.u, &before_.v}) put(out, *field);
}

void GridFlow::load(std::istream& in) {
  double numbers[8];
  get(in, numbers);
  if (!(numbers[0] >= 0 && numbers[1] >= 0 && numbers[2] >= 0 && numbers[3] >= 0 && numbers[3] < 1e15))
    throw std::runtime_error("holds no time of the grid");
  time_ = numbers[0];
  kick_before_ = numbers[1];
  dt_before_ = numbers[2];
  steps_ = static_cast<long>(numbers[3]);
  ledger_.work_on_walls = numbers[4];
  ledger_.work_of_effects = numbers[5];
  ledger_.kinetic_energy = numbers[6];
  ledger_.potential_energy = numbers[7];
  for (std::size_t w = 0; w < poses_.size(); ++w) {
    get(in, {poses_[w].matrix().data(), 9});
    get(in, {twists_[w].data(), 3});
    penalised_[w].load(in);
  }
  for (auto* field : {&omega_, &velocity_.u, &velocity_.v, &before_.u, &before_.v}) get(in, *field);
  speed_ = largest_speed();
  is_begun_ = false;
  pressure_.clear();
  place_samples();
}

}  // namespace splashdown::vortex
