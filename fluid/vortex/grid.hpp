// A uniform Cartesian grid of squares, staggered (Harlow & Welch, Phys. Fluids 8, 1965): stream function and
// vorticity at nodes, velocities on the faces between them. With u = d psi/dy, v = -d psi/dx by differences across a
// face,
//
//   div(u, v) = 0 in each square   and   curl(u, v) = -Laplace_5 psi at each inner node
//
// hold exactly, to roundoff, with the five-point Laplacian.
#pragma once

#include <cstddef>
#include <vector>

#include "core/types.hpp"

/// A fluid on a grid: vortices in cells, penalised bodies.
namespace splashdown::vortex {

/// nx x ny squares of side h; node (i, j) lies at min + h (i, j).
struct Grid {
  Vec<2> min = Vec<2>::Zero();  ///< lower left corner [m]
  double h = 1;                 ///< side of a square [m]
  int nx = 0, ny = 0;           ///< squares in each direction

  /// Upper right corner [m].
  Vec<2> max() const { return min + h * Vec<2>(nx, ny); }
  /// Place of a node [m].
  Vec<2> node(int i, int j) const { return min + h * Vec<2>(i, j); }
  std::size_t nodes() const { return static_cast<std::size_t>(nx + 1) * static_cast<std::size_t>(ny + 1); }  ///< count
  /// Index of node (i, j), 0 <= i <= nx.
  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx + 1) + static_cast<std::size_t>(i);
  }
};

/// Numbers at the nodes, row by row.
using NodeField = std::vector<double>;

/// Numbers on faces: u between nodes (i, j) and (i, j+1), (nx+1) x ny of them; v between (i, j) and (i+1, j), nx x
/// (ny+1). Rows of both are nx+1 long, so that both are indexed like nodes; the last v of a row and the last row of u
/// are not used and zero.
struct FaceField {
  std::vector<double> u, v;  ///< along x, along y
  /// All zero.
  void reset(std::size_t nodes) {
    u.assign(nodes, 0.0);
    v.assign(nodes, 0.0);
  }
};

/// omega += factor curl f at the inner nodes [unit of f / h].
void add_curl(const Grid& grid, const FaceField& f, double factor, NodeField& omega);

/// How fast a flow is.
struct Speeds {
  double squares = 0;  ///< of velocities beyond the stream, summed over faces [m^2/s^2]
  double speed = 0;    ///< the greatest [m/s]
};

/// Velocities of a stream function, with a uniform stream: u = stream.x + d psi/dy, v = stream.y - d psi/dx; and how fast they
/// are.
Speeds velocities_of(const Grid& grid, const NodeField& psi, const Vec<2>& stream, FaceField& velocity);

/// Of velocities in a stream; the same for any number of threads.
Speeds speeds_of(const Grid& grid, const FaceField& velocity, const Vec<2>& stream);

}  // namespace splashdown::vortex
