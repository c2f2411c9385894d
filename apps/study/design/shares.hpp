// Points of a unit cube for random axes: a share of [0, 1) an axis, in a plan that fills the cube better than chance.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace splashdown::apps {

/// How random axes are drawn together.
enum class Plan {
  latin_hypercube,  ///< each of n equal parts of an axis once (McKay, Beckman and Conover 1979); another n draws anew
  sobol,            ///< Sobol's sequence, shifted by the seed: a larger n continues it
  random,           ///< independent shares; a larger n continues them
  saltelli,  ///< for Sobol indices: n points A, n points B, and for each axis A with that axis of B (Saltelli 2010)
};

/// Splitmix64 (Steele, Lea and Flood 2014): the same numbers on every machine, which those of <random> need not be.
class RandomShares {
 public:
  /// A stream of its own for each name, whatever others there are (FNV-1a of the name).
  RandomShares(int seed, const std::string& name);
  std::uint64_t next();
  double share();  ///< of [0, 1)

 private:
  std::uint64_t state_ = 0;
};

/// Shares by axis, then by point. `number`: n of the plan; saltelli gives n (axes + 2) points: A, B, then A with one axis of B after the other.
std::vector<std::vector<double>> shares_of(Plan plan, int number, int seed, const std::vector<std::string>& axes);

}  // namespace splashdown::apps
