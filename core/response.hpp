// How a structure answers impulses, in generalised coordinates: what structure, coupling and fluid say to each other about it.
//
//   s = s_free + Z y,   y = W w,   W'^T (M y - Z^T I - I_known) = 0
//
// s: generalised velocities of all walls, one below the other (of a rigid wall its twist, world frame) [m/s, rad/s, ...];
// I: the impulses on them, so that s . I is work [N s, N m s, ...; 2D: per metre of depth]. Nothing divides by M.
// The reduced equation of a system with constraints (Shabana, Dynamics of Multibody Systems, sections 3.4 and 5.4).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace splashdown {

/// Velocities that ties leave, s = Z y, and their inertia.
struct ModalInertia {
  Eigen::MatrixXd modes;    ///< Z: one mode a column, all walls' coordinates below each other; empty: none
  Eigen::MatrixXd inertia;  ///< M = Z^T M_s Z: symmetric, positive semidefinite, may be singular [kg, kg m, kg m^2]
};

/// What closed contacts leave of the modes.
struct ClosedContacts {
  Eigen::MatrixXd directions = {};  ///< W: only y = W w may occur; without it and `known`: all y
  Eigen::VectorXd known = {};  ///< impulses on the modes besides the fluid's that s_free does not contain; empty: none
  /// W': Newton's law is asked for along these, as many as W has: contacts that slide and rub do no work in them. Empty: W.
  Eigen::MatrixXd workless = {};

  /// Whether closed contacts leave less than all y, or add impulses of their own.
  bool restrict_modes() const { return directions.size() > 0 || known.size() > 0; }
  /// W W^T y where W is given, else y.
  Eigen::VectorXd allowed(const Eigen::VectorXd& y) const {
    return restrict_modes() ? Eigen::VectorXd(directions * (directions.transpose() * y)) : y;
  }
};

/// A structure's answer in a begun step, with the contacts that are closed at the moment.
struct Response {
  Eigen::VectorXd free;     ///< s_free: velocities without the fluid's impulse
  ModalInertia modal;       ///< Z and M
  ClosedContacts contacts;  ///< W and the known impulses
};

/// Inverse masses of a local operator on a wall that stands in for the answer of the body behind it [1/kg; 2D: m/kg]; 0: none.
struct InterfaceOperator {
  double laplacian = 0;  ///< of the Laplacian (coupling/interface_term.hpp)
  double robin = 0;      ///< of a mass for each piece of the wall
};

/// What the fluid's own equations know of the structure during a step.
struct InterfaceModel {
  ModalInertia modal = {};                                  ///< the exact term M + Z^T B A^-1 B^T Z; no modes: none
  std::vector<InterfaceOperator> interface_operators = {};  ///< of each wall; empty: none at all
};

/// Piece of a wetted wall with a local operator.
struct InterfacePiece {
  std::size_t wall;  ///< index of the wall
  double measure;    ///< length or area [m, m^2]
};

}  // namespace splashdown
