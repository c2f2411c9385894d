// An effect on the fluid's momentum: present in a scene or absent, never switched.
//
// All effects act on the same carried velocity, which belongs to t_{n-1/2} and creates no volume on the mesh
// of t_n, and add their changes to the predicted one. So their order does not matter, and what vanishes for
// a fluid at rest (viscosity, damping) leaves it at rest beside gravity.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/response.hpp"
#include "core/status.hpp"
#include "fluid/pfem/liquid_state.hpp"
#include "fluid/pfem/mesh/mesh.hpp"
#include "fluid/pfem/mesh/node_cells.hpp"
#include "fluid/pfem/nodes.hpp"
#include "fluid/pfem/spec.hpp"
#include "fluid/pfem/types.hpp"
#include "fluid/pfem/wall_place.hpp"

namespace splashdown::fluid {

/// How terms that are solved implicitly go through a kick: backward Euler, or two stages of second order (Alexander 1977), both
/// of which leave nothing of what is too stiff.
enum class InTime { euler, second_order };

/// What an effect sees of the fluid during a step.
template <int d>
struct StepView {
  const Nodes<d>& nodes;                  ///< at t_n
  const Mesh<d>& mesh;                    ///< at t_n, remeshed
  double density;                         ///< [kg/m^3]
  double kick;                            ///< [s]
  double t;                               ///< t_n [s]
  double dt;                              ///< of this step [s]
  double dt_before;                       ///< of the step that led to t_n [s]; 0 at the start
  std::span<const double> lumped_volume;  ///< mass of nodes over `density` [m^d]
  const NodeCells<d>& around;             ///< the cells around each node
  std::span<const WallSpec<d>> walls;     ///< as they were made
  std::span<const WallPlace<d>> poses;    ///< of walls, at t_n
  const WallLayout<d>& layout;            ///< of the walls' coordinates
  const ModalInertia* answers = nullptr;  ///< modes of walls that answer the fluid; nullptr: none does
  InTime in_time = InTime::euler;         ///< of terms that are solved implicitly
};

/// What effects act on: velocities at t_{n-1/2} of nodes [m/s] and walls.
template <int d>
struct Carried {
  std::span<const Vec<d>> v;               ///< of nodes
  std::span<const WallVelocity<d>> walls;  ///< of walls, about their origins
};

/// What effects add to.
template <int d>
struct Predicted {
  std::span<Vec<d>> v;                 ///< of nodes [m/s]
  std::span<WallImpulse<d>> on_walls;  ///< impulse on each wall about its origin [N s]
  /// Of the modes that answer: what an effect that solves for them with the fluid has changed in them, on_walls being the
  /// impulse that did it. nullptr: none answers.
  Eigen::VectorXd* answer = nullptr;
};

/// What all but one effect do in a kick, the pressure included.
template <int d>
struct Others {
  std::span<const Vec<d>> change;          ///< of velocities of nodes [m/s]
  std::span<const WallVelocity<d>> walls;  ///< of walls, after it
};

/// What effects add to the pressure equation of a step, an entry a node; a vector that stays empty adds nothing.
///
///   (A + C) phi = r + q,   C diagonal
struct PressureTerms {
  std::vector<double> diagonal;  ///< C, not negative: volume that an impulse there takes away for good [m^d/(Pa s^2)]
  std::vector<double> source;    ///< q: volume that appears around a node, negative: that goes [m^d/s]
  std::vector<double>
      surface_pressure;  ///< on the free surface, against the air's zero [Pa]; elsewhere it means nothing
  /// What a pressure [Pa] makes of the liquid, for as long as it lasts; empty: nothing.
  std::function<LiquidState(double)> liquid;
};

/// Name and value of a number worth recording.
using splashdown::Diagnostic;

/// A term of the momentum equation, rho Dv/Dt = ... + effect. World frame.
template <int d>
class Effect {
 public:
  virtual ~Effect() = default;
  virtual std::string name() const = 0;  ///< of its timer, columns and table
  /// Once a step, before any `predict` of it.
  virtual Status begin(const StepView<d>& /*step*/) { return {}; }
  /// Adds the effect of one kick; repeatable.
  virtual Status predict(const StepView<d>& step, const Carried<d>& carried, const Predicted<d>& predicted) = 0;
  /// Whether it may be solved for together with the pressure, by `follow`, instead of before it.
  virtual bool follows() const { return false; }
  /// As `predict`, but for carried velocities that all else changes too: what it adds to those changes. `predicted.answer` is
  /// not used: bodies answer to the impulse on their walls. Repeatable, after `predict`.
  virtual Status follow(const StepView<d>& /*step*/, const Carried<d>& /*carried*/, const Others<d>& /*others*/,
                        const Predicted<d>& /*predicted*/) {
    return {};
  }
  /// The step is taken; once, after the last `predict` of it.
  virtual void commit(const StepView<d>& /*step*/) {}
  /// What it remembers from step to step, moved on by `commit` alone and kept in checkpoints; always as many. Empty: nothing.
  virtual std::span<double> memory() { return {}; }
  /// Adds its terms of the pressure equation; once a step, after `begin`.
  virtual void pressure(const StepView<d>& /*step*/, PressureTerms& /*terms*/) {}
  /// Potential energy per unit mass at a point [J/kg]; 0 for effects that have none.
  virtual double potential(const Vec<d>& /*x*/) const { return 0; }
  /// What it gives to all water alike, like gravity [m/s^2]: waves, cavities behind bodies and steps are judged by it.
  virtual Vec<d> uniform_acceleration() const { return Vec<d>::Zero(); }
  /// Whether it leaves water at rest that is at rest beside gravity. Such water is not stepped as long as nothing comes near it.
  virtual bool keeps_rest() const { return false; }
  /// Whether the work that it does on the water is booked (Ledger::work_of_effects): for effects that may bring energy and have
  /// no potential. Others take energy or keep it.
  virtual bool books_work() const { return false; }
  /// Kinematic viscosity [m^2/s] with which it spreads momentum through the fluid; 0 for effects that do not.
  virtual double diffusivity(double /*density*/) const { return 0; }
  /// Numbers at t_n, after `predict`; always of the same names. `lumped_mass`: of nodes [kg].
  virtual std::vector<Diagnostic> diagnostics(const Nodes<d>& /*nodes*/,
                                              std::span<const double> /*lumped_mass*/) const {
    return {};
  }
  /// Largest stable dt [s]; infinity for effects that set none.
  virtual double stable_dt() const;
};

}  // namespace splashdown::fluid
