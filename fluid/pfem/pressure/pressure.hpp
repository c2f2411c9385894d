// The pressure equation on the mesh of t_n, for impulses phi = kick * p [Pa s]:
//
//   int grad q . grad phi / rho  + surface(q, phi)  [+ q B^T Z M^-1 Z^T B phi]  [+ q K phi]  =  r(q)
//
// r is the volume that a motion would create (per time):
//
//   flux form    r(q) = int grad q . v - int_wall q w.n - int_surface q v.n   walls through their flux
//   motion form  r(q) = - int q div u                       u = actual displacement / dt, walls included
//                       + int_slides q (u - w).n
//
// Facets that slide along a curved wall are chords of it, and longer ones reach deeper into it: not the water's
// motion, and the next node on the chord takes it back. There the wall's flux counts. Both are evaluated at the
// middle of the motion, where they are the exact change of volume in 2D.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/dense.hpp"
#include "core/response.hpp"
#include "fluid/pfem/linear/assembly.hpp"
#include "fluid/pfem/linear/linear_solver.hpp"
#include "fluid/pfem/mesh/mesh.hpp"
#include "fluid/pfem/nodes.hpp"
#include "fluid/pfem/pressure/held_mass.hpp"
#include "fluid/pfem/pressure/interface_laplacian.hpp"
#include "fluid/pfem/pressure/mass_sweep.hpp"
#include "fluid/pfem/wall_place.hpp"

namespace splashdown::fluid {

/// Whether any mode moves this wall.
template <int d>
bool moves_wall(const ModalInertia& modal, const WallLayout<d>& layout, std::size_t wall) {
  return modal.modes.cols() > 0 && !modal.modes.middleRows(layout.first(wall), layout.count(wall)).isZero(0);
}
/// Of each wall 1 where a mode moves it, else 0.
template <int d>
std::vector<char> walls_that_answer(const ModalInertia& modal, const WallLayout<d>& layout) {
  std::vector<char> out(layout.walls());
  for (std::size_t w = 0; w < out.size(); ++w) out[w] = moves_wall<d>(modal, layout, w);
  return out;
}

/// Volume of a node over the free surface around it to the power d/(d-1) below which it is the tip of a spike and carries
/// no pressure; 0.43 on a flat surface in 2D.
inline constexpr double lightest_on_surface = 0.1;

/// Passes that bring a solution of A to one of K, the volume that an impulse really takes out (conjugate_residual.hpp). With
/// fewer in 2D roundoff on still water grows (docs/design-notes).
template <int d>
inline constexpr int corrections = d == 2 ? 10 : 4;

/// The consistent mass over the lumped one is 1 - z in a mode, z from 0 to this: waves of two elements.
template <int d>
inline constexpr double shortest = (d + 1.0) / (d + 2.0);
/// Stands for 1 / (1 - z): equal to it at z = 0 in value and slope, and at the middle, z = 1/2; within 4 % up to there.
inline constexpr double inverse_mass(double z) { return 1 + z + 2 * z * z; }

/// Which nodes of the free surface have a pressure of their own: all, or all but spikes and thin contact lines.
enum class SurfaceUnknowns { without_spikes, all };

/// Matrix, factor and residuals of one step. World frame; unknowns are the nodes with a pressure of their own.
///
/// q and phi are linear. On the free surface p = 0 is the natural condition of the momentum equation: impulses
/// there push on the surface, and the volume around a surface node is kept like any other's. Held to zero,
/// surface nodes change their volume, hence their weight, and waves get an error of first order (docs/theory.md).
/// With A_i the free area vector of node i, m_i its lumped mass and g_i(phi) its averaged gradient:
///
///   surface(q, phi) = sum_i - q_i A_i . g_i(phi) - phi_i A_i . g_i(q) + 2 n_i q_i phi_i sum_f |A_f / d|^2 / m_i
///
/// n_i facets f around node i. So the matrix bounds D M^-1 D^T, which the corrections solve, from above. Spikes and contact
/// lines keep phi = 0; in 3D steep contact lines do not.
/// B_kJ = int_wall N_J (rigid mode k).n dA, n out of the fluid: load on the body f = B p, flux = B^T s.
/// Bodies that the equation solves for, s = s_0 + Z y with M y = Z^T B phi + e, are of low rank and eliminated on the
/// factor (Woodbury):
///
///   y = (M + G)^-1 (Z^T B phi_0 + e),   phi = phi_0 - Y y,   Y = A^-1 B^T Z,   G = Z^T B Y = added mass
///
/// No M is inverted: the water's inertia is enough (docs/theory.md). Nodes that move with a wall add their mass to M and their
/// part of the load, R, to B on the body's side (held_mass.hpp).
template <int d>
class PressureEquation {
 public:
  /// `on_surface`: the same on all meshes.
  explicit PressureEquation(SurfaceUnknowns on_surface = SurfaceUnknowns::without_spikes) : on_surface_(on_surface) {}
  /// Assembles and factors the matrix at t_n; nodes and mesh must outlive its use. `density` [kg/m^3]; `places`:
  /// of the walls; `structure`: of all walls, whose coordinates stand as in `layout`; `held`: nodes whose mass moves with walls.
  /// False if the factor fails.
  bool build(const Nodes<d>& nodes, const Mesh<d>& mesh, double density, std::span<const WallPlace<d>> places,
             const WallLayout<d>& layout, const InterfaceModel& structure, std::vector<HeldNode<d>> held = {});
  /// Restricts the motions to y = directions w, w of any size, with Newton's law asked for in as many `workless` ones:
  /// workless^T (M + G) directions w = workless^T impulse. Empty ones: the same. All are allowed after build.
  void allow(const Eigen::MatrixXd& directions, const Eigen::MatrixXd& workless = {});

