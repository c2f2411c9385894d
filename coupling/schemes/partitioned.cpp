#include <cmath>
#include <istream>
#include <limits>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "coupling/accelerators/pass_slope.hpp"
#include "coupling/interface_space.hpp"
#include "coupling/schemes/steppers.hpp"
#include "coupling/stopwatch.hpp"

namespace splashdown::coupling {
namespace {

// A residual this many times the first one has no way back.
constexpr double diverged = 1e6;

std::string no_agreement(const char* what, int passes, double residual, const std::string& term) {
  std::ostringstream text;
  text << "the coupling " << what << ": residual " << residual << " after " << passes
       << " passes with interface_term = \"" << term
       << "\"; use interface_term = \"rigid\", or accelerator = \"probe\"";
  return text.str();
}

}  // namespace

template <int d>
Partitioned<d>::Partitioned(std::unique_ptr<fluid::Fluid<d>> fluid, std::unique_ptr<rigid::Bodies<d>> bodies,
                            std::unique_ptr<InterfaceTerm<d>> term, std::unique_ptr<Accelerator> accelerator,
                            CouplingLimits limits)
    : Coupled<d>(std::move(fluid), std::move(bodies)),
      term_(std::move(term)),
      accelerator_(std::move(accelerator)),
      limits_(limits),
      acceleration_(this->bodies_->size(), fluid::Twist<d>::Zero()) {}

template <int d>
void Partitioned<d>::move_bodies(const std::vector<rigid::Wrench<d>>& loads) {
  const Stopwatch watch(this->rigid_seconds_);
  this->keep(bodies_->solve(loads));
}

template <int d>
std::vector<fluid::Twist<d>> Partitioned<d>::trial_velocities() const {
  std::vector<fluid::Twist<d>> s;
  for (const auto& t : trial_) s.push_back(t.velocity);
  return s;
}

template <int d>
StepReport Partitioned<d>::attempt(double dt) {
  this->begin_bodies(dt);
  const std::size_t count = bodies_->size();
  fluid::WallResponse<d> response;
  response.stand_ins.resize(fluid_->spec().walls.size());
  for (std::size_t b = 0; b < count; ++b) response.stand_ins[b] = term_->stand_in(*bodies_, b);
  if (const auto status = fluid_->begin(kick_, dt, response); !status.ok()) return {.cause = status.cause};

  const double fluid_before = this->fluid_seconds();
  StepReport report;
  {
    const Stopwatch watch(this->coupling_seconds_);
    report = iterate(dt);
  }
  this->coupling_seconds_ -= this->fluid_seconds() - fluid_before;
  if (report.ok()) report.cause = fluid_->verdict().cause;
  return report;
}

template <int d>
StepReport Partitioned<d>::iterate(double dt) {
  const std::size_t count = bodies_->size();
  accelerator_->begin_step();
  if (!fluid_->interface_pieces().empty()) accelerator_->forget();  // remeshed: other nodes
  move_bodies(std::vector<rigid::Wrench<d>>(count, rigid::Wrench<d>::Zero()));
  const InterfaceSpace<d> space(*bodies_, fluid_->interface_pieces(), fluid_->spec().density);
  Interface<d> x{trial_velocities(), {fluid_->interface_impulse().begin(), fluid_->interface_impulse().end()}};
  double scale = space.velocities(x.twists).norm();  // of free flight
  std::vector<fluid::Twist<d>> change;
  for (std::size_t b = 0; b < count; ++b) {
    change.push_back(bodies_->state(b).velocity - x.twists[b]);
    if (bodies_->spec(b).motion == rigid::Motion::free)
      x.twists[b] = bodies_->state(b).velocity + kick_ * acceleration_[b];
  }
  if (accelerator_->needs_slope()) accelerator_->set_slope(space.slope(pass_slope(*fluid_, *bodies_)));
  scale = std::max(scale, space.velocities(change).norm());
  // Where nothing moves there is nothing to agree on but the roundoff of the water's positions.
  double farthest = 0;
  for (const auto& node : fluid_->nodes().x) farthest = std::max(farthest, node.norm());
  const double roundoff = std::numeric_limits<double>::epsilon() * farthest / dt;
  const bool at_rest = scale <= roundoff;
  scale = std::max(scale, this->still(dt));
  StepReport report;
  double first = 0, calmest = std::numeric_limits<double>::infinity();
  for (report.passes = 1;; ++report.passes) {
    if (const auto status = fluid_->solve(this->of_walls(x.twists), x.impulses); !status.ok()) {
      // Velocities that grow from pass to pass end beyond what the fluid can follow.
      const bool grew = report.passes > 2 && report.residual > first;
      report.cause = grew ? no_agreement("diverged", report.passes, report.residual, term_->name()) : status.cause;
      return report;
    }
    move_bodies(this->total_loads());
    const auto walls_used = fluid_->wall_velocities().first(count);
    const auto found = fluid_->interface_impulse();
    const Eigen::VectorXd now = space.vector({{walls_used.begin(), walls_used.end()}, x.impulses});
    const Eigen::VectorXd image = space.vector({trial_velocities(), {found.begin(), found.end()}});
    // Relative to the calmest pass so far: a wild one would excuse errors of its own size.
    calmest = std::min(calmest, space.velocities(trial_velocities()).norm());
    const double error = (image - now).norm();
    report.residual = error / std::max(scale, calmest);
    if (!std::isfinite(report.residual)) {
      report.cause = no_agreement("diverged", report.passes, report.residual, term_->name());
      return report;
    }
    if (report.residual <= limits_.tolerance || (at_rest && error <= roundoff)) break;
    if (report.passes == limits_.fixed_passes) break;
    if (report.passes == 1) first = report.residual;
    if (report.residual > diverged * first) {
      report.cause = no_agreement("diverged", report.passes, report.residual, term_->name());
      return report;
    }
    if (report.passes == limits_.max_passes) {
      report.cause = no_agreement("did not converge", report.passes, report.residual, term_->name());
      return report;
    }
    space.add(accelerator_->next(now, image) - now, x);
  }
  return report;
}

template <int d>
void Partitioned<d>::commit() {
  for (std::size_t b = 0; b < trial_.size(); ++b)
    acceleration_[b] = (trial_[b].velocity - bodies_->state(b).velocity) / kick_;
  Coupled<d>::commit();
  accelerator_->commit_step();
}

template <int d>
void Partitioned<d>::save(std::ostream& out) const {
  for (const auto& a : acceleration_)
    out.write(reinterpret_cast<const char*>(a.data()), sizeof(double) * fluid::freedoms<d>);
  Coupled<d>::save(out);
  accelerator_->save(out);
}
template <int d>
void Partitioned<d>::load(std::istream& in) {
  for (auto& a : acceleration_) {
    in.read(reinterpret_cast<char*>(a.data()), sizeof(double) * fluid::freedoms<d>);
    if (!in || !a.allFinite()) throw std::runtime_error("holds no accelerations of the bodies");
  }
  Coupled<d>::load(in);
  accelerator_->load(in);
}

template class Partitioned<2>;
template class Partitioned<3>;

}  // namespace splashdown::coupling
