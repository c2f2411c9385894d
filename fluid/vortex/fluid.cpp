#include "fluid/vortex/fluid.hpp"

#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "core/geometry.hpp"
#include "core/parallel.hpp"
#include "core/stopwatch.hpp"

namespace splashdown::vortex {
namespace {

constexpr double diffusion_limit = 0.2;  // nu dt/h^2: the splitting's error grows beyond
constexpr std::size_t pieces_of_copies = 1 << 16;
constexpr double faintest = 1e-20;  // vorticity that is none, over that of the fastest fluid across a square

double speed_of(const WallSpec<2>& wall, const Twist<2>& twist) {
  const auto& vertices = wall.surface.vertices;
  const double reach = vertices.cols() > 0 ? vertices.colwise().norm().maxCoeff() : 0;
  return twist.head<2>().norm() + std::abs(twist[2]) * reach;
}

}  // namespace

GridFlow::GridFlow(GridFlowSpec spec)
    : spec_(std::move(spec)),
      stream_function_(spec_.grid, spec_.sides),
      advection_(spec_.grid, spec_.remeshing, spec_.paths),
      diffusion_(spec_.grid, spec_.diffusion_order),
      wake_(spec_.grid) {
  check();
  const std::size_t nodes = spec_.grid.nodes();
  omega_ = spec_.vorticity.empty() ? NodeField(nodes, 0.0) : spec_.vorticity;
  for (const auto& wall : spec_.walls) {
    penalised_.emplace_back(spec_.grid, wall, spec_.penalisation.smoothing, stream(0));
    poses_.push_back(wall.pose);
    twists_.push_back(wall.velocity);
  }
  loads_.resize(spec_.walls.size());
  trial_speeds_ = solve_velocity(omega_, 0, velocity_);
  before_ = velocity_;
  speed_ = trial_speeds_.speed;
  buoyant_at_start_ = buoyant_energy();
  trial_velocity_ = velocity_;
  ledger_.kinetic_energy = kinetic_energy(0);
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

Speeds GridFlow::solve_velocity(const NodeField& omega, double at_time, FaceField& velocity) {
  psi_.resize(omega.size());
  in_pieces(omega.size(), pieces_of_copies, [&](std::size_t first, std::size_t last) {
    std::copy(omega.begin() + static_cast<std::ptrdiff_t>(first), omega.begin() + static_cast<std::ptrdiff_t>(last),
              psi_.begin() + static_cast<std::ptrdiff_t>(first));
  });
  wake_.end(psi_, fading(stream(at_time)));
  stream_function_.solve(psi_, wake_.beyond());
  return velocities_of(spec_.grid, psi_, stream(at_time), velocity);
}

double GridFlow::stable_dt() const {
  double speed = std::max(speed_, stream(time_).norm());
  for (std::size_t w = 0; w < spec_.walls.size(); ++w) speed = std::max(speed, speed_of(spec_.walls[w], twists_[w]));
  const double h = spec_.grid.h, infinity = std::numeric_limits<double>::infinity();
  return std::min(speed > 0 ? spec_.cfl * h / speed : infinity,
                  spec_.viscosity > 0 ? diffusion_limit * h * h / spec_.viscosity : infinity);
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
    std::vector<NodeField> without;
    for (const auto& wall : penalised_) without.push_back(wall.predict_before(omega_, ratio));
    advection_.move(omega_, {velocity_, before_, ahead}, kick, trial_omega_);
    for (std::size_t w = penalised_.size(); w-- > 0;) penalised_[w].forget_prediction(without[w], omega_);
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
    const Stopwatch watch(diffusion_seconds_);
    diffusion_.apply(trial_omega_, spec_.viscosity * kick, faintest * speed_ / spec_.grid.h);
  }
  {
    const Stopwatch watch(poisson_seconds_);
    trial_speeds_ = solve_velocity(trial_omega_, middle, trial_velocity_);
  }
  const Stopwatch watch(bodies_seconds_);
  ratio_ = ratio;
  const auto& rate = spec_.penalisation.rate;
  find_answers(rate ? *rate * kick / (1 + *rate * kick) : 1, answers);
  laws_.clear();
  for (const auto& wall : penalised_) laws_.push_back(wall.law(spec_.density, kick, ratio, spec_.gravity));
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
    for (std::size_t mover = 0; mover < penalised_.size(); ++mover)
      loads_[w].physical -= penalised_[w].answer_to(mover, spec_.density) * trial_twists_[mover] / kick_;
  }
}

/// Perturbations of the stream at the time of the trial's velocities, outside of the bodies [J/m].
double GridFlow::kinetic_energy(double at_time) const {
  const Vec<2> far = stream(at_time);
  const auto& g = spec_.grid;
  double sum = trial_speeds_.squares;
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
  ledger_.kinetic_energy = kinetic_energy(time_ - 0.5 * dt_);
  ledger_.potential_energy = buoyant_energy() - buoyant_at_start_;
}

void GridFlow::commit(std::span<const Isometry<2>> poses) {
  {
    const Stopwatch watch(bodies_seconds_);
    for (std::size_t w = 0; w < penalised_.size(); ++w)
      for (std::size_t mover = 0; mover < penalised_.size(); ++mover)
        penalised_[w].settle_answer_to(mover, trial_twists_[mover]);
    for (std::size_t w = 0; w < penalised_.size(); ++w)
      penalised_[w].settle(trial_twists_[w], trial_omega_, steps_ > 0);
  }
  std::copy(poses.begin(), poses.end(), poses_.begin());
  twists_ = trial_twists_;
  omega_.swap(trial_omega_);
  if (is_starting()) trial_speeds_ = solve_velocity(omega_, time_ + 0.5 * dt_, trial_velocity_);
  time_ += dt_;
  book(kick_);
  std::swap(before_, velocity_);
  std::swap(velocity_, trial_velocity_);
  kick_before_ = kick_;
  dt_before_ = dt_;
  ++steps_;
  speed_ = trial_speeds_.speed;
  is_begun_ = false;
  pressure_.clear();
  place_samples();
}

std::vector<std::pair<std::string, double>> GridFlow::phase_seconds() const {
  return {{"advection", advection_seconds_},
          {"diffusion", diffusion_seconds_},
          {"poisson", poisson_seconds_},
          {"penalisation", bodies_seconds_}};
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
  speed_ = speeds_of(spec_.grid, velocity_, stream(time_)).speed;
  is_begun_ = false;
  pressure_.clear();
  place_samples();
}

}  // namespace splashdown::vortex