  /// Terms of effects, in place of those before; empty: none. `diagonal`: C, not negative; `source`: q, both an entry a node
  /// (PressureTerms). A diagonal costs a further factor. False if that fails.
  bool set_terms(std::span<const double> diagonal, std::span<const double> source);
  /// The source alone.
  void set_source(std::span<const double> source) { source_ = of_unknowns(source); }
  /// r += q: the right-hand side for impulses that start from zero.
  void add_sources(std::vector<double>& r) const;
  /// r += q - C phi: what impulses phi leave of it.
  void add_sources(std::vector<double>& r, std::span<const double> phi) const;

  /// r in flux form at positions `x` [m], for velocities of nodes v [m/s] and of walls s at `places`: an entry an unknown
  /// [m^d/s].
  void flux_residual(std::span<const Vec<d>> x, std::span<const Vec<d>> v, std::span<const WallVelocity<d>> s,
                     std::span<const WallPlace<d>> places, std::vector<double>& r) const;
  /// r in motion form at positions `x` [m] for displacement velocities u [m/s].
  void motion_residual(std::span<const Vec<d>> x, std::span<const Vec<d>> u, std::vector<double>& r) const;
  /// Adds what the motion form owes to boundary facets that slide along their wall; s, `places`: as above.
  void slide_residual(std::span<const Vec<d>> x, std::span<const Vec<d>> u, std::span<const WallVelocity<d>> s,
                      std::span<const WallPlace<d>> places, std::span<const int> slides, std::vector<double>& r) const;

  /// r -= sum_e theta_e int_e grad q . (change + grad phi / rho): PSPG, for impulses phi and the change of nodal velocities
  /// that they have made [m/s]; `theta`: of cells.
  void stabilise(std::span<const double> phi, std::span<const Vec<d>> change, std::span<const double> theta,
                 std::vector<double>& r) const;

