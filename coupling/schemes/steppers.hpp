// Steppers: each holds exactly the parts it drives. Those with two parts share a leapfrog clock: motions live at half
// steps, placements at whole ones.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "core/leapfrog.hpp"
#include "coupling/accelerators/accelerator.hpp"
#include "coupling/interface_term.hpp"
#include "coupling/participant.hpp"
#include "coupling/schemes/stepper.hpp"

namespace splashdown::coupling {

/// Time of the last step, from which kick = (dt_{n-1} + dt_n) / 2 follows.
class LeapfrogClock {
 public:
  /// Of a step of dt after the last one [s].
  double kick(double dt) const { return splashdown::kick(previous_, dt); }
  /// A step of dt [s] is tried.
  void start(double dt) { current_ = dt; }
  /// The step that was tried is the last one.
  void commit() { previous_ = current_; }
  void save(std::ostream& out) const;  ///< length of the last step, bit exact
  void load(std::istream& in);         ///< throws std::runtime_error unless it is a length

 private:
  double previous_ = 0, current_ = 0;
};

/// A fluid between walls that stand still.
class FluidOnly final : public Stepper {
 public:
  /// Takes the fluid over; not null.
  explicit FluidOnly(std::unique_ptr<FluidPart> fluid) : fluid_(std::move(fluid)) {}
  double time() const override { return fluid_->time(); }
  double stable_dt() const override { return fluid_->stable_dt(); }
  StepReport attempt(double dt) override;
  bool release_fragment() override { return fluid_->release_fragment(); }
  void commit() override;
  std::vector<std::pair<std::string, double>> phase_seconds() const override { return fluid_->phase_seconds(); }
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;
  /// The part that is driven.
  const FluidPart& fluid() const { return *fluid_; }

 private:
  std::unique_ptr<FluidPart> fluid_;
  LeapfrogClock clock_;
};

/// A begun step of a structure on whose walls no impulse acts. `trial`: the velocities that it ends with.
StepReport step_alone(StructurePart& structure, Velocities& trial);

/// A structure without a fluid: no impulse acts on its walls.
class StructureOnly final : public Stepper {
 public:
  /// `dt`: the largest step [s].
  StructureOnly(std::unique_ptr<StructurePart> structure, double dt) : structure_(std::move(structure)), dt_(dt) {}
  double time() const override { return structure_->time(); }
  double stable_dt() const override { return std::min(dt_, structure_->stable_dt()); }
  StepReport attempt(double dt) override;
  void commit() override;
  std::vector<std::pair<std::string, double>> phase_seconds() const override { return {}; }
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;
  /// The part that is driven.
  const StructurePart& structure() const { return *structure_; }

 private:
  std::unique_ptr<StructurePart> structure_;
  double dt_;
  LeapfrogClock clock_;
};

/// When a partitioned iteration ends.
struct CouplingLimits {
  double tolerance = 1e-8;  ///< of the interface velocity residual, relative to the step's velocities
  int max_passes = 50;      ///< more passes mean that the step is refused
  int fixed_passes = 0;     ///< the last of so many is accepted as it is; 0: none is
};

/// A fluid and a structure with their clock; schemes differ in how they make both agree. A fluid that rests while the structure
/// is far away may wait for it: the structure then moves alone.
class Coupled : public Stepper {
 public:
  /// Drives both; the structure's walls come first among the fluid's.
  Coupled(std::unique_ptr<FluidPart> fluid, std::unique_ptr<StructurePart> structure)
      : fluid_(std::move(fluid)), structure_(std::move(structure)) {}
  /// From now on the fluid waits when it may (FluidPart::rests); else it is always stepped.
  void let_fluid_wait() { may_wait_ = true; }
  double time() const override { return fluid_->time(); }
  double stable_dt() const override;
  StepReport attempt(double dt) final;
  bool release_fragment() override { return !waits_ && fluid_->release_fragment(); }
  void commit() final;
  std::vector<std::pair<std::string, double>> phase_seconds() const override;
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;
  /// The fluid that is driven.
  const FluidPart& fluid() const { return *fluid_; }
  /// The structure that is driven.
  const StructurePart& structure() const { return *structure_; }

 protected:
  /// An attempt with both.
  virtual StepReport couple(double dt) = 0;
  /// What a scheme keeps of a step of both that is accepted.
  virtual void remember() {}
  /// Begins a step of dt [s] on the clock and in the structure: kick and dt of it.
  Step begin_structure(double dt);
  /// Refuses what so far is no cause of refusal if the trial of a side may not be committed.
  void judge(StepReport& report) const;
  /// Seconds that the fluid has spent so far, all phases.
  double fluid_seconds() const;
  /// Velocities below this many lengths of the structure a step are roundoff of positions: at rest [m/s].
  double still(double dt) const;

  std::unique_ptr<FluidPart> fluid_;          ///< not null
  std::unique_ptr<StructurePart> structure_;  ///< not null
  LeapfrogClock clock_;                       ///< of both
  double structure_seconds_ = 0;              ///< wall clock spent in the structure so far
  double coupling_seconds_ = 0;               ///< in the scheme, the structure included, the fluid not

 private:
  StepReport move_structure_alone(double dt);

  bool may_wait_ = false;
  bool waits_ = false;  // the fluid does, in the next step
  double dt_ = 0;       // of the attempt
  Velocities alone_;    // that the structure ends the attempt with
};

/// The structure inside the fluid's equations: the exact interface term `rigid`, M + Z^T B A^-1 B^T Z, whatever the
/// coordinates of its walls are. One pass satisfies both sides to roundoff; contacts that open or close within the step
/// take another one.
class Simultaneous final : public Coupled {
 public:
  /// `max_passes`: more of them, as contacts open and close, and the step is refused.
  Simultaneous(std::unique_ptr<FluidPart> fluid, std::unique_ptr<StructurePart> structure, int max_passes = 50)
      : Coupled(std::move(fluid), std::move(structure)), max_passes_(max_passes) {}

 private:
  StepReport couple(double dt) override;
  StepReport pass_by_pass(Response response, double dt);
  double relative(const Velocities& unloaded, const Velocities& loaded, double dt) const;
  std::string massless_and_dry() const;

  int max_passes_;
};

/// Dirichlet-Neumann: the fluid gets the walls' motion, the structure gets impulses, until both agree.
///
///   x -> fluid -> impulses -> structure -> G(x),   residual |G(x) - x| in m/s (interface_space.hpp)
class Partitioned final : public Coupled {
 public:
  /// `term`: stand-in for the structure in the fluid's equations; `accelerator`: of the iteration.
  Partitioned(std::unique_ptr<FluidPart> fluid, std::unique_ptr<StructurePart> structure,
              std::unique_ptr<InterfaceTerm> term, std::unique_ptr<Accelerator> accelerator, CouplingLimits limits);
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;
  /// The stand-in.
  const InterfaceTerm& term() const { return *term_; }

 private:
  StepReport couple(double dt) override;
  void remember() override;
  StepReport iterate(const Step& step);
  const Velocities& move_structure(const Impulse& impulse);

  std::unique_ptr<InterfaceTerm> term_;
  std::unique_ptr<Accelerator> accelerator_;
  CouplingLimits limits_;
  double kick_ = 0;
  Velocities trial_;
  Velocities acceleration_;  // of the last step: predicts the next one's velocities
};

}  // namespace splashdown::coupling
