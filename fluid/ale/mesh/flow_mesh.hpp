// The mesh of a plane fluid that fills a box around bodies: quadratic triangles (core/simplices/quadratic.hpp) by Delaunay
// refinement (Shewchuk 2002, in CGAL), curved at hulls. Velocities live at all nodes, pressures at corners (Taylor & Hood 1973).
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "core/simplices/split.hpp"

/// An incompressible viscous fluid between sides and moving bodies, in an arbitrary Lagrangian-Eulerian frame.
namespace splashdown::ale {

/// Places or velocities of nodes, a column each.
using Nodes = Eigen::Matrix2Xd;
/// Nodes of a triangle: corners, then middles of `cell_edges`.
using Cell = std::array<int, cell_nodes<2>>;

/// Sides of the box, in this order.
enum Side { left, right, bottom, top };
inline constexpr int side_count = 4;

/// An edge of the boundary; the fluid lies to its left.
struct BoundaryEdge {
  std::array<int, 3> nodes;         ///< ends, middle
  int wall = -1;                    ///< index of the body's wall, -1: none
  int side = -1;                    ///< of the box, -1: none
  int line = -1;                    ///< index of the outline that it lies on, -1: none
  std::array<double, 3> arcs = {};  ///< of the nodes along it [m]
};

/// Triangles between the box and the hulls.
struct FlowMesh {
  Nodes nodes;      ///< corners of triangles come first [m]
  int corners = 0;  ///< how many nodes are corners
  std::vector<Cell> cells;
  std::vector<BoundaryEdge> boundary;
  /// Number of nodes.
  int size() const { return static_cast<int>(nodes.cols()); }
};

/// A body in the box.
struct Hole {
  Surface<2> outline;  ///< world frame [m]; counter-clockwise
  double size = 0;     ///< longest element edge on it [m]
};

/// Where there is fluid, and how large elements are: min(far, size at hulls + growth times the distance).
struct MeshSpec {
  Vec<2> min, max;          ///< corners of the box [m]
  double far = 0;           ///< longest edge [m]
  double growth = 0.15;     ///< dh/dx
  std::vector<Hole> hulls;  ///< inside of the box; those that overlap are one hole
  double corner = 1;        ///< size at corners of hulls that jut into the fluid, over that on the hull
  std::function<double(const Vec<2>&)> size = {};  ///< longest edge at a place besides [m]; empty: no other bound
  double corner_angle = 30;                        ///< turns of an outline by more are corners, others are curves [deg]
};

class HullLine;

/// Throws std::invalid_argument for hulls that cross the box or each other without sharing area.
FlowMesh flow_mesh(const MeshSpec& spec);
/// The same around outlines that are divided already (hull_line.hpp).
FlowMesh flow_mesh(const MeshSpec& spec, const std::vector<HullLine>& lines);

/// A mesh after, and where its nodes lie before.
struct DividedMesh {
  FlowMesh mesh;
  std::vector<SplitCells<2>::At> places;  ///< of its nodes in the mesh before
};
/// Each triangle divided into four, the boundary with it; what is quadratic before is so after.
DividedMesh divided(const FlowMesh& mesh);

}  // namespace splashdown::ale