  /// Solves in place for walls that stand still; `respond` lets those that do not move. `tolerance`: of the residual over
  /// r, for large systems, which are solved iteratively: from `guess`, what phi is about after `respond`, and the
  /// motions that fit it best.
  bool solve(std::vector<double>& r, double tolerance = 1e-8, std::vector<double> guess = {});
  /// Lets the motions answer to impulses phi that held bodies would get, and to a further impulse on them: changes
  /// phi, adds to the walls' velocities, and returns y.
  Eigen::VectorXd respond(std::vector<double>& phi, std::span<WallVelocity<d>> s, const Eigen::VectorXd& further) const;
  /// (M + G)^-1 impulse, in the directions allowed: what such an impulse changes in the motions.
  Eigen::VectorXd response(const Eigen::VectorXd& impulse) const;
  /// Number of modes, columns of Z.
  int mode_count() const { return static_cast<int>(structure_.modal.modes.cols()); }
  /// Z and M as they were given to build.
  const ModalInertia& modal() const { return structure_.modal; }
  const Eigen::MatrixXd& modes() const { return structure_.modal.modes; }      ///< Z
  const Eigen::MatrixXd& inertia() const { return structure_.modal.inertia; }  ///< M, of the motions alone
  /// Z^T I of impulses on all walls [N s, N m s].
  Eigen::VectorXd on_modes(std::span<const WallImpulse<d>> impulses) const;
  /// The nodes whose mass moves with walls.
  const HeldMass<d>& held() const { return held_; }
  /// Adds Z y to the walls' velocities.
  void move(const Eigen::VectorXd& y, std::span<WallVelocity<d>> s) const;
  /// The local operators K.
  const InterfaceLaplacian<d>& laplacian() const { return laplacian_; }

  /// v -= M^-1 (int N grad phi - int_surface N phi n), M^-1 = (1 + z + 2 z^2) M_L^-1, z = 1 - M_L^-1 M_C: lumped mass M_L and
  /// two sweeps towards the consistent one M_C (`inverse_mass`).
  void accelerate(std::span<const double> phi, std::span<Vec<d>> v) const;
  /// Impulses f = kick p of the air on the free surface [Pa s], an entry a node, continued into the water: any continuation is
  /// right, phi is the rest. This one is smooth near the surface.
  std::vector<double> continued(std::span<const double> surface_impulse) const;
  /// What impulses F with p = F on the free surface do: v -= M^-1 int N grad F; adds B F to the walls at `places`.
  void push(std::span<const double> impulse, std::span<Vec<d>> v, std::span<const WallPlace<d>> places,
            std::span<WallImpulse<d>> on_walls) const;
  /// Kinetic energy of the liquid [J; 2D: per metre] with the mass that `accelerate` moves, M = M_L (1 + z + 2 z^2)^-1: short
  /// waves are up to `inverse_mass(shortest<d>)` times lighter than with lumping, and an impulse gives them as much more
  /// velocity.
  double kinetic_energy(std::span<const Vec<d>> v) const;
  /// B phi of a wall: impulse on the body.
  WallImpulse<d> impulse(std::size_t wall, std::span<const double> phi) const;
  std::vector<WallImpulse<d>> impulses(std::span<const double> phi) const;  ///< of all walls
  /// G = Z^T B A^-1 B^T Z: the motions' added mass.
  const Eigen::MatrixXd& added_mass() const { return added_mass_; }
  /// Slope of a solve: what twists of walls and impulses that Laplacians lag on change in the walls' impulses and in
  /// the means,  d(B phi, Q phi) / d(s, m) = (B; Q) (A + K)^-1 (-B^T, Q^T L). NaN if a solve fails.
  Eigen::MatrixXd interface_slope(std::span<const std::size_t> walls);
  /// G = (B + R) X + M_h [kg, kg m, kg m^2; 2D: per metre] of any walls together, about their reference points, in the world
  /// frame, whatever answers they have in this equation. X solves A X = B^T - D w, w the motion of nodes that are held, and
  /// gets the corrections of a step, so that this is the inertia which bodies meet in it. NaN if a solve fails.
  Eigen::MatrixXd added_mass_of(std::span<const std::size_t> walls);

