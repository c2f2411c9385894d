// Stand-ins for the fluid and the bodies: a wedge that falls into a box of water, all in closed form, so that
// the recorder can be driven without a solver. Defines the few members of Fluid and Bodies that it calls.
#pragma once

#include <memory>

#include "apps/record/recorder.hpp"

namespace splashdown::apps {

/// A wedge drop whose state is a function of time.
class StandInDrop {
 public:
  explicit StandInDrop(int nodes_across = 24);
  ~StandInDrop();
  /// The state at t_n with the step that starts there.
  const RecordInput<2>& at(double time, double dt);
  static fluid::Surface<2> hull();  ///< body frame

 private:
  std::unique_ptr<fluid::Fluid<2>> fluid_;
  std::unique_ptr<rigid::Bodies<2>> bodies_;
  RecordInput<2> input_;
  int nodes_across_;
};

/// A box that lies on a block of water in three dimensions, pressed and turned about the vertical for a while.
class StandInPress {
 public:
  explicit StandInPress(int nodes_across = 8);
  ~StandInPress();
  const RecordInput<3>& at(double time, double dt);
  static fluid::Surface<3> hull();  ///< body frame

 private:
  std::unique_ptr<fluid::Fluid<3>> fluid_;
  std::unique_ptr<rigid::Bodies<3>> bodies_;
  RecordInput<3> input_;
};

inline constexpr double press_half_length = 0.5, press_half_height = 0.25;  ///< of the box; it is square from above
/// Pressure under the box above that of the water's weight [Pa].
double press_at(double time);

inline constexpr double wedge_half_breadth = 0.25, wedge_height = 0.144, water_depth = 0.6, tank_half_width = 0.8;
inline constexpr double drop_end = 0.03;

}  // namespace splashdown::apps
