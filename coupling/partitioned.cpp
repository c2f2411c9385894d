#include <chrono>
#include <cmath>
#include <istream>
#include <limits>
#include <ostream>
#include <sstream>

#include "coupling/interface_space.hpp"
#include "coupling/pass_slope.hpp"
#include "coupling/steppers.hpp"

namespace splashdown::coupling {
namespace {

// A residual this many times the first one has no way back.
constexpr double diverged = 1e6;
// Velocities below this many body lengths a step are roundoff of positions: a body at rest.
constexpr double still = 1e-9;
// Both sides of the exact term agree to roundoff times the condition of the pressure equation.
constexpr double roundoff = 1e-6;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string no_agreement(const char* what, int passes, double residual, const std::string& term) {
  std::ostringstream text;
  text << "the coupling " << what << ": residual " << residual << " after " << passes << " passes with interface_term = \""
       << term << "\"";
  if (term != "rigid") text << "; use interface_term = \"rigid\", or accelerator = \"probe\"";
  return text.str();
}

}  // namespace

template <int d>
Partitioned<d>::Partitioned(std::unique_ptr<fluid::Fluid<d>> fluid, std::unique_ptr<rigid::Bodies<d>> bodies,
                            std::unique_ptr<InterfaceTerm<d>> term, std::unique_ptr<Accelerator> accelerator,
                            CouplingLimits limits)
    : fluid_(std::move(fluid)),
      bodies_(std::move(bodies)),
      term_(std::move(term)),
      accelerator_(std::move(accelerator)),
      limits_(limits),
      acceleration_(bodies_->size(), fluid::Twist<d>::Zero()) {}

template <int d>
void Partitioned<d>::move_bodies(const std::vector<rigid::Wrench<d>>& loads) {
  const auto start = std::chrono::steady_clock::now();
  const auto trial = bodies_->solve(loads);
  trial_.assign(trial.begin(), trial.end());
  rigid_seconds_ += seconds_since(start);
}

template <int d>
std::vector<fluid::Twist<d>> Partitioned<d>::trial_velocities() const {
  std::vector<fluid::Twist<d>> s;
  for (const auto& t : trial_) s.push_back(t.velocity);
  return s;
}

template <int d>
StepReport Partitioned<d>::attempt(double dt) {
  clock_.start(dt);
  kick_ = clock_.kick(dt);
  const std::size_t count = bodies_->size(), walls = fluid_->spec().walls.size();
  bodies_->begin(kick_, dt);
  std::vector<fluid::WallResponse<d>> responses(walls);
  bool inside = false, outside = false;  // bodies solved inside the pressure equation, and outside it
  for (std::size_t b = 0; b < count; ++b) {
    if (bodies_->spec(b).motion != rigid::Motion::free) continue;
    responses[b] = term_->response(*bodies_, b);
    (responses[b].rigid.isZero(0) ? outside : inside) = true;
  }
  if (const auto status = fluid_->begin(kick_, dt, responses); !status.ok()) return {.cause = status.cause};

  const auto start = std::chrono::steady_clock::now();
  accelerator_->begin_step();
  if (!fluid_->interface_pieces().empty()) accelerator_->forget();  // remeshed: other nodes
  std::vector<rigid::Wrench<d>> loads(count, rigid::Wrench<d>::Zero());
  move_bodies(loads);
  const InterfaceSpace<d> space(*bodies_, fluid_->interface_pieces(), fluid_->spec().density);
  Interface<d> x{trial_velocities(), {fluid_->interface_impulse().begin(), fluid_->interface_impulse().end()}};
  double scale = space.velocities(x.twists).norm();  // of free flight
  std::vector<fluid::Twist<d>> change;
  for (std::size_t b = 0; b < count; ++b) {
    change.push_back(bodies_->state(b).velocity - x.twists[b]);
    const bool guess = bodies_->spec(b).motion == rigid::Motion::free && responses[b].rigid.isZero(0);
    if (guess) x.twists[b] = bodies_->state(b).velocity + kick_ * acceleration_[b];
  }
  scale = std::max(scale, space.velocities(change).norm());
  double length = 0;  // largest body
  for (std::size_t b = 0; b < count; ++b) {
    const auto& vertices = bodies_->spec(b).surface.vertices;
    length = std::max(length, (vertices.rowwise().maxCoeff() - vertices.rowwise().minCoeff()).norm());
  }
  if (outside && accelerator_->needs_slope())
    accelerator_->set_slope(space.slope(pass_slope(*fluid_, *bodies_, kick_)));
  StepReport report;
  double first = 0, calmest = std::numeric_limits<double>::infinity();
  const double fluid_seconds = [&] {
    double sum = 0;
    for (const auto& p : fluid_->phase_seconds()) sum += p.second;
    return sum;
  }();
  for (report.passes = 1;; ++report.passes) {
    std::vector<fluid::Twist<d>> all(walls, fluid::Twist<d>::Zero());
    std::copy(x.twists.begin(), x.twists.end(), all.begin());
    if (const auto status = fluid_->solve(all, x.impulses); !status.ok()) {
      report.cause = status.cause;
      return report;
    }
    for (std::size_t b = 0; b < count; ++b) loads[b] = fluid_->loads()[b].total();
    move_bodies(loads);
    const auto walls_used = fluid_->wall_velocities().first(count);
    const auto found = fluid_->interface_impulse();
    const Eigen::VectorXd now = space.vector({{walls_used.begin(), walls_used.end()}, x.impulses});
    const Eigen::VectorXd image = space.vector({trial_velocities(), {found.begin(), found.end()}});
    // Relative to the calmest pass so far: a wild one would excuse errors of its own size.
    calmest = std::min(calmest, space.velocities(trial_velocities()).norm());
    report.residual = (image - now).norm() / std::max({scale, calmest, still * length / dt});
    if (!std::isfinite(report.residual)) {
      report.cause = no_agreement("diverged", report.passes, report.residual, term_->name());
      return report;
    }
    if (report.residual <= limits_.tolerance || report.passes == limits_.fixed_passes) break;
    if (report.passes == 1) first = report.residual;
    if (report.residual > diverged * first) {
      report.cause = no_agreement("diverged", report.passes, report.residual, term_->name());
      return report;
    }
    if (report.passes == limits_.max_passes) {
      report.cause = no_agreement("did not converge", report.passes, report.residual, term_->name());
      return report;
    }
    if (outside) space.add(accelerator_->next(now, image) - now, x);
    if (inside && !outside) {  // solved exactly: another pass would repeat this one
      if (report.residual > roundoff)
        report.cause = no_agreement("did not converge", report.passes, report.residual, term_->name());
      break;
    }
  }
  if (report.ok()) report.cause = fluid_->verdict().cause;
  double fluid_after = 0;
  for (const auto& p : fluid_->phase_seconds()) fluid_after += p.second;
  coupling_seconds_ += seconds_since(start) - (fluid_after - fluid_seconds);
  return report;
}

template <int d>
void Partitioned<d>::commit() {
  std::vector<fluid::Isometry<d>> poses(fluid_->wall_poses().begin(), fluid_->wall_poses().end());
  for (std::size_t b = 0; b < trial_.size(); ++b) {
    acceleration_[b] = (trial_[b].velocity - bodies_->state(b).velocity) / kick_;
    poses[b] = trial_[b].pose;
  }
  fluid_->commit(poses);
  bodies_->commit();
  clock_.commit();
  accelerator_->commit_step();
}

template <int d>
std::vector<std::pair<std::string, double>> Partitioned<d>::phase_seconds() const {
  auto phases = fluid_->phase_seconds();
  phases.emplace_back("rigid", rigid_seconds_);
  phases.emplace_back("coupling", std::max(0.0, coupling_seconds_ - rigid_seconds_));
  return phases;
}

template <int d>
void Partitioned<d>::save(std::ostream& out) const {
  clock_.save(out);
  for (const auto& a : acceleration_) out.write(reinterpret_cast<const char*>(a.data()), sizeof(double) * fluid::freedoms<d>);
  fluid_->save(out);
  bodies_->save(out);
  accelerator_->save(out);
}
template <int d>
void Partitioned<d>::load(std::istream& in) {
  clock_.load(in);
  for (auto& a : acceleration_) in.read(reinterpret_cast<char*>(a.data()), sizeof(double) * fluid::freedoms<d>);
  fluid_->load(in);
  bodies_->load(in);
  accelerator_->load(in);
}

template class Partitioned<2>;
template class Partitioned<3>;

}  // namespace splashdown::coupling
