// What moves in time, whatever it is made of: M a + C v + f(u) = F(t) with displacements u, velocities v and C by Rayleigh,
//
//   C = alpha M + beta K(u),   K = df/du.
//
// Some unknowns are held: they keep the displacement that they have, and what is asked of the others leaves them out.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "core/types.hpp"

namespace splashdown::elastic {

/// Displacements, velocities or forces, d entries a node.
using Field = Eigen::VectorXd;
/// Symmetric, both halves stored.
using Sparse = Eigen::SparseMatrix<double>;

/// A system with a mass, a force and held unknowns.
class System {
 public:
  virtual ~System() = default;
  /// M, without changes for held unknowns [kg; 2D: kg/m].
  virtual const Sparse& mass() const = 0;
  /// f(u) [N, N/m]; not finite where u cannot be.
  virtual Field internal_force(const Field& u) const = 0;
  /// K(u) = df/du [N/m, N/m^2], in the pattern of the mass.
  virtual void stiffness(const Field& u, Sparse& K) const = 0;
  /// Whether f = K u with one K.
  virtual bool linear() const { return false; }
  /// Strain energy, f = dU/du [J, J/m].
  virtual double strain_energy(const Field& u) const = 0;
  /// A length that displacements are small or large against [m].
  virtual double length() const = 0;
  /// Number of unknowns.
  Eigen::Index size() const { return mass().rows(); }
  /// Unknowns that are held; the others are free.
  const std::vector<bool>& held() const { return held_; }
  /// Holds an unknown.
  void hold(Eigen::Index unknown) { held_.at(static_cast<std::size_t>(unknown)) = true; }

 protected:
  std::vector<bool> held_;
};

/// Rows and columns of held unknowns become `diagonal` times those of the identity.
void leave_out(const std::vector<bool>& held, double diagonal, Sparse& matrix);
/// Entries of held unknowns become zero.
void leave_out(const std::vector<bool>& held, Field& field);

}  // namespace splashdown::elastic
