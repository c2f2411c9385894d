#include "apps/simulation/simulation_of.hpp"

#include <algorithm>
#include <utility>

#include "apps/simulation/approach.hpp"
#include "core/leapfrog.hpp"

namespace splashdown::apps {

template <int d>
SimulationOf<d>::SimulationOf(const Scene& scene, World<d> world) : scene_(scene), world_(std::move(world)) {
  if (world_.bodies) walls_.emplace(scene_, *world_.bodies);
  if (world_.bodies && world_.solids) all_.emplace(*world_.bodies, *world_.solids);
}

template <int d>
double SimulationOf<d>::dt_bound() const {
  const double dt_max = scene_.time.dt_max;
  return world_.fluid && world_.bodies ? std::min(dt_max, approach_dt(*world_.fluid, *world_.bodies, scene_.time.cfl))
                                       : dt_max;
}

template <int d>
std::optional<Obstacle> SimulationOf<d>::obstacle() const {
  if (!walls_) return {};
  return walls_->crossed(world_.bodies->trials(), stepper().time());
}

template <int d>
RecordInput<d> SimulationOf<d>::known(const StepMade& step) const {
  RecordInput<d> in;
  in.fluid = world_.fluid;
  in.bodies = world_.bodies;
  in.time = step.time;
  in.dt = step.dt;
  in.passes = step.report.passes;
  in.residual = step.report.residual;
  in.pass_residuals = step.report.pass_residuals;
  in.last = step.last;
  if (world_.bodies) {
    const double kick = splashdown::kick(step.dt_previous, step.dt);
    for (std::size_t i = 0; i < world_.bodies->size(); ++i) {
      // Linear between the half steps: their mean for constant dt, the initial velocity at the first step.
      const rigid::Twist<d>& before = world_.bodies->state(i).velocity;
      const rigid::Twist<d> acceleration = (world_.bodies->trials()[i].velocity - before) / kick;
      in.body_acceleration_n.push_back(acceleration);
      in.body_velocity_n.push_back(before + 0.5 * step.dt_previous * acceleration);
      in.body_load.push_back(world_.fluid ? world_.fluid->loads()[i] : WallLoad<d>{});
    }
  }
  if (const auto* solids = world_.solids) {
    in.solids = solids;
    in.bodies = all_ ? static_cast<const BodiesView<d>*>(&*all_) : solids;
    for (std::size_t i = 0; i < solids->size(); ++i) {
      in.body_velocity_n.push_back(solids->velocity_n(i));
      in.body_acceleration_n.push_back(solids->acceleration_n(i));
      in.body_load.push_back(world_.fluid ? world_.fluid->loads()[in.body_load.size()] : WallLoad<d>{});
    }
  }
  return world_.whole ? world_.whole->tell(std::move(in)) : in;
}

template class SimulationOf<2>;
template class SimulationOf<3>;

}  // namespace splashdown::apps
