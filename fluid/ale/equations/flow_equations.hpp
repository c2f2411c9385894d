// The Navier-Stokes equations of an incompressible fluid on a mesh that moves with velocity w, in weak form on quadratic
// triangles with linear pressure (Taylor & Hood). A step of a theta scheme from v- to v+, u = (1 - theta) v- + theta v+:
//
//   int rho phi . ((v+ - v-)/k + (u - w) . grad u - f) + 2 mu eps(u) : grad phi - p div phi = 0     on the mesh x of its middle
//   int q div v+ = 0                                                                              on the mesh of its end
//
// Rates are of nodes that move: what is constant in space is preserved whatever the mesh does (geometric conservation).
// Sides that let through bear -p n + mu dv/dn = 1/2 rho min(u . n, 0) u: "do nothing" (Heywood, Rannacher & Turek 1996), where
// the flow comes back the directional one (Braack & Mucha 2014).
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <functional>
#include <vector>

#include "fluid/ale/mesh/flow_mesh.hpp"

namespace splashdown::ale {

/// What a step is between.
struct StepFields {
  Nodes x;                                            ///< nodes in its middle [m]
  Nodes x_after;                                      ///< nodes at its end [m]
  Nodes before;                                       ///< v- [m/s]
  Nodes mesh_velocity;                                ///< w [m/s]
  double rate = 0;                                    ///< 1/k [1/s]; 0: steady
  double theta = 0.5;                                 ///< of the end among both
  std::function<Vec<2>(const Vec<2>& x)> force = {};  ///< f [m/s^2]; empty: none
};

/// Of all unknowns: velocities by nodes, then pressures by corners.
using Unknowns = Eigen::VectorXd;

/// Residuals and their derivatives.
class FlowEquations {
 public:
  /// Density [kg/m^3], dynamic viscosity [Pa s]; edges of `open` sides let through. Keeps a reference to the mesh.
  FlowEquations(const FlowMesh& mesh, double density, double viscosity, std::array<bool, side_count> open);

  /// How many unknowns there are.
  Eigen::Index size() const { return 2 * mesh_->size() + mesh_->corners; }
  /// Of a node's velocity along an axis.
  Eigen::Index velocity(int node, int axis) const { return 2 * node + axis; }
  /// Of a corner's pressure.
  Eigen::Index pressure(int corner) const { return 2 * mesh_->size() + corner; }

  /// Residuals of all equations at (v+, p): momentum by nodes [N/m], continuity by corners [m^2/s]. At nodes where velocities
  /// are given they are what acts there on the fluid from outside, minus it is the load of the fluid.
  void residual(const StepFields& fields, const Unknowns& at, Eigen::VectorXd& out) const;
  /// The same with their derivatives by (v+, p), a matrix whose pattern is always the same.
  void linearise(const StepFields& fields, const Unknowns& at, Eigen::SparseMatrix<double>& slope) const;
  /// Of what acts on open edges, mu (grad u)^T n + 1/2 rho min(u . n, 0) u, u the mean velocity of the step [W/m].
  double open_power(const StepFields& fields, const Unknowns& at) const;
  /// Whether every cell is unfolded at these nodes: the least determinant over that of the mesh as it was made.
  double least_stretch(const Nodes& x) const;
  /// Of a velocity at these nodes [J/m].
  double kinetic_energy(const Nodes& x, const Nodes& velocity) const;
  /// The same [kg/s]: its momentum.
  Vec<2> momentum(const Nodes& x, const Nodes& velocity) const;
  /// Square of the L2 norm of its divergence [m^2/s^2].
  double divergence(const Nodes& x, const Nodes& velocity) const;

 private:
  struct OpenEdge {
    std::size_t cell;
    int from, to;  // local corners, counter-clockwise
  };
  static constexpr int dofs = 15;
  using CellVector = Eigen::Matrix<double, dofs, 1>;
  using CellMatrix = Eigen::Matrix<double, dofs, dofs>;
  using CellNodes = Eigen::Matrix<double, 2, 6>;

  void add_cell(const StepFields& fields, const Unknowns& at, std::size_t cell, CellVector& R, CellMatrix* K) const;
  void add_open(const StepFields& fields, const Unknowns& at, const OpenEdge& edge, CellVector& R, CellMatrix* K) const;
  std::array<Eigen::Index, dofs> numbers(const Cell& cell) const;
  CellNodes of(const Nodes& field, const Cell& cell) const;
  CellNodes velocities(const Unknowns& at, const Cell& cell) const;
  void make_pattern();

  const FlowMesh* mesh_;
  double density_, viscosity_;
  std::vector<OpenEdge> open_;
  Eigen::SparseMatrix<double> pattern_;
  std::vector<std::array<int, dofs * dofs>> places_;  // of each cell's entries in the pattern
  std::vector<double> first_volume_;                  // determinant in the middle of each cell as it was made
};

}  // namespace splashdown::ale
