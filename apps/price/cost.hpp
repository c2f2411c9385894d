// Wall seconds of a run at a refinement that was not made, from those that were.
//
//   seconds = setting up (mean of the runs) + b node-steps,   b = sum (seconds - setting up) / sum node-steps
//
// Node-steps follow refine by power laws from mesh to mesh. Beyond the finest and the coarsest they are nodes times steps: nodes
// in proportion to what the scene's sizes ask for (apps/check/cost.hpp), which bends where hulls begin to hold most of them; steps
// by the power law that fits those of all meshes. Machines are never quite alone: all runs
// decide together, and the finest, which is most like those to come, most.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/price/ladder.hpp"

namespace splashdown::apps {

/// By refine, ascending; empty: not known, nodes then go on as node-steps do.
using ExpectedNodes = std::vector<std::pair<double, double>>;

/// Of the scene at refinements from `coarsest` to `finest`, each twice the one before: counting takes a second in space.
ExpectedNodes expected_nodes(const std::filesystem::path& scene, std::vector<std::string> set, double coarsest,
                             double finest);

class RunCost {
 public:
  RunCost(const std::vector<Rung>& rungs, ExpectedNodes expected, int dimension);
  bool known() const { return !meshes_.empty(); }
  double node_steps(double refine) const;
  double seconds(double refine) const;

 private:
  struct Mesh {
    double refine, node_steps, steps;
  };
  double beyond(const Mesh& last, double refine) const;

  std::vector<Mesh> meshes_;  // of rungs, from the coarsest on
  ExpectedNodes expected_;
  double dimension_, overhead_ = 0, per_node_step_ = 0, step_exponent_ = 1;
};

}  // namespace splashdown::apps
