// Runs that bring a ladder to a band: finer meshes, or more runs on meshes of the sizes that it has, whose mean scatters less.
#pragma once

#include <functional>
#include <vector>

#include "apps/price/price.hpp"

namespace splashdown::apps {

/// Makes one more run on a mesh of this size, of replicates not tried before. Nothing: there are no more, or the ladder has to end.
class Replicates {
 public:
  explicit Replicates(Ladder& ladder) : ladder_(ladder) {}
  /// Whether a run was made.
  bool add(double refine, const std::vector<Rung>& made);

 private:
  Ladder& ladder_;
  std::vector<double> tried_;
};

struct BandWanted {
  double accuracy = 0;           ///< relative, of all quantities that count
  std::vector<double> finer;     ///< meshes that may follow the ladder, from the coarsest on
  std::function<Price()> price;  ///< of what is made
  bool by_mean = false;          ///< single runs do not count
};

/// Until a mesh or a mean has the accuracy, as `next_runs` has it, as the budget allows.
void climb_to(Ladder& ladder, const BandWanted& wanted);

}  // namespace splashdown::apps
