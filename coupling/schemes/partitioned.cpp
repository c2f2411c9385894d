#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "core/stopwatch.hpp"
#include "coupling/accelerators/pass_slope.hpp"
#include "coupling/interface_space.hpp"
#include "coupling/schemes/steppers.hpp"

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

std::streamsize bytes(const Velocities& velocities) {
  return velocities.size() * static_cast<std::streamsize>(sizeof(double));
}

}  // namespace

Partitioned::Partitioned(std::unique_ptr<FluidPart> fluid, std::unique_ptr<StructurePart> structure,
                         std::unique_ptr<InterfaceTerm> term, std::unique_ptr<Accelerator> accelerator,
                         CouplingLimits limits)
    : Coupled(std::move(fluid), std::move(structure)),
      term_(std::move(term)),
      accelerator_(std::move(accelerator)),
      limits_(limits),
      acceleration_(Velocities::Zero(structure_->scales().size())) {}

const Velocities& Partitioned::move_structure(const Impulse& impulse) {
  const Stopwatch watch(structure_seconds_);
  return trial_ = structure_->solve(impulse);
}

StepReport Partitioned::couple(double dt) {
  const Step step = begin_structure(dt);
  kick_ = step.kick;
  InterfaceModel model;
  for (const auto& wall : structure_->walls()) model.interface_operators.push_back(term_->interface_operator(wall));
  if (const auto status = fluid_->begin(step, model); !status.ok()) return {.cause = status.cause};

  const double fluid_before = fluid_seconds();
  StepReport report;
  {
    const Stopwatch watch(coupling_seconds_);
    report = iterate(step);
  }
  coupling_seconds_ -= fluid_seconds() - fluid_before;
  judge(report);
  return report;
}

StepReport Partitioned::iterate(const Step& step) {
  accelerator_->begin_step();
  if (!fluid_->pieces().empty()) accelerator_->forget();  // remeshed: other nodes
  const Velocities before = structure_->velocities();
  Interface x{move_structure(Impulse::Zero(before.size())), fluid_->first_guess()};
  const InterfaceSpace space(*structure_, fluid_->pieces(), fluid_->density());
  double scale = space.scaled(x.velocities).norm();  // of free flight
  const Velocities change = before - x.velocities;
  for (const auto& wall : structure_->walls())
    if (wall.answers)
      x.velocities.segment(wall.first, wall.count) =
          before.segment(wall.first, wall.count) + step.kick * acceleration_.segment(wall.first, wall.count);
  if (accelerator_->needs_slope()) accelerator_->set_slope(space.slope(pass_slope(*fluid_, *structure_)));
  scale = std::max(scale, space.scaled(change).norm());
  // Where nothing moves there is nothing to agree on but the roundoff of the water's positions.
  const double roundoff = fluid_->roundoff() / step.dt;
  const bool at_rest = scale <= roundoff;
  scale = std::max(scale, still(step.dt));
  StepReport report;
  double first = 0, calmest = std::numeric_limits<double>::infinity();
  for (report.passes = 1;; ++report.passes) {
    if (const auto status = fluid_->solve({.velocities = x.velocities, .lagged = x.lagged}); !status.ok()) {
      // Velocities that grow from pass to pass end beyond what the fluid can follow.
      const bool grew = report.passes > 2 && report.residual > first;
      report.cause = grew ? no_agreement("diverged", report.passes, report.residual, term_->name()) : status.cause;
      return report;
    }
    const Solution& found = fluid_->solution();
    const Velocities& answer = move_structure(found.impulse);
    const Eigen::VectorXd now = space.vector({found.velocities, x.lagged});
    const Eigen::VectorXd image = space.vector({answer, found.lagged});
    // Relative to the calmest pass so far: a wild one would excuse errors of its own size.
    calmest = std::min(calmest, space.scaled(answer).norm());
    const double error = (image - now).norm();
    report.residual = error / std::max(scale, calmest);
    report.pass_residuals.push_back(report.residual);
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

void Partitioned::remember() {
  acceleration_ = (trial_ - structure_->velocities()) / kick_;
  accelerator_->commit_step();
}

void Partitioned::save(std::ostream& out) const {
  out.write(reinterpret_cast<const char*>(acceleration_.data()), bytes(acceleration_));
  Coupled::save(out);
  accelerator_->save(out);
}
void Partitioned::load(std::istream& in) {
  in.read(reinterpret_cast<char*>(acceleration_.data()), bytes(acceleration_));
  if (!in || !acceleration_.allFinite()) throw std::runtime_error("holds no accelerations of the bodies");
  Coupled::load(in);
  accelerator_->load(in);
}

}  // namespace splashdown::coupling
