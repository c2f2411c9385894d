// Waves over still water as functions of place and time: what a scene's sea would be without bodies and without a tank.
#pragma once

#include <utility>
#include <vector>

#include "fluid/effects/waves/spectrum.hpp"
#include "fluid/effects/waves/steady_wave.hpp"
#include "fluid/pfem/types.hpp"

namespace splashdown::fluid {

/// Where a sea's still level and origin are, when its phases are zero there, and where its waves run. World frame, the last axis
/// is up.
template <int d>
struct SeaFrame {
  Vec<d> origin = Vec<d>::Zero();      ///< where phases count from, on the still level [m]
  Vec<d> direction = Vec<d>::Unit(0);  ///< horizontal, of unit length
  double time = 0;                     ///< when phases are zero at the origin [s]
  double depth = 0;                    ///< of still water [m]
  double gravity = 9.81;               ///< [m/s^2]

  /// Height of the still level [m].
  double level() const { return origin[d - 1]; }
  /// Along the waves from the origin [m].
  double along(const Vec<d>& x) const { return (x - origin).dot(direction); }
};

/// A sea without bodies.
template <int d>
class WaveField {
 public:
  virtual ~WaveField() = default;
  /// Of the surface above the still level [m] at the horizontal place of `x` (world) and time `t` [s].
  virtual double elevation(const Vec<d>& x, double t) const = 0;
  /// Of the water [m/s] at `x` (world), continued above the surface without growing.
  virtual Vec<d> velocity(const Vec<d>& x, double t) const = 0;
  virtual double length() const = 0;    ///< of the wave, or of the waves at the spectrum's peak [m]
  virtual double period() const = 0;    ///< of the same, as seen from the tank [s]
  virtual double shortest() const = 0;  ///< wave that the field is made of [m]; higher harmonics of a steady wave apart
  virtual double highest() const = 0;   ///< crest above the still level that is to be expected [m]
  virtual double lowest() const = 0;    ///< trough that is to be expected [m], negative
  /// How long ago the last crest of a steady wave passed, in radians of its period: 0 crest, pi trough, in [0, 2 pi). For other
  /// seas that of a wave of the peak's period alone, whose crest passes the origin at the frame's time.
  virtual double phase(const Vec<d>& x, double t) const = 0;
};

/// A wave of permanent form, with a crest at the origin at the frame's time.
template <int d>
class RegularWave final : public WaveField<d> {
 public:
  /// The wave, and where it begins and goes to.
  RegularWave(SteadyWave wave, const SeaFrame<d>& frame) : wave_(std::move(wave)), frame_(frame) {}
  double elevation(const Vec<d>& x, double t) const override;
  Vec<d> velocity(const Vec<d>& x, double t) const override;
  double length() const override { return wave_.length(); }
  double period() const override { return wave_.period(); }
  double shortest() const override { return wave_.length(); }
  double highest() const override { return wave_.crest(); }
  double lowest() const override { return wave_.trough(); }
  double phase(const Vec<d>& x, double t) const override;
  /// As it was made.
  const SteadyWave& wave() const { return wave_; }

 private:
  double theta(const Vec<d>& x, double t) const;

  SteadyWave wave_;
  SeaFrame<d> frame_;
};

/// A sum of linear waves, each with the speeds of Airy's theory up to the still level and as there above it, and the uniform
/// current that takes their transport back, sum g a^2 / (2 c d): tanks have walls.
template <int d>
class LinearSea final : public WaveField<d> {
 public:
  /// Frequencies of `waves` and `peak_period` [s] are those of an observer over whom the water has the speed `current` [m/s]
  /// along the waves; the field is that in the water, which stands still in its tank. `highest`: crest above the still level that
  /// is to be expected [m]. std::invalid_argument where the current stops waves.
  LinearSea(const std::vector<SeaWave>& waves, const SeaFrame<d>& frame, double peak_period, double current,
            double highest);
  double elevation(const Vec<d>& x, double t) const override;
  Vec<d> velocity(const Vec<d>& x, double t) const override;
  double length() const override { return length_; }
  double period() const override { return period_; }
  double shortest() const override;
  double highest() const override { return highest_; }
  double lowest() const override { return -highest_; }
  double phase(const Vec<d>& x, double t) const override;

 private:
  struct Component {
    Vec<d> along;                          // unit, horizontal
    double k, w, phase, amplitude, speed;  // [1/m], [rad/s], rad, [m], a w / (1 - exp(-2 k d)) [m/s]
  };
  double angle(const Component& c, const Vec<d>& from_origin, double t) const;

  SeaFrame<d> frame_;
  std::vector<Component> waves_;  // longest first
  Vec<d> current_ = Vec<d>::Zero();
  double length_, period_, highest_;
};

extern template class RegularWave<2>;
extern template class RegularWave<3>;
extern template class LinearSea<2>;
extern template class LinearSea<3>;

}  // namespace splashdown::fluid
