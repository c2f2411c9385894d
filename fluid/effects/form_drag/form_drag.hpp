// Drag of separated flow: what the water does not give back behind a hull. An inviscid flow closes behind it and loses nothing.
//
//   f = - 1/2 rho C g(s / b) e(q) (v . a) v    on each wetted facet that moves away from the water, v . a > 0
//
// a is the facet's area vector, out of the water, v its own velocity through the water around the hull (`Surroundings`), C the
// drag coefficient of the shape. v . a / |v| sums to the projected area of the rear: under water F = rho C A v^2 / 2. A rear that
// is dry has the pressure of the air, which the fluid knows: in the first impact and in open cavities nothing is added. Facets
// beside the flow have none, those of a body that turns have their own velocities (strips).
//
// q, from 0 to 1, says how far the flow of the fluid closes behind the hull: the mean over the rear of u . t / |v|, u the water's
// velocity past the hull, t along it towards the rear's centre. It is 1 on a circle and on a sphere: all of the drag is missing,
// e = 1. Off edges the fluid separates by itself: the water behind stands or turns back, q = 0, its pressure is low already, and
// e = 0.13.
#pragma once

#include "fluid/effects/form_drag/surroundings.hpp"

namespace splashdown::fluid {

/// Of a hull.
struct FormDragSpec {
  double coefficient = 1;  ///< C; 0: none
  double develops = 0;     ///< x_1; 0: at once
};

/// Explicit; the reaction goes to the water around the hull, most of it behind: momentum is kept, moments included. Acts in
/// directions that carry added mass alone, of rho b^d: C |v| kick / b of a body's velocity at most is lost in a kick.
///
/// Round hulls separate after a way s through the water since the last turn of the motion, of each strip its own where they turn,
///
///   g(x) = y^2 (3 - 2 y),  y = min(1, x / x_1)
///
/// b the diameter of the circle or sphere that holds as much. With x_1 = 1.8 this is the drag of an impulsively started circle
/// beside its friction (Koumoutsakos, Leonard, J. Fluid Mech. 296, 1995, Re 3000; Sarpkaya, J. Appl. Mech. 33, 1966).
template <int d>
class FormDrag final : public Effect<d> {
 public:
  /// `hulls`: of the first walls, in their order. Takes the values as they are: readers check them. With a mirror fluid,
  /// wetted facets, loads and work are those of the half before it.
  explicit FormDrag(std::vector<FormDragSpec> hulls, std::optional<Mirror> mirror = {})
      : hulls_(std::move(hulls)), mirror_(mirror), ways_(freedoms<d> * hulls_.size(), 0.0), next_(ways_) {}
  std::string name() const override { return "form_drag"; }
  Status begin(const StepView<d>& step) override;
  Status predict(const StepView<d>& step, const Carried<d>& carried, const Predicted<d>& predicted) override;
  void commit(const StepView<d>& step) override;
  /// The way of each hull through the water since its last turn [m], and the angle [rad].
  std::span<double> memory() override { return ways_; }
  bool books_work() const override { return true; }
  /// power: on water and hulls together [W]; closing: q of the last hull; fx, fy, fz: on all hulls [N; 2D: N/m]
  std::vector<Diagnostic> diagnostics(const Nodes<d>& nodes, std::span<const double> lumped_mass) const override;

 private:
  struct Wetted {
    std::array<int, d> nodes;  // of a facet
    Vec<d> arm, area;          // from the centre, world frame; out of the water
  };
  struct Hull {
    Vec<d> centre = Vec<d>::Zero();  // world frame
    std::vector<Wetted> wetted;
  };
  Twist<d> way(std::size_t hull) const { return Eigen::Map<const Twist<d>>(&ways_[freedoms<d> * hull]); }
  /// On the hull about its centre [N, N m], moving so through the water.
  Wrench<d> drag(std::size_t hull, const Twist<d>& through, double density) const;
  /// q of a hull that moves with `own`.
  double closing(std::size_t hull, const Twist<d>& through, const Twist<d>& own, std::span<const Vec<d>> v) const;
  void act(std::size_t hull, const StepView<d>& step, const Carried<d>& carried, const Predicted<d>& predicted);

  std::vector<FormDragSpec> hulls_;
  std::optional<Mirror> mirror_;
  std::vector<HullSphere<d>> spheres_;
  std::vector<Hull> now_;
  std::vector<double> ways_, next_;  // next: by the end of the step
  Vec<d> force_ = Vec<d>::Zero();
  double power_ = 0, closing_ = 0;
};

extern template class FormDrag<2>;
extern template class FormDrag<3>;

}  // namespace splashdown::fluid
