// Velocity and pressure as one system, with equal-order elements and PSPG (Tezduyar, Mittal, Ray, Shih 1992), velocities
// eliminated.
//
//   M (v+ - v*) + G phi = 0,   D(x_m) u(v+) = sum_e theta_e int_e grad q . (- M^-1 G phi + grad phi / rho),   x_m = x_n + dt u/2
//
// Viscosity acts on all that changes velocities, the pressure included (Effect::follow): v+ - v* is then - M^-1 G phi and what
// it makes of it, by a back-substitution on its own factor in each iterate. theta_e = tau_e / kick,
//
//   tau_e = ((2 / kick)^2 + (12 nu / h_e^2)^2)^(-1/2)
//
// The right side vanishes for the exact solution; it makes pressures definite that change their sign
// from node to node. With phi natural on all of the free surface q = 1 is a test function, so that it moves volume about and
// makes none. The system is solved to a tolerance by generalised conjugate residuals on the factor of the pressure matrix, and
// once more where the middle of the motion has moved (Picard).
#pragma once

#include "fluid/pfem/formulations.hpp"
#include "fluid/pfem/step/step.hpp"

namespace splashdown::fluid {

/// The repair is the same system, at the middle of the motion that led to t_n.
template <int d>
class Monolithic final : public WaterStep<d> {
 public:
  /// The water must outlive it.
  Monolithic(Water<d>& water, const MonolithicSpec& spec) : WaterStep<d>(water, SurfaceUnknowns::all), spec_(spec) {}

 private:
  using WaterStep<d>::water_, WaterStep<d>::equation_, WaterStep<d>::trial_, WaterStep<d>::kick_;
  using typename WaterStep<d>::Unrepaired;
  using WaterStep<d>::begin_repair, WaterStep<d>::flux_before, WaterStep<d>::answer_to, WaterStep<d>::take_repair;
  using WaterStep<d>::move_nodes, WaterStep<d>::what_is_left, WaterStep<d>::ask, WaterStep<d>::apply;
  using WaterStep<d>::has_followers, WaterStep<d>::pushed, WaterStep<d>::settle_bodies;

  Status repair() override;
  /// What iterations leave.
  struct Left {
    Status status;
    double size = 0;  ///< r^T A^-1 r [J]
  };
  /// A repair: impulses, velocities of nodes as if no wall held them, what is left of its flux and what would be enough [J].
  struct Repair {
    std::vector<double>& impulses;
    std::vector<Vec<d>> free;
    Left left;
    double enough = 0;
  };
  /// `seen`: as `flux_before` has it.
  void find_repair(const Unrepaired& from, const Unrepaired* seen, Repair& found);
  Status correct(std::span<const double> previous) override;
  double judged_at() const override { return spec_.implicit_euler ? 1.0 : 0.5; }
  bool solves_all() const override { return true; }
  InTime in_time() const override { return spec_.implicit_euler ? InTime::euler : InTime::second_order; }
  /// theta of each cell.
  std::vector<double> shares() const;
  /// Iterates impulses and walls by `add(correction, share)` until what `find(left)` tells of them is `enough`, r^T A^-1 r [J],
  /// or for a few passes: what is left then.
  template <class Find, class Apply>
  Left converge(Find find, Apply add, double enough);

  MonolithicSpec spec_;
};

extern template class Monolithic<2>;
extern template class Monolithic<3>;

}  // namespace splashdown::fluid
