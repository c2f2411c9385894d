// Newtonian viscosity, implicit over one kick on the mesh of t_n:
//
//   (M + kick K) (v + dv) = M v,   v . K w = int 2 mu eps(v) : eps(w),   eps(v) = (grad v + grad v^T) / 2
//
// with lumped mass M. The full strain keeps rigid rotations free of stress, and makes "no viscous traction"
// the natural condition of the free surface.
#pragma once

#include "fluid/effects/effect.hpp"
#include "fluid/pfem/linear/assembly.hpp"
#include "fluid/pfem/linear/linear_solver.hpp"

namespace splashdown::fluid {

/// Newtonian viscosity with one coefficient all over the fluid.
///
/// Walls (WallSpec::sticks):
///
///   slip     the change has no component along the wall's normal: dv . n = 0; no shear stress. Not v . n = w . n:
///            the pressure sees to that, and mu -> 0 then leads back to the inviscid fluid exactly
///   no slip  the tangential velocity is the wall's, weakly (Nitsche 1971), with a traction at each wetted facet f, of area A
///            and normal n, of the cell with volume V and the stress s(v) = 2 mu eps(v):
///
///            w . K v  +=  sum_f sum_a A/d [ - w_a . t(v) - (v_a - g_a) . t(w) + b (v_a - g_a) . w_a ]     t(v) = P s(v) n
///
///            P = 1 - n n^T, g the wall's velocity, a the facet's nodes but those of the contact line: one that sticks cannot
///            move (Huh, Scriven, J. Colloid Interface Sci. 35, 1971). b = 4 k mu A / V for k such facets of the cell makes it
///            definite. Where elements are finer than the boundary layer the water sticks, to second order; where they are
///            coarser it slips under the stress that the elements can know of (Bazilevs, Hughes, Comput. Fluids 36, 2007).
///            Held to the wall instead, nodes would take half an element of water along, however little viscous it is
///
/// Walls get the reactions of what they impose, so that momentum is kept. Stable for any kick; of first order in time, or of
/// second (StepView::in_time), by two stages on one factor (Alexander 1977): with kick f(v) = c - kick M^-1 K v, c all other
/// changes over the kick, and g = 1 - 1 / sqrt 2,
///
///   v_1 = v + g kick f(v_1),   v+ = v + (1 - g) kick f(v_1) + g kick f(v+)
///
/// One system of d unknowns a node per step, factored or, if large and in 3D, solved by multigrid. Bodies that answer the
/// pressure answer the stresses in the same implicit step: with the fields u_k that unit velocities of their motions make,
/// (M + C) y = Z^T f_0, C_jk = sum of u_j over held directions . (M_L + kick K) u_k, so that no mass is too small for any
/// viscosity.
template <int d>
class Viscosity final : public Effect<d> {
 public:
  /// `dynamic`: mu [Pa s].
  explicit Viscosity(double dynamic) : mu_(dynamic) {}
  std::string name() const override { return "viscosity"; }
  bool keeps_rest() const override { return true; }
  bool follows() const override { return true; }
  Status begin(const StepView<d>& step) override;
  Status predict(const StepView<d>& step, const Carried<d>& carried, const Predicted<d>& predicted) override;
  Status follow(const StepView<d>& step, const Carried<d>& carried, const Others<d>& others,
                const Predicted<d>& predicted) override;
  double diffusivity(double density) const override { return mu_ / density; }
  /// power: rate of change of the kinetic energy [W]
  std::vector<Diagnostic> diagnostics(const Nodes<d>&, std::span<const double>) const override {
    return {{"power", power_}};
  }

 private:
  struct Held {
    int node;
    Mat<d> free;  // projects on the directions in which the wall leaves the change free
  };
  struct Bond {  // of a cell to a wall that sticks
    int cell, wall;
    Vec<d> normal;                 // unit, out of the fluid
    double share, stiffness;       // A / d, b
    std::array<char, d + 1> held;  // of corners: 1 for nodes that are bound
  };
  void number_nodes(const StepView<d>& step);
  void measure(const StepView<d>& step);
  void find_held(const StepView<d>& step);
  void find_bonds(const StepView<d>& step);
  /// Row of corner a and column of corner b of a bond, over the kick.
  Mat<d> bond_block(const Bond& bond, int a, int b) const;
  /// Adds what bonds to walls with velocities `walls` exert on the nodes, [N].
  void pull(const StepView<d>& step, std::span<const Vec<d>> v, std::span<const WallVelocity<d>> walls,
            std::vector<Vec<d>>& force, std::vector<WallImpulse<d>>* on_walls) const;
  void assemble(const StepView<d>& step);
  /// Velocities and those of the walls, [m/s].
  struct Field {
    std::vector<Vec<d>> v;
    std::vector<WallVelocity<d>> walls;
  };
  /// A field before the kick, what else changes its velocities (empty: nothing) and where its walls end.
  struct Kicked {
    Field from;
    std::vector<Vec<d>> change;
    std::vector<WallVelocity<d>> walls;
  };
  /// The same after the kick, and the field whose stress is the mean over it.
  struct Passed {
    Field to, mean;
  };
  /// Impulse on the walls of what they impose: of changes of velocity and of velocities after them.
  void react(const StepView<d>& step, std::span<const Vec<d>> change, std::span<const Vec<d>> moved,
             std::span<const WallVelocity<d>> walls, std::vector<WallImpulse<d>>& on_walls);
  /// Lets the free nodes follow what walls do to them, in place; several fields at once.
  bool follow(const StepView<d>& step, std::vector<Field>& fields);
  /// Fields after the kick; empty: a solve has failed.
  std::vector<Passed> pass(const StepView<d>& step, const std::vector<Kicked>& fields);
  /// Adds the changes of velocity to what is predicted, and books their power.
  void add(const StepView<d>& step, const Carried<d>& carried, std::span<const Vec<d>> others,
           const Predicted<d>& predicted);
  bool answer(const StepView<d>& step, const Predicted<d>& predicted, std::vector<WallImpulse<d>>& on_walls);
  /// force = K v at all nodes, without bonds.
  void stress(const StepView<d>& step, std::span<const Vec<d>> v, std::vector<Vec<d>>& force) const;

  double mu_;
  double implicit_kick_ = 0;         // of the factor: the kick, or the stage's part of it [s]
  std::vector<int> unknown_, node_;  // unknown of a node, node of an unknown
  std::vector<VolumeGradients<d>> gradients_;
  std::vector<double> volume_;  // of cells
  mutable std::vector<Mat<d>> stress_;
  std::vector<Held> held_;
  std::vector<int> held_at_;   // of a node, -1: free
  std::vector<Bond> bonds_;    // by cell
  std::vector<int> bonds_at_;  // of a cell: its first bond, -1: none
  Assembly<d, Mat<d>> blocks_;
  SymmetricMatrix matrix_;
  LinearSolver solver_{most_direct<d>};
  std::vector<Vec<d>> change_, moved_, force_;
  std::vector<double> rhs_;
  double power_ = 0;
};

extern template class Viscosity<2>;
extern template class Viscosity<3>;

}  // namespace splashdown::fluid
