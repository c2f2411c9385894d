// Wall seconds of a run at a refinement that was not made, from those that were.
//
//   seconds = o(nodes) + steps c(nodes)      o: setting up, frames and tables; c: of one step; nodes: their mean over the run
//
// o and c are power laws of the nodes. Their levels are those of the runs (mean of the logarithms: machines are never quite
// alone, and no single run decides); their exponents are what the runs say, held against what is usual: least squares with the
// usual exponent as one more measurement (ridge regression, Hoerl and Kennard 1970), so that two meshes, which say next to
// nothing of an exponent, do not overthrow it, and six do.
//
// Between meshes that were made nodes and steps follow power laws of refine. Beyond them nodes follow a power of what the scene's
// sizes ask for (apps/check/cost.hpp), which bends where hulls begin to hold most of them, and steps a power of refine; both begin at
// the outermost mesh, with exponents as above.
#pragma once

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/price/ladder.hpp"

namespace splashdown::apps {

/// By refine, ascending; empty: not known, nodes then grow as those of a uniform mesh.
using ExpectedNodes = std::vector<std::pair<double, double>>;

/// Of the scene at refinements from `coarsest` to `finest`, each twice the one before, as counting takes a second in space;
/// and none beyond the first whose run is guessed to take more than `seconds`.
ExpectedNodes expected_nodes(const std::filesystem::path& scene, std::vector<std::string> set, double coarsest,
                             double finest, double seconds = HUGE_VAL);

/// What an exponent usually is, and how far it is from that.
struct Usual {
  double exponent, deviation;
};

/// y = exp(level) x^exponent
struct PowerLaw {
  double level = 0, exponent = 1;
  double at(double x) const;
  /// `noise`: standard deviation of log y.
  static PowerLaw of(const std::vector<std::pair<double, double>>& points, Usual usual, double noise);
};

class RunCost {
 public:
  RunCost(const std::vector<Rung>& rungs, ExpectedNodes expected, int dimension);
  bool known() const { return !meshes_.empty(); }
  double steps(double refine) const { return quantity(refine, &Mesh::steps); }
  double nodes(double refine) const { return quantity(refine, &Mesh::nodes); }
  double node_steps(double refine) const { return steps(refine) * nodes(refine); }
  double seconds(double refine) const;

 private:
  struct Mesh {
    double refine, nodes, steps;
  };
  double expected(double refine) const;
  double quantity(double refine, double Mesh::*what) const;
  double beyond(const Mesh& last, double refine, double Mesh::*what) const;

  std::vector<Mesh> meshes_;  // of rungs, from the coarsest on
  ExpectedNodes expected_;
  double dimension_;
  PowerLaw around_, step_;
};

}  // namespace splashdown::apps
