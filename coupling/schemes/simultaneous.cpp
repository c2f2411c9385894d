#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/stopwatch.hpp"
#include "coupling/schemes/steppers.hpp"

namespace splashdown::coupling {
namespace {

// Both sides agree to roundoff times the condition of the pressure equation.
constexpr double roundoff = 1e-6;

}  // namespace

/// What Newton's law is short of, relative to the velocities of the step.
double Simultaneous::relative(const Velocities& unloaded, const Velocities& loaded, double dt) const {
  double error = 0, scale = still(dt);
  const Eigen::VectorXd short_of = structure_->speeds(fluid_->solution().imbalance);
  const Eigen::VectorXd of[] = {structure_->speeds(unloaded), structure_->speeds(loaded),
                                structure_->speeds(structure_->velocities())};
  for (Eigen::Index w = 0; w < short_of.size(); ++w) {
    error = std::max(error, short_of[w]);
    scale = std::max({scale, of[0][w], of[1][w], of[2][w]});
  }
  return error / scale;
}

std::string Simultaneous::massless_and_dry() const {
  for (std::size_t w = 0; w < structure_->walls().size(); ++w) {
    const auto& wall = structure_->walls()[w];
    if (wall.answers && wall.mass == 0 && fluid_->solution().wetted[static_cast<Eigen::Index>(w)] == 0)
      return "body \"" + wall.name + "\" has no mass and is out of the water, which had inertia for it; give it a mass";
  }
  return {};
}

StepReport Simultaneous::pass_by_pass(Response response, double dt) {
  StepReport report;
  for (report.passes = 1;; ++report.passes) {
    const auto status = fluid_->solve({.velocities = response.free, .contacts = response.contacts});
    if (!status.ok()) {
      report.cause = status.cause;
      return report;
    }
    const Stopwatch moving(structure_seconds_);
    const Velocities& found = structure_->adopt(fluid_->solution().velocities);
    report.residual = relative(response.free, found, dt);
    report.pass_residuals.push_back(report.residual);
    if (!structure_->update_contacts(fluid_->solution().impulse)) return report;
    if (report.passes == max_passes_) {
      report.cause = "contacts between bodies keep opening and closing, or a body bends too far within the step";
      return report;
    }
    response = structure_->response();
  }
}

StepReport Simultaneous::couple(double dt) {
  const Step step = begin_structure(dt);
  Response response = structure_->response();
  if (const auto status = fluid_->begin(step, {.modal = response.modal}); !status.ok()) return {.cause = status.cause};

  const double fluid_before = fluid_seconds();
  StepReport report;
  {
    const Stopwatch watch(coupling_seconds_);
    report = pass_by_pass(std::move(response), dt);
  }
  coupling_seconds_ -= fluid_seconds() - fluid_before;
  if (report.ok() && !(report.residual <= roundoff)) {
    std::ostringstream text;
    text << "bodies and water disagree: residual " << report.residual << " with interface_term = \"rigid\"";
    report.cause = text.str();
  }
  if (report.ok()) report.cause = massless_and_dry();
  judge(report);
  return report;
}

}  // namespace splashdown::coupling
