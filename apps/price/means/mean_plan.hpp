// How many runs of each size of mesh a mean takes: the cheapest that brings its band down to what is wanted.
//
//   band of the mean of N runs = sqrt(U^2 + (t s / sqrt(N))^2)     U: of the fit (convergence.hpp); t: Student's, N - 1 degrees of freedom
//
// The mean has the bias alpha h^p of its size, which means of other sizes tell: phi_0 = sum_l a_l m_l with the weights of the fit, and
//
//   var(phi_0) = sum_l a_l^2 s_l^2 / N_l,   cost = sum_l N_l c_l,   least for   N_l ~ |a_l| s_l / sqrt(c_l)
//
// the allocation of multilevel Monte Carlo (Giles 2008, Oper. Res. 56, 607-617, section 1.3). Its telescoped sum itself gains nothing
// here: differences of levels that share no random numbers, as two meshes do, have the variance s_l^2 + s_(l-1)^2. Runs are
// added in portions, each where it narrows the band most a second: at the optimum all gain the same.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "apps/price/bayesian_extrapolation.hpp"
#include "apps/study/design/replicates.hpp"

namespace splashdown::apps {

/// Fewer say too little of their own scatter: Student's t of three runs is more than twice that of many.
inline constexpr int fewest_of_mean = 4;
/// Of one size, meshes that are told apart and lie within 3 % of it (ladder.hpp).
inline constexpr int most_of_size = most_replicates + 1;  // the mesh itself

struct SizeOfMesh {
  double h;        ///< relative
  double seconds;  ///< of a run
  int made = 1;    ///< runs that are there already
};

struct MeanPlan {
  std::size_t mean = 0;          ///< the size whose runs are the mean
  std::vector<RunsOfSize> runs;  ///< of each size, those that are there included
  double seconds = 0;            ///< of the runs of the mean, and of those of other sizes beyond what was there
  double missing_seconds = 0;    ///< of all that are not there
  double band = 0;               ///< expected, in the unit of the forecast
};

/// The half-width that Student's t gives the mean of runs with this standard deviation, with 95 %.
double band_of_scatter(double deviation, int runs);

/// The band expected of the mean of the runs of one of the sizes; infinite: not known.
using BandOfMean = std::function<double(std::span<const RunsOfSize>, std::size_t mean)>;

/// Plans of falling band for the mean of each size, from the runs that are there on, each with more runs than the one before, until the
/// band is `tightest` or there are no more meshes.
std::vector<MeanPlan> mean_plans(std::span<const SizeOfMesh> sizes, const BandOfMean& band, double tightest);
/// Of these the one that takes the least seconds, all or those that are missing; null: none has the band.
const MeanPlan* cheapest(std::span<const MeanPlan> plans, double wanted, double MeanPlan::*seconds);

/// Where a ladder stands that is to reach a band.
struct LadderState {
  std::vector<SizeOfMesh> sizes;    ///< from the coarsest on
  std::optional<SizeOfMesh> finer;  ///< the next that may be made
  double single_seconds =
      HUGE_VAL;  ///< to the mesh of which a single run is expected to have the band, through those before it
  double seconds_since_finer = 0;  ///< of runs beside those of the ladder since its last mesh
};

struct NextRuns {
  std::size_t size = 0;  ///< of `sizes`; their number: the finer one
  int runs = 1;
};

/// What to make next for a band that nothing has yet: the mesh or the mean that takes the fewest seconds to it. If neither is expected to
/// get there, runs that narrow the band most, for as long as the next finer mesh would take, then that: at most twice the better
/// of the two. Cheap runs of coarse meshes go first, as they may change the plan. Nothing: no mesh is left.
std::optional<NextRuns> next_runs(const LadderState& state, const BandOfMean& band, double wanted);

}  // namespace splashdown::apps
