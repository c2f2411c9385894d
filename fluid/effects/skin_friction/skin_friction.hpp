// Friction of the water on hulls, by the friction line of a flat plate: the boundary layer is too thin for elements.
//
//   f = 1/2 rho C_F(|u| L / nu) A |u| u     on each wetted facet of a hull, area A
//
// u is the velocity of the water along the facet past the hull outside of the boundary layer, L the length of the hull's wetted
// part in the direction of u.
//
// The reaction stays in the boundary layer. Its momentum thickness, C_F x / 2 behind the leading edge, is less than half an
// element, which is the water that nodes on the hull stand for: they take the reaction, slow down by the layer's mean, and keep
// the flow off the hull by about its displacement thickness. What they cannot take without going against the hull passes to the
// nodes behind them. u is therefore read where it is larger, on the hull (curved hulls) or one element away from it (layers).
#pragma once

#include <optional>

#include "core/mirror.hpp"
#include "fluid/effects/effect.hpp"
#include "fluid/effects/skin_friction/friction_line.hpp"

namespace splashdown::fluid {

/// What the friction of hulls is made from.
struct SkinFrictionSpec {
  FrictionLine line = FrictionLine::ittc1957;
  double dynamic_viscosity = 1e-3;    ///< [Pa s]
  std::size_t hulls = 0;              ///< the first so many walls have friction
  std::optional<Mirror> mirror = {};  ///< which hulls are one half before: their lengths are of the whole
};

/// Explicit, momentum is kept. A kick brings no node and no body beyond the velocity of what rubs it.
template <int d>
class SkinFriction final : public Effect<d> {
 public:
  /// Takes the values as they are: readers check them.
  explicit SkinFriction(const SkinFrictionSpec& spec) : spec_(spec) {}
  std::string name() const override { return "skin_friction"; }
  Status begin(const StepView<d>& step) override;
  Status predict(const StepView<d>& step, const Carried<d>& carried, const Predicted<d>& predicted) override;
  bool books_work() const override { return true; }
  /// power: on water and hulls together, not positive [W]; fx, fy, fz: on all hulls [N; 2D: N/m]
  std::vector<Diagnostic> diagnostics(const Nodes<d>& nodes, std::span<const double> lumped_mass) const override;

 private:
  struct Wetted {  // a facet of a hull
    std::array<int, d> nodes;
    int inner;  // the corner of its cell off the hull
    int wall;
    Vec<d> centre, normal;  // world frame; unit
    double area;
  };
  struct Rubbed {     // of a facet, in a kick
    Vec<d> impulse;   // on the hull
    double rate = 0;  // impulse over the speed [N s/m]
  };
  /// u at a facet [m/s].
  Vec<d> past(const StepView<d>& step, const Wetted& f, const Carried<d>& carried) const;
  double length(const StepView<d>& step, int wall, const Vec<d>& direction) const;
  /// Share of the friction that leaves a body at most with the water's velocity.
  double limit(const StepView<d>& step, std::size_t wall, std::span<const Rubbed> rubbed) const;
  /// Acts on hulls and on the water's nodes, each pair at the node's place.
  void rub(const StepView<d>& step, const Carried<d>& carried, std::span<const Rubbed> rubbed,
           const Predicted<d>& predicted);

  SkinFrictionSpec spec_;
  std::vector<Wetted> wetted_;
  std::vector<std::vector<int>> nodes_of_;  // of each hull, wetted
  Vec<d> force_ = Vec<d>::Zero();
  double power_ = 0;
};

extern template class SkinFriction<2>;
extern template class SkinFriction<3>;

}  // namespace splashdown::fluid
