// The seam: what a fluid and a structure are to those who couple them. Schemes, accelerators and interface terms know
// nothing else.
//
//   fluid       motion in, impulse out:    s -> I(s)
//   structure   impulse in, motion out:    s = free + Z W w,   W^T M W w = W^T (Z^T I + known)
//
// Walls carry general coordinates: a rigid wall its twist (3 in the plane, 6 in space), an elastic one the amplitudes of
// its modes. A Motion s stacks the velocities of all walls' coordinates, an Impulse I what acts on them, so that
// s . I is work; [m/s, rad/s, ...] and [N s, N m s, ...], world frame, per metre of depth in the plane. The walls of the
// structure come first among those of the fluid, in its order; others stand still.
//
// Three verbs, on both sides: `begin` fixes the step, `solve` starts from t_n whenever it is called and gives the same
// for the same, `commit` makes t_{n+1} the present. A step that is refused is never committed. Nobody but the scheme
// says what a velocity's instant is: impulses act over `kick`, walls move over `dt` (leapfrog: schemes/steppers.hpp).
#pragma once

#include <Eigen/Core>
#include <iosfwd>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/status.hpp"

namespace splashdown::coupling {

using Motion = Eigen::VectorXd;
using Impulse = Eigen::VectorXd;
/// Where walls are, one below the other, as fluid and structure understand each other: of a rigid wall the first d rows
/// of its pose (wall frame to world), by columns; of an elastic one besides the amplitudes of its modes.
using Placement = Eigen::VectorXd;

using splashdown::Status;

struct Step {
  double kick = 0;  ///< how long impulses act [s]
  double dt = 0;    ///< how long the motion that they lead to lasts [s]
};

/// A wall's coordinates among all, and what interface terms need to know of the body behind it.
struct WallCoordinates {
  std::string name;
  Eigen::Index first = 0, count = 0;
  bool answers = false;  ///< impulses change its motion
  double mass = 0;       ///< [kg, kg/m]
  double volume = 0;     ///< that it encloses [m^d]
};

/// How a structure answers to impulses in a begun step, with the contacts that are closed at the moment.
struct Response {
  Motion free;                 ///< without the fluid's impulse
  Eigen::MatrixXd modes;       ///< Z: motions that what ties the structure leaves, a column each
  Eigen::MatrixXd inertia;     ///< M of these motions; symmetric, not negative, may be singular
  Eigen::MatrixXd directions;  ///< W: combinations of them that closed contacts leave
  Eigen::VectorXd known;       ///< impulses on the motions that `free` does not contain
  /// W': combinations in which impulses of these contacts do no work, as many; empty, or W, unless some slide and rub.
  Eigen::MatrixXd workless = {};
};

/// Inverse masses of a local operator on a wall that stands in for the answer of the body behind it [1/kg]; 0: none.
struct InterfaceOperator {
  double laplacian = 0, robin = 0;
};

/// What the fluid's own equations know of the structure during a step.
struct InterfaceModel {
  Eigen::MatrixXd modes, inertia;                      ///< Z, M: the exact term M + Z^T B A^-1 B^T Z; empty: none
  std::vector<InterfaceOperator> interface_operators;  ///< of each wall; empty: none at all
};

/// Piece of a wall with a stand-in.
struct InterfacePiece {
  std::size_t wall;
  double measure;  ///< [m, m^2]
};

/// What a fluid is asked in a pass.
struct Pass {
  Motion motion;               ///< of the structure's walls; without the fluid's impulse in motions of the exact term
  Eigen::VectorXd lagged;      ///< interface impulses that stand-ins lag on, one a piece [Pa s]
  Eigen::MatrixXd directions;  ///< W of the exact term; empty: all of its motions
  Eigen::VectorXd known;       ///< impulses on its motions besides the fluid's and what `motion` contains; empty: none
  Eigen::MatrixXd workless = {};  ///< W' of the exact term: Newton's law is asked for in these; empty: W
};

/// What it answers.
struct Solution {
  Motion motion;           ///< of the structure's walls: as asked, and what the exact term found
  Impulse impulse;         ///< on them
  Motion imbalance;        ///< velocities that impulses left unbalanced in the exact term's motions would still give
  Eigen::VectorXd lagged;  ///< interface impulses found; equal to those asked with, the stand-ins vanish
  Eigen::VectorXd wetted;  ///< measure of each wall's wetted part [m, m^2]
};

/// Slopes of a begun step's solve, for fluids that know them.
class Linearised {
 public:
  virtual ~Linearised() = default;
  /// d(impulses on these walls; lagged) / d(their motions; lagged), corrections of the solve apart.
  virtual Eigen::MatrixXd slope(std::span<const std::size_t> walls) const = 0;
  /// Impulse on these walls by their acceleration: symmetric, positive [kg, kg m, kg m^2; per metre in the plane].
  virtual Eigen::MatrixXd added_mass(std::span<const std::size_t> walls) const = 0;
};

/// What both sides are.
class Participant {
 public:
  virtual ~Participant() = default;
  virtual double time() const = 0;                 ///< t_n
  virtual double stable_dt() const = 0;            ///< largest that it allows from t_n; infinity: any
  virtual void save(std::ostream& out) const = 0;  ///< bit-exact state at t_n
  virtual void load(std::istream& in) = 0;
};

class FluidPart : public Participant {
 public:
  virtual Status begin(const Step& step, const InterfaceModel& structure) = 0;
  /// An empty motion: all walls stand still.
  virtual Status solve(const Pass& pass) = 0;
  /// Of the last solve.
  virtual const Solution& solution() const = 0;
  /// Whether the last solve may be committed. Passes may be wild on their way; the last may not.
  virtual Status acceptable() const = 0;
  /// Where the last solve may not be committed for a fragment of the fluid: lets that go its own way in the next `begin` from t_n.
  /// False: there is none.
  virtual bool release_fragment() { return false; }
  /// Accepts the last solve. `walls`: where the structure has its walls at t_{n+1}; empty: all stay.
  virtual void commit(const Placement& walls) = 0;