  /// Number of unknowns.
  int size() const { return static_cast<int>(node_.size()); }
  const std::vector<int>& unknown() const { return unknown_; }       ///< of a node, -1: phi = 0
  std::span<const double> lumped_volume() const { return lumped_; }  ///< of nodes [m^d]
  /// Mass of nodes over the density at t = 0 [m^d]; of incompressible liquid its volume.
  std::span<const double> lumped_mass() const { return nodes_->compression.empty() ? lumped_ : lumped_mass_; }
  const NodeCells<d>& around() const { return around_; }     ///< the cells around each node
  const SymmetricMatrix& matrix() const { return matrix_; }  ///< the left side, without the bodies

 private:
  template <class Act>
  void each_wall_row(std::span<const WallPlace<d>> places, Act act) const;
  template <class Act>
  void each_mode(std::size_t wall, Act act) const;
  void spread_change(std::span<Vec<d>> v) const;
  template <class Impulse>
  void lumped_change(Impulse impulse_at, std::size_t nodes) const;
  template <class Impulse>
  void add_surface_change(Impulse impulse_at) const;
  template <class Velocity>
  void add_flux(const Facet<d>& f, std::span<const Vec<d>> x, Velocity velocity, std::vector<double>& r) const;
  void add_deforming_flux(const Facet<d>& f, std::span<const Vec<d>> x, const WallShape<d>& shape,
                          const WallVelocity<d>& s, std::vector<double>& r) const;
  void measure(double density);
  double relative_density(std::size_t cell) const;
  void choose_unknowns();
  std::vector<double> of_unknowns(std::span<const double> of_nodes) const;
  bool at_contact_line(int node) const;
  void assemble(SymmetricMatrix& matrix);
  bool factored();
  void wall_modes(std::span<const WallPlace<d>> places);
  void hold_mass(std::vector<HeldNode<d>> held, double density);
  bool add_bodies();
  /// Whether motions are too many for dense algebra at leisure; with fewer results keep their bits.
  bool is_many() const { return mode_count() > 50; }
  Eigen::VectorXd flux_of(std::span<const Vec<d>> v) const;
  Eigen::VectorXd flux_of_walls(std::span<const WallVelocity<d>> s) const;
  Eigen::VectorXd taken_by(const Eigen::VectorXd& phi) const;
  std::optional<Eigen::VectorXd> corrected(LinearSolver& solver, const Eigen::VectorXd& flux) const;
  Eigen::VectorXd of_held(std::span<const double> phi) const;

  SurfaceUnknowns on_surface_;
  const Nodes<d>* nodes_ = nullptr;
  const Mesh<d>* mesh_ = nullptr;
  std::vector<VolumeGradients<d>> gradients_;  // at t_n
  std::vector<double> lumped_, lumped_mass_;
  double density_ = 0;
  std::vector<double> share_of_mass_;  // of cells: mass / (d + 2)
  MassSweep<d> sweep_;
  std::vector<double> per_mass_;                          // of cells: 1 / mass
  std::vector<double> per_nodal_mass_;                    // of nodes: 1 / ((d + 1) lumped mass)
  std::vector<Vec<d>> free_area_;                         // of nodes: area vector of the free surface around them
  std::vector<double> free_spread_;                       // of nodes: n_i sum_f |A_f / d|^2
  std::vector<double> free_measure_;                      // of nodes: sum_f |A_f| / d
  mutable std::vector<Vec<d>> change_, swept_, of_cell_;  // scratch: of nodes, of cells
  mutable std::vector<std::array<double, d + 1>> of_corner_;
  mutable std::vector<double> rate_;  // a number of each cell
  std::vector<int> unknown_, node_;
  NodeCells<d> around_;
  Assembly<d, double> assembly_;
  SymmetricMatrix matrix_;
  LinearSolver solver_{most_direct<d>};
  struct Mode {
    int unknown;
    Wrench<d> row;  // column of B
  };
  struct VertexMode {
    int unknown, vertex;
    Vec<d> row;  // part of a column of B
  };
  WallLayout<d> layout_;
  std::vector<std::vector<Mode>> modes_;               // of each wall; none where it deforms
  std::vector<std::vector<VertexMode>> vertex_modes_;  // of each wall; none where it is rigid
  HeldMass<d> held_;
  std::vector<std::vector<Mode>> held_modes_;  // R of each wall that responds
  std::vector<double> diagonal_, source_;      // of unknowns: terms of effects; empty: none
  InterfaceLaplacian<d> laplacian_;
  InterfaceModel structure_;
  Eigen::MatrixXd Y_, added_mass_, elimination_;
  // In place of the last, where motions are many and all are allowed: of the inertias in units that make their diagonal one.
  std::unique_ptr<algebra::Cholesky> factor_;
  Eigen::VectorXd units_;
  Eigen::MatrixXd held_inertia_;  // Z^T (M_h + R Y): what the held mass adds to M + G
};

/// Length of the first edge of a facet [m].
template <int d>
double size_of(const Facet<d>& f, std::span<const Vec<d>> x) {
  return (x[f.nodes[1]] - x[f.nodes[0]]).norm();
}
/// A point of a facet by the shares of its nodes [m].
template <int d>
Vec<d> point_of(const Facet<d>& f, const std::array<double, d>& share, std::span<const Vec<d>> x) {
  Vec<d> point = Vec<d>::Zero();
  for (int k = 0; k < d; ++k) point += share[k] * x[f.nodes[k]];
  return point;
}

/// What a unit of pressure impulse at a node does to a wall by one of its facets.
template <int d>
struct WallRow {
  Wrench<d> rigid = Wrench<d>::Zero();                   ///< of a rigid wall, about its reference point
  std::vector<std::pair<int, Vec<d>>> at_vertices = {};  ///< of a wall that deforms

