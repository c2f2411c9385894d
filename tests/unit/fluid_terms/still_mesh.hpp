// Nodes and cells on which one effect acts without pressure, and without a motion of the mesh.
#pragma once

#include <functional>
#include <vector>

#include "fluid/effects/effect.hpp"

namespace splashdown::fluid::testing {

template <int d>
struct StillMesh {
  Nodes<d> nodes;
  Mesh<d> mesh;
  std::vector<double> lumped_volume;
  std::vector<WallSpec<d>> walls;
  std::vector<WallPlace<d>> poses;
  double density = 1000, kick = 1e-3;
  const ModalInertia* answers = nullptr;

  void set_velocity(const std::function<Vec<d>(const Vec<d>&)>& field) {
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes.v[i] = field(nodes.x[i]);
  }
  /// What effects see of the first step.
  template <class Act>
  auto with_view(Act act) const {
    NodeCells<d> around;
    around.build(mesh.cells, nodes.size());
    const WallLayout<d> layout = WallLayout<d>::rigid(walls.size());
    return act(StepView<d>{.nodes = nodes,
                           .mesh = mesh,
                           .density = density,
                           .kick = kick,
                           .t = 0,
                           .dt = kick,
                           .dt_before = 0,
                           .lumped_volume = lumped_volume,
                           .around = around,
                           .walls = walls,
                           .poses = poses,
                           .layout = layout,
                           .answers = answers});
  }
  Wrench<d> momentum(std::span<const Vec<d>> v) const {
    Wrench<d> sum = Wrench<d>::Zero();
    for (std::size_t i = 0; i < v.size(); ++i)
      sum += wrench_of<d>(nodes.x[i], Vec<d>(density * lumped_volume[i] * v[i]));
    return sum;
  }
  double kinetic_energy(std::span<const Vec<d>> v) const {
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i) sum += 0.5 * density * lumped_volume[i] * v[i].squaredNorm();
    return sum;
  }
};

}  // namespace splashdown::fluid::testing