  virtual std::span<const InterfacePiece> pieces() const { return {}; }  ///< of the begun step
  virtual Eigen::VectorXd first_guess() const { return {}; }             ///< of `lagged`, after begin
  virtual const Linearised* linearised() const { return nullptr; }       ///< from begin to commit
  virtual double density() const = 0;                                    ///< [kg/m^3]
  virtual double roundoff() const = 0;                                   ///< of its positions [m]
  /// Seconds spent so far in each of its phases.
  virtual std::vector<std::pair<std::string, double>> phase_seconds() const { return {}; }
};

class StructurePart : public Participant {
 public:
  virtual std::string name() const = 0;  ///< under which its time is booked
  virtual const std::vector<WallCoordinates>& walls() const = 0;
  /// Of coordinates: lengths that make all velocities m/s.
  virtual const Eigen::VectorXd& scales() const = 0;
  virtual double length() const = 0;  ///< of its longest wall [m]
  /// Of the fastest point of each wall, under a motion [m/s].
  virtual Eigen::VectorXd speeds(const Motion& motion) const = 0;
  virtual Motion motion() const = 0;  ///< that it came to t_n with

  virtual void begin(const Step& step) = 0;
  /// Of the begun step. `motion` = `free` until contacts open or close and impulses act.
  virtual Response response() const = 0;
  /// The motion under an impulse, contacts included: the trial.
  virtual const Motion& solve(const Impulse& impulse) = 0;
  /// A trial with a motion that somebody found from `response`.
  virtual const Motion& adopt(const Motion& motion) = 0;
  /// Opens and closes contacts as the last trial asks for if this is the impulse on it. False: they were right.
  virtual bool update_contacts(const Impulse& /*impulse*/) { return false; }
  virtual Placement placement() const = 0;  ///< of the last trial, at t_{n+1}
  /// Whether the last trial may be committed.
  virtual Status acceptable() const { return {}; }
  /// Accepts the last trial.
  virtual void commit() = 0;
};

}  // namespace splashdown::coupling
