// What moves the fluid's nodes on a wall, in the wall's general coordinates: where they are by its placement, their velocities
// by those of its coordinates, and what impulses on nodes are to it. This is all that the fluid knows of a body.
//
//   v = B(placement) s,   I = B^T i
#pragma once

#include <functional>
#include <memory>

#include "fluid/ale/mesh/flow_mesh.hpp"

namespace splashdown::ale {

/// A wall as its nodes in the fluid see it. Placements and velocities are the wall's share of coupling::Placement and
/// coupling::Velocities.
class MovingWall {
 public:
  virtual ~MovingWall() = default;
  virtual Eigen::Index coordinates() const = 0;  ///< how many velocities it has
  virtual Eigen::VectorXd first() const = 0;     ///< placement at t = 0
  /// Of the nodes [m].
  virtual Nodes positions(const Eigen::VectorXd& placement) const = 0;
  /// B: velocities of the nodes, x and y of one after the other, by those of its coordinates.
  virtual Eigen::MatrixXd basis(const Eigen::VectorXd& placement) const = 0;
  /// The placement after dt [s] with these velocities.
  virtual Eigen::VectorXd moved(const Eigen::VectorXd& placement, const Eigen::VectorXd& velocities,
                                double dt) const = 0;
  /// The rigid part of a placement, in which loads are told: about its origin, in the world frame.
  virtual Isometry<2> pose(const Eigen::VectorXd& placement) const = 0;
};

/// Makes the motion of a wall whose nodes are there at t = 0 [m].
using MakeMovingWall = std::function<std::unique_ptr<MovingWall>(const Nodes& nodes)>;

/// Of a rigid body: coordinates are its twist about the wall's reference point, the placement the first two rows of its pose,
/// by columns. `pose`: at t = 0.
MakeMovingWall rigid_wall(const Isometry<2>& pose);
/// Of a wall that deforms: coordinates are the velocities of the vertices of its surface, one after the other, the placement is
/// where they are; between them it is linear. `surface`: at t = 0, world frame [m].
MakeMovingWall deforming_wall(const Surface<2>& surface);

}  // namespace splashdown::ale