  /// Adds what an impulse does.
  void push(double impulse, WallImpulse<d>& onto) const {
    onto.rigid += impulse * rigid;
    for (const auto& [vertex, row] : at_vertices) onto.vertices.col(vertex) += impulse * row;
  }
};

// B_kJ of all nodes on walls: act(wall, node, row of the facet). int N_a n dA with the wall's motion varying linearly along the
// facet: consistent facet mass matrix.
template <int d>
template <class Act>
void PressureEquation<d>::each_wall_row(std::span<const WallPlace<d>> places, Act act) const {
  for (const auto& f : mesh_->boundary) {
    if (f.wall < 0) continue;
    const Vec<d> area = area_vector_of<d>(f, nodes_->x);
    if (const WallShape<d>* shape = places[f.wall].shape()) {
      std::array<WallRow<d>, d> rows;
      for (const auto& [share, weight] : points_of_facet<d>(*shape, size_of<d>(f, nodes_->x))) {
        const Anchor<d> at = anchor_of<d>(*shape, point_of<d>(f, share, nodes_->x));
        for (int k = 0; k < d; ++k)
          for (int j = 0; j < d; ++j)
            rows[k].at_vertices.emplace_back(at.vertex[j], share[k] * weight * at.weight[j] * area);
      }
      for (int k = 0; k < d; ++k) act(f.wall, f.nodes[k], [&] { return rows[k]; });
      continue;
    }
    const Vec<d> centre = places[f.wall].translation();
    Vec<d> sum = Vec<d>::Zero();
    for (int n : f.nodes) sum += nodes_->x[n] - centre;
    for (int n : f.nodes)
      act(f.wall, n, [&] { return WallRow<d>{wrench_of<d>((sum + nodes_->x[n] - centre) / (d + 1), area / d)}; });
  }
}

// Entries of B of a wall: act(unknown, first of the coordinates, what a unit of impulse there does in them).
template <int d>
template <class Act>
void PressureEquation<d>::each_mode(std::size_t wall, Act act) const {
  for (const Mode& mode : modes_[wall]) act(mode.unknown, layout_.first(wall), mode.row);
  for (const VertexMode& mode : vertex_modes_[wall])
    act(mode.unknown, layout_.first(wall) + d * static_cast<Eigen::Index>(mode.vertex), mode.row);
}

extern template class PressureEquation<2>;
extern template class PressureEquation<3>;

}  // namespace splashdown::fluid
