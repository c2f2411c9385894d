// What people look at in bodies that deform: all that they look at in bodies (their frames: the rotation that fits the nodes
// best, about the centre of mass), and strain, stress and displacements, at t_n.
#pragma once

#include <string>
#include <vector>

#include "core/bodies_view.hpp"
#include "core/diagnostic.hpp"
#include "core/goals/goal.hpp"

namespace splashdown {

/// How a body is deformed and what it holds. Two-dimensional energies are per metre of depth.
template <int d>
struct Deformation {
  double strain_energy = 0;     ///< in the middle of the last step where a fluid is around [J, J/m]
  double kinetic_energy = 0;    ///< likewise: what the fluid's work has made of both [J, J/m]
  double potential_energy = 0;  ///< of its weight, against the undeformed place at t = 0 [J, J/m]
  double dissipated = 0;        ///< by its damping so far where a fluid is around [J, J/m]
  double clamp_work = 0;        ///< of moving clamps so far [J, J/m]
  double von_mises = 0;         ///< the largest [Pa]
  double von_mises_error = 0;   ///< of it: what elements and their neighbours disagree about there [Pa]
  Vec<d> at = Vec<d>::Zero();   ///< where that is, in the undeformed body at t = 0, world frame [m]
  std::string part = {};        ///< name of the part there; empty: none of them
  std::size_t nodes = 0;        ///< of its mesh
  std::size_t cells = 0;        ///< of its mesh
};

/// The surface of a body as it is deformed, with what is known at its vertices.
template <int d>
struct DeformedSurface {
  Surface<d> surface;                ///< world frame [m]
  std::vector<Vec<d>> displacement;  ///< against t = 0 [m]
  std::vector<Vec<d>> v;             ///< velocities [m/s]
  std::vector<Mat<3>> stress;        ///< Cauchy's, mean of the elements around of one material [Pa]
  std::vector<double> von_mises;     ///< of that mean [Pa]
};

/// The bodies in the order of the scene; an index beyond the last throws std::out_of_range.
template <int d>
class SolidsView : public BodiesView<d> {
 public:
  virtual const Twist<d>& velocity_n(std::size_t body) const = 0;      ///< at t_n: momenta over mass and inertia
  virtual const Twist<d>& acceleration_n(std::size_t body) const = 0;  ///< at t_n: their rates, likewise
  virtual Deformation<d> deformation(std::size_t body) const = 0;      ///< at t_n
  virtual DeformedSurface<d> deformed(std::size_t body) const = 0;     ///< at t_n
  /// Of named points at t_n, what is looked at there, always of the same names: NAME.ux displacement [m], NAME.vx velocity
  /// [m/s], NAME.ax acceleration [m/s^2], NAME.exx Green's strain, all along the world's axes.
  virtual std::vector<Diagnostic> signals() const = 0;
  /// What it was asked for, with its errors at t_n: costs more than a step.
  virtual std::vector<GoalValue> goals() const { return {}; }
};

}  // namespace splashdown
