// A catenary whose fairlead moves, as pulls of a step. Internal to the rigid-body room.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <vector>

#include "rigid/constraints/pull.hpp"
#include "rigid/lines/catenary.hpp"

namespace splashdown::rigid {

/// Force on the fairlead's end of the line and its slope, world frame; the last axis points up.
template <int d>
struct AnchoredEnd {
  Vec<d> force = Vec<d>::Zero();      ///< on the line, away from the anchor [N]
  Mat<d> stiffness = Mat<d>::Zero();  ///< symmetric, not negative [N/m]
};

/// Of a fairlead that is `offset` from the anchor [m].
template <int d>
AnchoredEnd<d> anchored_end(const CatenarySpec& line, const Vec<d>& offset);

/// A step of a fairlead at an offset from the anchor at t_n, with its velocity at t_{n-1/2}.
template <int d>
struct FairleadStep {
  Vec<d> offset, velocity;  ///< [m, m/s]
  double kick, dt;          ///< [s]
};

/// Pulls along directions of the world; `along(n)` is the condition whose rate is the fairlead's velocity along n. With p_- and
/// p_+ at the middles of the steps before and after t_n,
///
///   J = kick [F(p_-) + S (p_+ - p_-)/2]
///
/// S is the slope at p_-, or where the line stiffens that with the secant to the place to which the velocity carries the fairlead
/// (the symmetric update of Broyden, Fletcher, Goldfarb, Shanno 1970): a line that comes taut within a step takes at least what
/// it stores. Along the stiffest direction it only pulls.
template <int d, class Along>
std::vector<Pull<d>> catenary_pulls(const CatenarySpec& line, const FairleadStep<d>& step, const Along& along);

/// S of such a step, and the force at p_-.
template <int d>
AnchoredEnd<d> stepped_end(const CatenarySpec& line, const FairleadStep<d>& step);

template <int d, class Along>
std::vector<Pull<d>> catenary_pulls(const CatenarySpec& line, const FairleadStep<d>& step, const Along& along) {
  const AnchoredEnd<d> end = stepped_end(line, step);
  const double dt_before = 2 * step.kick - step.dt;
  const Eigen::SelfAdjointEigenSolver<Mat<d>> own(end.stiffness);
  std::vector<Pull<d>> all;
  for (int i = 0; i < d; ++i) {
    const double stiffness = std::max(own.eigenvalues()[i], 0.0);
    Vec<d> n = own.eigenvectors().col(i);
    if (n.dot(end.force) < 0) n = -n;
    const double force = n.dot(end.force) + stiffness * dt_before / 4 * n.dot(step.velocity);
    if (stiffness == 0 && force == 0) continue;
    const bool stiffest = i == d - 1 && stiffness > 0;
    all.push_back({along(n), step.kick * force, step.kick * stiffness * step.dt / 4, stiffest});
  }
  return all;
}

}  // namespace splashdown::rigid
