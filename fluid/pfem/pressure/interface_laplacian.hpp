// Local operators in the pressure equation that stand in for the answer of a body of mass m, limited to the long
// modes of its wetted hull: K = Q^T L Q with the means over pieces of the hull
//
//   (Q phi)_I = int psi_I phi / int psi_I,   sum_I psi_I = 1
//
//   laplacian  phi^T K phi = lambda sum_{I,J} |border of I and J| / distance (mean_I - mean_J)^2,   mean = 0 beyond
//              contact lines
//   robin      phi^T K phi = alpha sum_I (int psi_I) mean_I^2
//
// The first are finite volumes for lambda int_hull |grad_s phi|^2 (Idelsohn, Del Pin, Rossi, Onate 2009; Ryzhakov,
// Rossi, Vina, Onate 2013), the second is alpha int_hull phi^2: each piece answers like a mass of its own, 1/alpha on a
// unit of hull (Badia, Nobile, Vergara 2008). Pieces psi_I overlap, linear between seeds spread over the hull. lambda and
// alpha give phi ~ n, the pressure of a translation, the energy that the body's exact answer has:
// sum_k phi_k^T K phi_k = sum_k |int phi_k n|^2 / m for phi_k = n_k. On a circle of radius a: lambda = pi a^3 / m,
// alpha = pi a / m.
#pragma once

#include <span>
#include <vector>

#include "core/response.hpp"
#include "fluid/pfem/linear/linear_solver.hpp"
#include "fluid/pfem/mesh/mesh.hpp"
#include "fluid/pfem/nodes.hpp"

namespace splashdown::fluid {

/// K = Q^T L Q of all walls with a local operator.
///
/// Two pieces a freedom of a body, whatever the mesh: the rank of K bounds the passes (docs/design-notes, where
/// other numbers are compared). Short parts of the hull that are wetted for themselves are one more.
template <int d>
class InterfaceLaplacian {
 public:
  /// `interface_operators`: of each wall. `unknown`: of a node, -1: p = 0.
  void build(const Nodes<d>& nodes, const Mesh<d>& mesh, const std::vector<int>& unknown,
             std::span<const InterfaceOperator> interface_operators);
  /// Adds K to a matrix, entries outside its pattern included.
  void add_to(SymmetricMatrix& matrix) const;
  /// Q phi.
  std::vector<double> means(std::span<const double> phi) const;
  /// r += Q^T L means.
  void add(std::span<const double> means, std::vector<double>& r) const;
  /// The pieces psi_I, in the order of the rows of Q.
  std::span<const InterfacePiece> pieces() const { return pieces_; }

 private:
  struct Share {
    int unknown;
    double weight;  // entry of Q
  };
  struct Link {
    int a, b;  // pieces; b = -1: a mean of zero
    double weight;
  };
  void cut_wall(const Nodes<d>& nodes, const Mesh<d>& mesh, const std::vector<int>& unknown, int wall,
                const InterfaceOperator& interface_operator);

  std::vector<InterfacePiece> pieces_;
  std::vector<std::vector<Share>> rows_;  // of Q
  std::vector<Link> links_;
};

extern template class InterfaceLaplacian<2>;
extern template class InterfaceLaplacian<3>;

}  // namespace splashdown::fluid
