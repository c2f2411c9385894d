// The fluid on a mesh that moves with its walls as a part of a coupling. Each wall says what its coordinates are
// (walls/moving_wall.hpp), of a rigid one its twist; the structure's walls come first among the fluid's, all others stand still.
//
// The exact term (M + Z^T A Z) y = Z^T (I + A y) + known is a part of Newton's method for the flow: the factor that the fluid has
// anyway tells A, which contains the added mass, and each iteration corrects flow and bodies together (AleFlow::solve).
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
  bool is_first_pass_ = true;  // of the begun step: later ones go on from the flow of the one before
  coupling::Solution solution_;
};

}  // namespace splashdown::ale
