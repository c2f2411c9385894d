// The fluid on a mesh that moves with its walls as a part of a coupling. Each wall says what its coordinates are
// (walls/moving_wall.hpp), of a rigid one its twist; the structure's walls come first among the fluid's, all others stand still.
//
// The exact term (M + Z^T A Z) y = Z^T (I + A y) + known is found by Newton's method with the slope A of the factor that the
// fluid has anyway: its first correction contains the added mass.
#pragma once

#include <memory>

#include "coupling/participant.hpp"
#include "fluid/ale/fluid.hpp"

namespace splashdown::ale {

/// AleFlow behind the seam.
class Participant final : public coupling::FluidPart, private coupling::Linearised {
 public:
  /// Takes the fluid over; not null.
  explicit Participant(std::unique_ptr<AleFlow> fluid) : fluid_(std::move(fluid)) {}
  /// The fluid, to be looked at.
  const AleFlow& fluid() const { return *fluid_; }

  double time() const override { return fluid_->time(); }
  /// Infinity: the scheme is stable, and who asks for a step knows what it shall resolve.
  double stable_dt() const override;
  void save(std::ostream& out) const override { fluid_->save(out); }
  void load(std::istream& in) override { fluid_->load(in); }

  coupling::Status begin(const coupling::Step& step, const coupling::InterfaceModel& structure) override;
  coupling::Status solve(const coupling::Pass& pass) override;
  const coupling::Solution& solution() const override { return solution_; }
  coupling::Status acceptable() const override { return fluid_->acceptable(); }
  void commit(const coupling::Placement& walls) override { fluid_->commit(walls); }

  const coupling::Linearised* linearised() const override { return this; }
  double density() const override { return fluid_->density(); }
  double roundoff() const override;
  std::vector<std::pair<std::string, double>> phase_seconds() const override { return fluid_->phase_seconds(); }

 private:
  Eigen::MatrixXd slope(std::span<const std::size_t> walls) const override { return -added_mass(walls); }
  Eigen::MatrixXd added_mass(std::span<const std::size_t> walls) const override;
  coupling::Status solve_exact(const coupling::Pass& pass);

  std::unique_ptr<AleFlow> fluid_;
  coupling::Step step_;
  coupling::ModalInertia modal_;
  Eigen::MatrixXd answered_;  // Z^T A Z as the step begins, of this factor of the fluid's
  long of_factor_ = -1;
  coupling::Solution solution_;
};

}  // namespace splashdown::ale
