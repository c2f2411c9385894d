// Numbers that a run is made for, with the errors that a mesh leaves in them: an adjoint weighs residuals (dual weighted
// residuals; Becker & Rannacher 2001, An optimal control approach to a posteriori error estimation, Acta Numerica 10).
#pragma once

#include <cmath>
#include <string>
#include <vector>

namespace splashdown {

/// A goal as it is told.
struct GoalValue {
  std::string name;  ///< "BODY.x", "POINT.uy", "BODY.f1"
  double value = 0;  ///< on this mesh
  double error = 0;  ///< value minus truth, as far as it is known
  std::string unit;  ///< of both
};

/// A goal with its error and where that comes from, both in the goal's unit.
struct GoalError {
  double value = 0;             ///< on this mesh
  double error = 0;             ///< value minus truth, as far as it is known
  std::vector<double> by_cell;  ///< shares of it by cells, not negative
  /// Adds what a cell's test functions find.
  void add(std::size_t cell, double share) {
    error += share;
    by_cell[cell] += std::abs(share);
  }
};

}  // namespace splashdown
