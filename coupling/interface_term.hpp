// What the fluid's pressure equation knows about a body: the interface term.
//
// The body answers a pressure impulse phi on its hull with s = s~ + C B phi, C = M_b^-1. Seen from the
// fluid this adds B^T C B phi to the pressure equation (derivation, scaling and signs: docs/design-notes).
//
//   rigid      B^T C B itself: exact, symmetric positive semidefinite, of low rank; the stepper Simultaneous
//   laplacian  a local stand-in, a Laplacian of the long modes of phi on the hull (Idelsohn, Del Pin, Rossi,
//              Onate 2009; Ryzhakov, Rossi, Vina, Onate 2013); needs passes
//   robin      another one, a mass for each piece of the hull (Badia, Nobile, Vergara 2008); needs passes
//   none       plain Dirichlet-Neumann: a pass amplifies the error by about M_a / m
#pragma once

#include <string>

#include "coupling/participant.hpp"

namespace splashdown::coupling {

/// A stand-in for the body's answer, which the stepper Partitioned removes pass by pass.
class InterfaceTerm {
 public:
  virtual ~InterfaceTerm() = default;
  virtual std::string name() const = 0;  ///< as scenes call it
  /// Of a wall; none for one that does not answer.
  virtual InterfaceOperator interface_operator(const WallCoordinates& wall) const = 0;
};

/// No stand-in: plain Dirichlet-Neumann.
class NoTerm final : public InterfaceTerm {
 public:
  std::string name() const override { return "none"; }
  InterfaceOperator interface_operator(const WallCoordinates&) const override { return {}; }
};

/// A Laplacian with lambda = strength / m on the wetted hull. Scaling and pieces: fluid/pfem/pressure/interface_laplacian.hpp.
class LaplacianTerm final : public InterfaceTerm {
 public:
  /// `strength` [-]: factor of lambda; with 1 the energy of a translation is exact.
  explicit LaplacianTerm(double strength = 1) : strength_(strength) {}
  std::string name() const override { return "laplacian"; }
  InterfaceOperator interface_operator(const WallCoordinates& wall) const override {
    return {.laplacian = wall.answers ? strength_ / wall.mass : 0};
  }

 private:
  double strength_;  ///< 1: the energy of a translation is exact
};

/// Robin-Neumann: each piece of the hull answers like a mass of its own (Badia, Nobile, Vergara 2008; Astorino, Chouly,
/// Fernandez 2010). Scaling and pieces: fluid/pfem/pressure/interface_laplacian.hpp.
class RobinTerm final : public InterfaceTerm {
 public:
  std::string name() const override { return "robin"; }
  InterfaceOperator interface_operator(const WallCoordinates& wall) const override {
    return {.robin = wall.answers ? 1 / wall.mass : 0};
  }
};

}  // namespace splashdown::coupling
