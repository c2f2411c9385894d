// The fluid on a grid as a part of a coupling: coordinates of wall k are its twist about the wall's reference point,
// in the world frame, its placement the first two rows of its pose. The structure's walls come first among the
// fluid's; all others stand still.
//
// A begun step answers any twists by a small linear law, I(s) = constant - answer s (penalised/wall.hpp), so that
// passes of any scheme cost nothing, and the exact term is (M + Z^T answer Z) y = Z^T (constant - answer s_free).
#pragma once

#include <memory>

#include "coupling/participant.hpp"
#include "fluid/vortex/fluid.hpp"

namespace splashdown::vortex {

/// GridFlow behind the seam.
class Participant final : public coupling::FluidPart, private coupling::Linearised {
 public:
  /// Takes the fluid over; not null.
  explicit Participant(std::unique_ptr<GridFlow> fluid) : fluid_(std::move(fluid)) {}
  /// The fluid, to be looked at.
  const GridFlow& fluid() const { return *fluid_; }

  double time() const override { return fluid_->time(); }
  double stable_dt() const override { return fluid_->stable_dt(); }
  void save(std::ostream& out) const override { fluid_->save(out); }
  void load(std::istream& in) override { fluid_->load(in); }

  coupling::Status begin(const coupling::Step& step, const coupling::InterfaceModel& structure) override;
  coupling::Status solve(const coupling::Pass& pass) override;
  const coupling::Solution& solution() const override { return solution_; }
  /// Hulls may not cross more than a square in a step.
  coupling::Status acceptable() const override;
  void commit(const coupling::Placement& walls) override;

  const coupling::Linearised* linearised() const override { return this; }
  double density() const override { return fluid_->density(); }
  double roundoff() const override;
  std::vector<std::pair<std::string, double>> phase_seconds() const override { return fluid_->phase_seconds(); }

 private:
  Eigen::MatrixXd slope(std::span<const std::size_t> walls) const override;
  Eigen::MatrixXd added_mass(std::span<const std::size_t> walls) const override;
  coupling::Velocities exact(const coupling::Pass& pass) const;

  std::unique_ptr<GridFlow> fluid_;
  coupling::Step step_;
  coupling::ModalInertia modal_;
  coupling::Solution solution_;
};

}  // namespace splashdown::vortex
