// A solid of quadratic simplices, total Lagrangian: nodes X at rest and displacements u,
//
//   M_ab = int rho N_a N_b dX,   f_a = int P(F) grad N_a dX,   K_ab = int grad N_a . dP/dF . grad N_b dX,   F = 1 + du/dX
//
// by the rules of quadratic.hpp. Displacements have an error O(h^3) in L2, energies O(h^4). f is exact for fields of
// uniform F (patch test). Point masses are rigidly attached, without inertia of rotation.
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "elastic/assembly/system.hpp"
#include "elastic/laws/law.hpp"
#include "elastic/mesh/solid_mesh.hpp"

namespace splashdown::elastic {

/// Momentum and angular momentum about the origin [kg m/s, kg m^2/s; per metre in 2D].
template <int d>
struct Momenta {
  Vec<d> linear;
  Eigen::Matrix<double, rotations<d>, 1> angular;
};

/// The largest von Mises stress and where it is.
template <int d>
struct StressPeak {
  double value = 0;            ///< [Pa]
  Vec<d> at = Vec<d>::Zero();  ///< at rest [m]
  std::size_t cell = 0;
  Barycentric<d> in_cell = Barycentric<d>::Zero();
};

/// What a part of a solid is made of.
template <int d>
struct Material {
  std::shared_ptr<const Law<d>> law;
  double density = 0;  ///< [kg/m^3]
};

/// A mesh with laws and densities.
template <int d>
class Solid final : public System {
 public:
  /// Throws std::invalid_argument unless the density is positive.
  Solid(SolidMesh<d> mesh, std::shared_ptr<const Law<d>> law, double density);
  /// Of several materials: `part` is the number of each cell's. Throws std::invalid_argument unless all densities are
  /// positive.
  Solid(SolidMesh<d> mesh, std::vector<Material<d>> materials, std::vector<int> part);

  /// The same solid with each cell divided (core/simplices/split.hpp), and where its nodes lie in the cells before. Held are
  /// nodes where all fields that this solid can have are zero.
  std::pair<Solid, std::vector<typename SplitCells<d>::At>> divided() const;
  /// At rest.
  const SolidMesh<d>& mesh() const { return mesh_; }
  /// Of a cell.
  const Law<d>& law(std::size_t cell = 0) const { return *materials_[static_cast<std::size_t>(part_[cell])].law; }
  /// The number of a cell's material.
  int part(std::size_t cell) const { return part_[cell]; }
  const Sparse& mass() const override { return mass_; }
  Field internal_force(const Field& u) const override;
  /// The force of a step from `before` through `middle`: P = F_middle (S + lead dS), S of Law::stress_between and dS its change
  /// in the step (Law::stress_change) [N, N/m].
  Field force_between(const Field& before, const Field& middle, double lead = 0) const;
  /// Of force_between by its middle, but for an antisymmetric part of the order of the way [N/m, N/m^2].
  void stiffness_between(const Field& before, const Field& middle, double lead, Sparse& K) const;
  /// Of such a step: P = (F_middle - F_before) dS, what dS would do in the middle and not at the beginning [N, N/m].
  Field turned_change(const Field& before, const Field& middle) const;
  /// The force that the stress S of such a step has later: P = F_now S [N, N/m].
  Field carried_force(const Field& before, const Field& middle, const Field& now) const;
  /// (U_before + U_after)/2 - dS:dE/8 of such a step, U of the mean strain where psi is quadratic in E [J, J/m].
  double strain_energy_between(const Field& before, const Field& middle) const;
  void stiffness(const Field& u, Sparse& K) const override;
  bool linear() const override { return linear_; }
  double strain_energy(const Field& u) const override;
  double length() const override { return length_; }

  /// Holds all nodes that are within `inside`, a function of X.
  /// Returns how many there are.
  int clamp(const std::function<bool(const Vec<d>&)>& inside);
  /// Attaches a mass [kg, kg/m].
  void add_point_mass(const Place<d>& place, double mass);

