// A stepper together with the water and the bodies in it, for tests that look at them.
#pragma once

#include <memory>
#include <span>

#include "coupling/schemes/steppers.hpp"
#include "fluid/pfem/participant.hpp"
#include "rigid/participant.hpp"

namespace splashdown::coupling::scenes {

template <int d>
class Watched final : public Stepper {
 public:
  using Water = std::unique_ptr<fluid::Fluid<d>>;
  using Bodies = std::unique_ptr<rigid::Bodies<d>>;

  explicit Watched(Water water) : stepper_(std::make_unique<FluidOnly>(part(std::move(water)))) {}
  Watched(Bodies bodies, double dt) : stepper_(std::make_unique<StructureOnly>(part(std::move(bodies)), dt)) {}
  /// Bodies inside the pressure equation.
  Watched(Water water, Bodies bodies)
      : stepper_(std::make_unique<Simultaneous>(part(std::move(water)), part(std::move(bodies)))) {}
  Watched(Water water, Bodies bodies, std::unique_ptr<InterfaceTerm> term, std::unique_ptr<Accelerator> accelerator,
          CouplingLimits limits)
      : stepper_(std::make_unique<Partitioned>(part(std::move(water)), part(std::move(bodies)), std::move(term),
                                               std::move(accelerator), limits)) {}

  double time() const override { return stepper_->time(); }
  double stable_dt() const override { return stepper_->stable_dt(); }
  StepReport attempt(double dt) override { return stepper_->attempt(dt); }
  bool release_fragment() override { return stepper_->release_fragment(); }
  void commit() override { stepper_->commit(); }
  std::vector<std::pair<std::string, double>> phase_seconds() const override { return stepper_->phase_seconds(); }
  void save(std::ostream& out) const override { stepper_->save(out); }
  void load(std::istream& in) override { stepper_->load(in); }

  const fluid::Fluid<d>& fluid() const { return *fluid_; }
  const rigid::Bodies<d>& bodies() const { return *bodies_; }
  std::span<const rigid::BodyState<d>> trial() const { return bodies_->trials(); }

 private:
  std::unique_ptr<FluidPart> part(Water water) {
    fluid_ = water.get();
    return std::make_unique<fluid::Participant<d>>(std::move(water));
  }
  std::unique_ptr<StructurePart> part(Bodies bodies) {
    bodies_ = bodies.get();
    return std::make_unique<rigid::Participant<d>>(std::move(bodies));
  }

  const fluid::Fluid<d>* fluid_ = nullptr;
  const rigid::Bodies<d>* bodies_ = nullptr;
  std::unique_ptr<Stepper> stepper_;
};

}  // namespace splashdown::coupling::scenes
