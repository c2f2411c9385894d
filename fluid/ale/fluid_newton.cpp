// Newton's method of a step, with walls whose velocities are given or are found with the flow.
#include <algorithm>
#include <cmath>

#include "core/mixing.hpp"
#include "core/stopwatch.hpp"
#include "fluid/ale/fluid.hpp"

namespace splashdown::ale {
namespace {

/// Of the first nodes' velocities.
double fastest_among(const Eigen::VectorXd& numbers, Eigen::Index nodes) {
  return numbers.head(2 * nodes).reshaped(2, nodes).colwise().norm().maxCoeff();
}

}  // namespace

/// Velocities go on as they changed last.
Unknowns AleFlow::guess() const {
  const double ratio = state_.kick > 0 && !spec_.scheme.is_steady ? kick_ / state_.kick : 0;
  Unknowns at(equations_.size());
  at.head(2 * mesh_.size()) = (state_.velocity + ratio * (state_.velocity - state_.before)).reshaped();
  at.tail(mesh_.corners) = state_.pressure;
  return at;
}

Status AleFlow::solve(const Eigen::VectorXd& velocities, bool goes_on) {
  rates_ = all_rates(velocities);
  is_solved_ = is_solved_ && goes_on;
  if (!is_solved_) tangent_ = first_;
  move_walls(rates_);
  pressure_.clear();
  const auto status = newton(nullptr);
  is_solved_ = status.ok();
  if (is_solved_) find_loads();
  return status;
}

Status AleFlow::solve(const Eigen::VectorXd& velocities, const Eigen::MatrixXd& modes, const NextAmplitudes& next,
                      bool goes_on) {
  is_solved_ = is_solved_ && goes_on && amplitudes_.size() == modes.cols();
  if (!is_solved_) {
    tangent_ = first_;
    amplitudes_ = Eigen::VectorXd::Zero(modes.cols());
  }
  rates_ = all_rates(velocities + modes * amplitudes_);
  move_walls(rates_);
  pressure_.clear();
  const WithModes bodies{velocities, modes, next};
  const auto status = newton(&bodies);
  is_solved_ = status.ok();
  if (is_solved_) find_loads();
  return status;
}

bool AleFlow::factor(FactoredSlope& tangent) {
  ++factorisations_;
  tangent_ = &tangent;
  tangent.number(factorisations_);
  return tangent.make(equations_, given_, fields_, at_, assembly_seconds_, factor_seconds_);
}

/// Those of the factor in use; that bodies have moved on since then costs an iteration, which is less than they do.
const AleFlow::Answers& AleFlow::answers_to(const Eigen::MatrixXd& modes) {
  constexpr double near = 0.3;  // of the motions
  const auto suit = [&](const Answers& known) {
    return known.factor == tangent_->number() && known.motions.rows() == modes.rows() &&
           known.motions.cols() == modes.cols() && (known.motions - modes).norm() <= near * modes.norm();
  };
  answers_ = suit(kept_answers_) ? &kept_answers_ : &step_answers_;
  if (suit(*answers_)) return *answers_;
  const Stopwatch watch(solve_seconds_);
  step_answers_.motions = modes;
  step_answers_.middle = middle_;
  step_answers_.placements = state_.placements;
  step_answers_.kick = kick_;
  find_answers(*tangent_, step_answers_);
  return step_answers_;
}

/// The change of the amplitudes, and of the flow with them: impulses after the flow's own change are known, nearly.
Eigen::VectorXd AleFlow::correct(const WithModes& bodies, const Eigen::VectorXd& residual, Eigen::VectorXd& change) {
  const auto& answers = answers_to(bodies.modes);
  Unknowns all = Unknowns::Zero(equations_.size());
  given_.add(change, all);
  Eigen::VectorXd loads = -(residual + tangent_->times(all)).head(2 * mesh_.size());
  add_buoyancy(loads);
  const Eigen::VectorXd impulse = impulse_of(loads).head(bodies.modes.rows());
  const Eigen::VectorXd more =
      bodies.next(bodies.modes.transpose() * answers.impulses, impulse, amplitudes_) - amplitudes_;
  change += answers.fields * more;
  return more;
}

Status AleFlow::newton(const WithModes* bodies) {
  constexpr double patience = 10;  // iterations that cost as much as another factor
  const Eigen::Index nodes = mesh_.size(), free = given_.free();
  const double tolerance = spec_.newton.tolerance;
  double last = 0;
  bool is_fresh = false;
  Mixing mixing(given_.free_among(2 * nodes));
  Eigen::VectorXd residual, change, more;
  for (iterations_ = 1; iterations_ <= spec_.newton.max_iterations; ++iterations_) {
    {
      const Stopwatch watch(assembly_seconds_);
      equations_.residual(fields_, at_, residual);
    }
    {
      const Stopwatch watch(solve_seconds_);
      change = tangent_->correction(given_.gather(residual));
    }
    if (bodies) more = correct(*bodies, residual, change);
    Unknowns all = Unknowns::Zero(equations_.size());
    given_.add(change, all);
    double size = fastest_among(all, nodes);
    double speed = std::max(fastest_among(at_ + all, nodes), 1e-3 * state_.fastest);
    if (bodies && more.size() > 0) {
      // Velocities of walls are as sure as those of the flow.
      const Eigen::VectorXd moved = bodies->modes * more;
      const double scale = std::max(rates_.cwiseAbs().maxCoeff(), bodies->velocities.cwiseAbs().maxCoeff());
      size = std::max(size, scale > 0 ? moved.cwiseAbs().maxCoeff() / scale * speed : 0.0);
      change.conservativeResize(free + more.size());
      change.tail(more.size()) = more;
    }
    if (!std::isfinite(size) || !change.allFinite())
      return {"Newton's method of the fluid left all numbers; use a smaller time.dt_max"};
    const bool is_near = size <= tolerance * speed;
    const Eigen::VectorXd way = is_near ? change : mixing.way(change);
    given_.add(way.head(free), at_);
    if (bodies && more.size() > 0) {
      amplitudes_ += way.tail(more.size());
      rates_ = all_rates(bodies->velocities + bodies->modes * amplitudes_);
      is_solved_ = true;  // the flow goes on from where it is
      move_walls(rates_);
    }
    if (is_near) return {};
    if (iterations_ > 1) {
      const double left = std::log(tolerance * speed / size) / std::log(std::min(size / last, 0.999));
      if (left > patience) {
        if (is_fresh && size > 1e3 * last) break;
        if (!factor(of_pass_)) break;
        is_fresh = true;
        mixing.forget();
      }
    }
    last = size;
  }
  return {"Newton's method of the fluid did not converge; use a smaller time.dt_max, or a longer fluid.inflow.ramp"};
}

}  // namespace splashdown::ale