  /// The same vector at all nodes: a rigid translation, or with the mass a weight.
  Field uniform(const Vec<d>& vector) const;
  /// Forces on nodes of one force at a point [N, N/m].
  Field point_force(const Place<d>& place, const Vec<d>& force) const;
  /// Of a body force per volume at rest, a function of X [N/m^3].
  Field body_force(const std::function<Vec<d>(const Vec<d>&)>& density) const;
  /// Of a traction on the boundary, a function of X and of the normal at rest [Pa].
  Field traction(const std::function<Vec<d>(const Vec<d>&, const Vec<d>&)>& stress) const;

  /// A field at a point.
  Vec<d> value(const Field& field, const Place<d>& place) const;
  /// Of nodes at X + u with velocities v.
  Momenta<d> momenta(const Field& u, const Field& v) const;
  double total_mass() const;                 ///< point masses included [kg, kg/m]
  Vec<d> centre(const Field& u) const;       ///< of mass [m]
  Mat<d> second_moments() const;             ///< of mass about its centre, at rest [kg m^2, kg m]
  StressPeak<d> peak(const Field& u) const;  ///< over all points of the rules
  /// Error of the elements there: von Mises norm of their stress minus the one that is the mean of elements of the same
  /// material at nodes, and between nodes as displacements are (Zienkiewicz & Zhu 1987) [Pa].
  double stress_error(const Field& u, const StressPeak<d>& peak) const;
  /// Green's strain (F^T F - 1)/2 at a point.
  Mat<d> strain(const Field& u, const Place<d>& place) const;
  /// Cauchy's stress at a point [Pa].
  Mat<3> stress(const Field& u, const Place<d>& place) const;
  /// Cauchy's stress at all nodes, mean of the elements around them [Pa]. Between materials: of that where von Mises' is
  /// largest, since stresses jump there.
  std::vector<Mat<3>> nodal_stress(const Field& u) const;
  /// The least det F over all points of the rules; not above zero: an element is turned over.
  double least_volume_ratio(const Field& u) const;
  /// int |u - exact|^2 dX, for orders of convergence.
  double squared_difference(const Field& u, const std::function<Vec<d>(const Vec<d>&)>& exact) const;

 private:
  using Slopes = Eigen::Matrix<double, d, cell_nodes<d>>;
  struct Point {
    Slopes slopes;  // by X, a column a node
    double weight;  // volume that it stands for
  };
  using Displacements = Eigen::Matrix<double, d, cell_nodes<d>>;
  Displacements of_cell(const Field& u, std::size_t cell) const;
  Mat<d> gradient(const Field& u, std::size_t cell, const Slopes& slopes) const;
  Slopes slopes_at(std::size_t cell, const Barycentric<d>& at, double* determinant = nullptr) const;
  Vec<d> at_rest(std::size_t cell, const Barycentric<d>& at) const;
  Mat<3> stress_at_node(const Field& u, std::size_t cell, int k) const;
  /// f of P = stress(cell, slopes) at all points.
  template <class Stress>
  Field force_of(const Stress& stress) const;
  void make_pattern();
  void assemble_mass();
  void sum_mass();
  /// K of tangent(cell, slopes) at all points.
  template <class TangentAt>
  void assemble_stiffness(const TangentAt& tangent, Sparse& K) const;
  template <class Add>
  void add_cell(std::size_t cell, Sparse& matrix, const Add& block) const;

  SolidMesh<d> mesh_;
  std::vector<Material<d>> materials_;
  std::vector<int> part_;  // of each cell
  bool linear_ = true;
  double length_;
  std::vector<std::pair<Place<d>, double>> point_masses_;
  std::vector<Point> points_;  // of all cells in turn
  Sparse mass_;
  Eigen::VectorXd of_node_;  // mass: sums of its rows along one axis
  Sparse constant_;          // K of a linear law, else empty
  std::vector<int> first_;   // of values: for each cell, nodes a and b and column k of b the row of a
};

}  // namespace splashdown::elastic
