// The fluid as a part of a coupling: coordinates of a rigid wall are its twist about the wall's reference point, in the world
// frame, its placement the first d rows of its pose; of a wall that deforms, velocities and places of its vertices. The
// structure's walls come first among the fluid's; all others stand still where they are.
#pragma once

#include <memory>

#include "coupling/participant.hpp"
#include "fluid/pfem/fluid.hpp"

namespace splashdown::fluid {

/// Fluid<d> behind the seam: translates between stacked coordinates and those of walls.
template <int d>
class Participant final : public coupling::FluidPart, private coupling::Linearised {
 public:
  /// Takes the fluid over; not null.
  explicit Participant(std::unique_ptr<Fluid<d>> fluid) : fluid_(std::move(fluid)) {}
  /// The fluid, to be looked at.
  const Fluid<d>& fluid() const { return *fluid_; }

  double time() const override { return fluid_->time(); }
  double stable_dt() const override { return fluid_->stable_dt(); }
  void save(std::ostream& out) const override { fluid_->save(out); }
  void load(std::istream& in) override { fluid_->load(in); }

  coupling::Status begin(const coupling::Step& step, const coupling::InterfaceModel& structure) override;
  coupling::Status solve(const coupling::Pass& pass) override;
  const coupling::Solution& solution() const override { return solution_; }
  coupling::Status acceptable() const override { return fluid_->acceptable(); }
  bool release_fragment() override { return fluid_->release_fragment(); }
  void commit(const coupling::Placement& walls) override;
  /// What is at rest waits while balls around the hulls that are not fixed stay a radius away from a box around the water.
  bool rests(std::span<const coupling::WallCoordinates> walls, const Eigen::VectorXd& speeds) override;
  void wait(double dt, const coupling::Placement& walls, const coupling::Velocities& velocities) override;

  std::span<const coupling::InterfacePiece> pieces() const override { return fluid_->interface_pieces(); }
  Eigen::VectorXd first_guess() const override;
  const coupling::Linearised* linearised() const override { return this; }
  double density() const override { return fluid_->spec().density; }
  double roundoff() const override;
  std::vector<std::pair<std::string, double>> phase_seconds() const override { return fluid_->phase_seconds(); }

 private:
  Eigen::MatrixXd slope(std::span<const std::size_t> walls) const override { return fluid_->interface_slope(walls); }
  Eigen::MatrixXd added_mass(std::span<const std::size_t> walls) const override { return fluid_->added_mass(walls); }

  std::unique_ptr<Fluid<d>> fluid_;
  double kick_ = 0;
  coupling::Solution solution_;
};

extern template class Participant<2>;
extern template class Participant<3>;

}  // namespace splashdown::fluid
