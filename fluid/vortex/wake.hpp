// A wake that leaves the grid. Cut off, its vortices would pull at the body by turns; faded out, the slow fluid in it would end
// like in a sink, which speeds the stream up by C_D D/(4 pi L) of it at a distance L. So towards a side that the stream leaves by
// vorticity turns into its mean along the stream,
//
//   omega <- s omega + (1 - s) m(y),   m = int omega (-ds/dx) dx,   s = 1 ... 0 on the last part of the way,
//
// which carries what the wake carries on the average, and this mean goes on without end beyond the side: there
//
//   psi(a, b) = 1/(2 pi) int m(y') (a log r - a - b atan2(b, a)) dy',   a to the side, b = y - y', r^2 = a^2 + b^2.
#pragma once

#include <array>
#include <vector>

#include "fluid/vortex/grid.hpp"
#include "fluid/vortex/poisson/far_field.hpp"

namespace splashdown::vortex {

/// What velocities are of, where vorticity leaves a grid.
class Wake {
 public:
  /// Of this grid.
  explicit Wake(const Grid& grid) : grid_(grid) {}
  /// Gives a vorticity its wake's end. `reach`: how far before a side each way the turn begins [m], positive towards the
  /// far side, negative towards the near one, zero where there is none.
  void end(NodeField& omega, const Vec<2>& reach);
  /// Of what goes on beyond the grid, on its sides; null: nothing does.
  const Sides* beyond() const { return goes_on_ ? &sides_ : nullptr; }

 private:
  static constexpr std::size_t strips = 32;  // of the mean beyond a side
  struct Exit {                              // psi on the sides of a strip's vorticity, strip by strip
    std::vector<Sides> of_strip;
  };
  void turn(NodeField& omega, int axis, double reach);
  void go_on(int axis, bool at_end, const std::vector<double>& mean);
  const Exit& exit(int axis, bool at_end);

  Grid grid_;
  Sides sides_;
  bool goes_on_ = false;
  std::array<Exit, 4> exits_;
};

}  // namespace splashdown::vortex
