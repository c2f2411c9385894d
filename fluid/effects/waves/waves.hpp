// Waves that zones along the sides of a tank keep alive and let pass:
//
//   dv/dt = r(x) (u(x, t) - v),   r = rate s^2,   s from 0 at a zone's inner edge to 1 at the wall
//
// u is the speed of the undisturbed sea. Other waves, from bodies, die out in the zones, the sea's own does not (Jacobsen,
// Fuhrman, Fredsoe, Int. J. Numer. Meth. Fluids 70, 2012; here speeds alone: positions follow). Integrated exactly over a kick,
// with u at t_{n-1/2}, to which the velocities belong, and where the nodes were then. What a zone does to a wave goes as r/c_g,
// with the group speed c_g: zones of 1.5 wavelengths with a rate of 36 c_g/L throw back less than 2 % of the sea's waves. Drops
// in flight are left alone.
#pragma once

#include <memory>
#include <vector>

#include "fluid/effects/effect.hpp"
#include "fluid/effects/waves/wave_field.hpp"

namespace splashdown::fluid {

/// Zones inside a box: none where the width is zero.
template <int d>
struct WaveZones {
  Vec<d> min = Vec<d>::Zero(), max = Vec<d>::Zero();  ///< the tank [m]
  Vec<d> width = Vec<d>::Zero();                      ///< of the zones at both ends of an axis [m]
  double rate = 0;                                    ///< at the walls [1/s]
  double ramp = 0;  ///< in which the sea grows from nothing [s]; 0: it is there at t = 0

  /// r(x) [1/s]
  double rate_at(const Vec<d>& x) const;
  /// 0 at t = 0, 1 after the ramp, smooth.
  double share_at(double t) const;
};

/// dv = (1 - exp(-r kick)) (u - v) at each node; walls get nothing. Its work on the water is booked.
template <int d>
class Waves final : public Effect<d> {
 public:
  /// The sea that zones pull towards; not null.
  Waves(std::unique_ptr<const WaveField<d>> sea, const WaveZones<d>& zones) : sea_(std::move(sea)), zones_(zones) {}
  std::string name() const override { return "waves"; }
  Status begin(const StepView<d>& step) override;
  Status predict(const StepView<d>& step, const Carried<d>& carried, const Predicted<d>& predicted) override;
  bool books_work() const override { return true; }
  /// For accuracy: leapfrog makes a frequency too high by (w dt)^2/24, and a wave of deep water that keeps its period too fast by
  /// twice that, 0.1 % with 60 steps in a period.
  double stable_dt() const override { return sea_->period() / 60; }

 private:
  struct Pull {
    std::size_t node;
    double share;  // 1 - exp(-r kick)
    Vec<d> towards = Vec<d>::Zero();
  };
  std::unique_ptr<const WaveField<d>> sea_;
  WaveZones<d> zones_;
  std::vector<Pull> pulls_;  // of the begun step
};

extern template struct WaveZones<2>;
extern template struct WaveZones<3>;
extern template class Waves<2>;
extern template class Waves<3>;

}  // namespace splashdown::fluid
