#include <cmath>
#include <sstream>

#include "coupling/schemes/steppers.hpp"
#include "coupling/stopwatch.hpp"

namespace splashdown::coupling {
namespace {

// Both sides agree to roundoff times the condition of the pressure equation.
constexpr double roundoff = 1e-6;

}  // namespace

/// What Newton's law is short of, relative to the velocities of the step.
template <int d>
double Simultaneous<d>::relative(std::span<const fluid::Twist<d>> unloaded, double dt) const {
  double error = 0, scale = this->still(dt);
  for (std::size_t b = 0; b < bodies_->size(); ++b) {
    // Of the points of a body: its velocity, and its turning at the farthest of them.
    const auto speed = [reach = rigid::reach(bodies_->spec(b))](const fluid::Twist<d>& twist) {
      return twist.template head<d>().norm() + reach * twist.template tail<fluid::rotations<d>>().norm();
    };
    error = std::max(error, speed(fluid_->imbalance()[b]));
    scale = std::max({scale, speed(unloaded[b]), speed(trial_[b].velocity), speed(bodies_->state(b).velocity)});
  }
  return error / scale;
}

template <int d>
StepReport Simultaneous<d>::attempt(double dt) {
  this->begin_bodies(dt);
  const std::size_t count = bodies_->size();
  rigid::Mobility<d> bodies = bodies_->mobility();
  fluid::WallResponse<d> response;
  response.modes.setZero(static_cast<Eigen::Index>(fluid_->spec().walls.size()) * fluid::freedoms<d>,
                         bodies.modes.cols());
  response.modes.topRows(bodies.modes.rows()) = bodies.modes;
  response.inertia = bodies.inertia;
  if (const auto status = fluid_->begin(kick_, dt, response); !status.ok()) return {.cause = status.cause};

  const double fluid_before = this->fluid_seconds();
  StepReport report;
  {
    const Stopwatch watch(this->coupling_seconds_);
    for (report.passes = 1;; ++report.passes) {
      const auto status = fluid_->solve(this->of_walls(bodies.velocities), {}, {bodies.directions, bodies.impulse});
      if (!status.ok()) {
        report.cause = status.cause;
        break;
      }
      const Stopwatch moving(this->rigid_seconds_);
      this->keep(bodies_->follow(fluid_->wall_velocities().first(count)));
      report.residual = relative(bodies.velocities, dt);
      if (!bodies_->settle(this->total_loads())) break;
      if (report.passes == max_passes_) {
        report.cause = "contacts between bodies keep opening and closing";
        break;
      }
      bodies = bodies_->mobility();
    }
  }
  this->coupling_seconds_ -= this->fluid_seconds() - fluid_before;
  if (report.ok() && !(report.residual <= roundoff)) {
    std::ostringstream text;
    text << "bodies and water disagree: residual " << report.residual << " with interface_term = \"rigid\"";
    report.cause = text.str();
  }
  for (std::size_t b = 0; b < count && report.ok(); ++b) {
    const auto& spec = bodies_->spec(b);
    if (spec.motion == rigid::Motion::free && spec.mass == 0 && fluid_->loads()[b].wetted == 0)
      report.cause =
          "body \"" + spec.name + "\" has no mass and is out of the water, which had inertia for it; give it a mass";
  }
  if (report.ok()) report.cause = fluid_->verdict().cause;
  return report;
}

template class Simultaneous<2>;
template class Simultaneous<3>;

}  // namespace splashdown::coupling
