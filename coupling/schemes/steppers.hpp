// Steppers: each holds exactly the parts it drives. Walls of the fluid: body k is wall k, others stand still.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "coupling/accelerators/accelerator.hpp"
#include "coupling/interface_term.hpp"
#include "coupling/schemes/stepper.hpp"
#include "fluid/fluid.hpp"
#include "rigid/bodies.hpp"

namespace splashdown::coupling {

/// Time of the last step, from which kick = (dt_{n-1} + dt_n) / 2 follows.
class LeapfrogClock {
 public:
  double kick(double dt) const { return 0.5 * (previous_ + dt); }
  void start(double dt) { current_ = dt; }
  void commit() { previous_ = current_; }
  void save(std::ostream& out) const;
  void load(std::istream& in);

 private:
  double previous_ = 0, current_ = 0;
};

template <int d>
class FluidOnly final : public Stepper {
 public:
  explicit FluidOnly(std::unique_ptr<fluid::Fluid<d>> fluid) : fluid_(std::move(fluid)) {}
  double time() const override { return fluid_->time(); }
  double stable_dt() const override { return fluid_->stable_dt(); }
  StepReport attempt(double dt) override;
  void commit() override;
  std::vector<std::pair<std::string, double>> phase_seconds() const override { return fluid_->phase_seconds(); }
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;
  const fluid::Fluid<d>& fluid() const { return *fluid_; }

 private:
  std::unique_ptr<fluid::Fluid<d>> fluid_;
  LeapfrogClock clock_;
};

template <int d>
class BodiesOnly final : public Stepper {
 public:
  BodiesOnly(std::unique_ptr<rigid::Bodies<d>> bodies, double dt) : bodies_(std::move(bodies)), dt_(dt) {}
  double time() const override { return bodies_->time(); }
  double stable_dt() const override { return dt_; }
  StepReport attempt(double dt) override;
  void commit() override;
  std::vector<std::pair<std::string, double>> phase_seconds() const override { return {}; }
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;
  const rigid::Bodies<d>& bodies() const { return *bodies_; }
  const std::vector<rigid::BodyState<d>>& trial() const { return trial_; }

 private:
  std::unique_ptr<rigid::Bodies<d>> bodies_;
  double dt_;
  LeapfrogClock clock_;
  std::vector<rigid::BodyState<d>> trial_;
};

struct CouplingLimits {
  double tolerance = 1e-8;  ///< of the interface velocity residual, relative to the step's velocities
  int max_passes = 50;      ///< more passes mean that the step is refused
  int fixed_passes = 0;     ///< the last of so many is accepted as it is; 0: none is
};

/// A fluid and bodies with their clock; schemes differ in `attempt`.
template <int d>
class Coupled : public Stepper {
 public:
  Coupled(std::unique_ptr<fluid::Fluid<d>> fluid, std::unique_ptr<rigid::Bodies<d>> bodies)
      : fluid_(std::move(fluid)), bodies_(std::move(bodies)) {}
  double time() const override { return fluid_->time(); }
  /// The fluid's; and no body turns by more than half a radian.
  double stable_dt() const override;
  void commit() override;
  std::vector<std::pair<std::string, double>> phase_seconds() const override;
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;
  const fluid::Fluid<d>& fluid() const { return *fluid_; }
  const rigid::Bodies<d>& bodies() const { return *bodies_; }
  const std::vector<rigid::BodyState<d>>& trial() const { return trial_; }

 protected:
  void begin_bodies(double dt);
  void keep(std::span<const rigid::BodyState<d>> trial) { trial_.assign(trial.begin(), trial.end()); }
  /// Of all the fluid's walls: the bodies' twists, zero for the others.
  std::vector<fluid::Twist<d>> of_walls(const std::vector<fluid::Twist<d>>& bodies) const;
  std::vector<rigid::Wrench<d>> total_loads() const;
  double fluid_seconds() const;
  /// Velocities below this many body lengths a step are roundoff of positions: a body at rest [m/s].
  double still(double dt) const;

  std::unique_ptr<fluid::Fluid<d>> fluid_;
  std::unique_ptr<rigid::Bodies<d>> bodies_;
  LeapfrogClock clock_;
  std::vector<rigid::BodyState<d>> trial_;
  double kick_ = 0;
  double rigid_seconds_ = 0, coupling_seconds_ = 0;
};

/// Bodies inside the pressure equation: the exact interface term `rigid`. One pass satisfies both sides to roundoff;
/// contacts that open or close within the step take another one.
template <int d>
class Simultaneous final : public Coupled<d> {
 public:
  Simultaneous(std::unique_ptr<fluid::Fluid<d>> fluid, std::unique_ptr<rigid::Bodies<d>> bodies, int max_passes = 50)
      : Coupled<d>(std::move(fluid), std::move(bodies)), max_passes_(max_passes) {}
  StepReport attempt(double dt) override;

 private:
  using Coupled<d>::fluid_;
  using Coupled<d>::bodies_;
  using Coupled<d>::trial_;
  using Coupled<d>::kick_;

  double relative(std::span<const fluid::Twist<d>> unloaded, double dt) const;

  int max_passes_;
};

/// Dirichlet-Neumann: the fluid gets wall velocities, the bodies get loads, until both agree.
///
///   x -> fluid -> loads -> bodies -> G(x),   residual |G(x) - x| in m/s, rotations times the body's
///   radius of gyration
template <int d>
class Partitioned final : public Coupled<d> {
 public:
  Partitioned(std::unique_ptr<fluid::Fluid<d>> fluid, std::unique_ptr<rigid::Bodies<d>> bodies,
              std::unique_ptr<InterfaceTerm<d>> term, std::unique_ptr<Accelerator> accelerator, CouplingLimits limits);
  StepReport attempt(double dt) override;
  void commit() override;
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;
  const InterfaceTerm<d>& term() const { return *term_; }

 private:
  using Coupled<d>::fluid_;
  using Coupled<d>::bodies_;
  using Coupled<d>::trial_;
  using Coupled<d>::kick_;

  StepReport iterate(double dt);
  void move_bodies(const std::vector<rigid::Wrench<d>>& loads);
  std::vector<fluid::Twist<d>> trial_velocities() const;

  std::unique_ptr<InterfaceTerm<d>> term_;
  std::unique_ptr<Accelerator> accelerator_;
  CouplingLimits limits_;
  std::vector<fluid::Twist<d>> acceleration_;  // of the last step: predicts the next one's velocities
};

extern template class FluidOnly<2>;
extern template class FluidOnly<3>;
extern template class BodiesOnly<2>;
extern template class BodiesOnly<3>;
extern template class Coupled<2>;
extern template class Coupled<3>;
extern template class Simultaneous<2>;
extern template class Simultaneous<3>;
extern template class Partitioned<2>;
extern template class Partitioned<3>;

}  // namespace splashdown::coupling
