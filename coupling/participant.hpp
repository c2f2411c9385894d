// The seam: what a fluid and a structure are to those who couple them. Schemes, accelerators and interface terms know
// nothing else.
//
//   fluid       velocities in, impulse out:    s -> I(s)
//   structure   impulse in, velocities out:    s = free + Z W w,   W^T M W w = W^T (Z^T I + known)   (core/response.hpp)
//
// Walls carry general coordinates: a rigid wall its twist (3 in 2D, 6 in 3D), an elastic one the amplitudes of
// its modes. Velocities s are those of all walls' coordinates, an Impulse I what acts on them, so that
// s . I is work; [m/s, rad/s, ...] and [N s, N m s, ...], world frame, per metre of depth in 2D. The walls of the
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

#include "core/response.hpp"
#include "core/status.hpp"

/// Fluid and structure as each other's partners, and the schemes that make them agree.
namespace splashdown::coupling {

/// Generalised velocities of all walls of the structure, one below the other.
using Velocities = Eigen::VectorXd;
/// What is conjugate to them: velocities . impulse is work.
using Impulse = Eigen::VectorXd;
/// Where walls are, one below the other, as fluid and structure understand each other: of a rigid wall the first d rows
/// of its pose (wall frame to world), by columns; of an elastic one besides the amplitudes of its modes.
using Placement = Eigen::VectorXd;

using splashdown::ClosedContacts;
using splashdown::InterfaceModel;
using splashdown::InterfaceOperator;
using splashdown::InterfacePiece;
using splashdown::ModalInertia;
using splashdown::Response;
using splashdown::Status;

/// The step that `begin` fixes, from t_n to t_{n+1} = t_n + dt.
struct Step {
  double kick = 0;  ///< how long impulses act [s]
  double dt = 0;    ///< how long walls move with the velocities that they lead to [s]
};

/// A wall's coordinates among all, and what interface terms need to know of the body behind it.
struct WallCoordinates {
  std::string name;        ///< of the body
  Eigen::Index first = 0;  ///< index of its first coordinate among all
  Eigen::Index count = 0;  ///< number of its coordinates
  bool answers = false;    ///< impulses change its velocities
  bool stays = false;      ///< where it is, for good
  double mass = 0;         ///< [kg, kg/m]
  double volume = 0;       ///< that it encloses [m^d]
};

/// What a fluid is asked in a pass.
struct Pass {
  Velocities velocities;         ///< of the structure's walls; in modes of the exact term without the fluid's impulse
  Eigen::VectorXd lagged = {};   ///< interface impulses that local operators lag on, one a piece [Pa s]
  ClosedContacts contacts = {};  ///< what of the modes may occur
};

/// What it answers.
struct Solution {
  Velocities velocities;   ///< of the structure's walls: as asked, and what the exact term found
  Impulse impulse;         ///< on them
  Velocities imbalance;    ///< that impulses left unbalanced in the exact term's modes would still give
  Eigen::VectorXd lagged;  ///< interface impulses found; equal to those asked with, the stand-ins vanish
  Eigen::VectorXd wetted;  ///< measure of each wall's wetted part [m, m^2]
};

/// Slopes of a begun step's solve, for fluids that know them.
class Linearised {
 public:
  virtual ~Linearised() = default;
  /// d(impulses on these walls; lagged) / d(their velocities; lagged), corrections of the solve apart.
  virtual Eigen::MatrixXd slope(std::span<const std::size_t> walls) const = 0;
  /// Impulse on these walls by their acceleration: symmetric, positive [kg, kg m, kg m^2; per metre in 2D].
  virtual Eigen::MatrixXd added_mass(std::span<const std::size_t> walls) const = 0;
};

/// What both sides are. Not copied; one scheme drives it, on one thread at a time.
class Participant {
 public:
  virtual ~Participant() = default;
  virtual double time() const = 0;       ///< t_n [s]
  virtual double stable_dt() const = 0;  ///< largest that it allows from t_n [s]; infinity: any
  /// Writes the state at t_n, bit for bit: what is loaded goes on with the same numbers.
  virtual void save(std::ostream& out) const = 0;
  /// Reads what `save` wrote, into a participant made of the same scene. Throws std::runtime_error for other bytes, after
  /// which it may only be destroyed or loaded again.
  virtual void load(std::istream& in) = 0;
};

/// Velocities in, impulses out: I(s).
class FluidPart : public Participant {
 public:
  /// Fixes the step and what its equations know of the structure; meshes and factors. Refused, with the cause, where the
  /// equations cannot be solved. Throws std::invalid_argument for walls that it does not have.
  virtual Status begin(const Step& step, const InterfaceModel& structure) = 0;
  /// Impulses on the walls for their velocities: I(s), and s itself in the modes of the exact term. Starts from t_n, the same
  /// bits for the same pass. Without velocities all walls stand still. Refused where there is no solution.
  virtual Status solve(const Pass& pass) = 0;
  /// Of the last solve.
  virtual const Solution& solution() const = 0;
  /// Whether the last solve may be committed. Passes may be wild on their way; the last may not.
  virtual Status acceptable() const = 0;
  /// Where the last solve may not be committed for a fragment of the fluid: lets that go its own way in the next `begin` from
  /// t_n. False: there is none.
  virtual bool release_fragment() { return false; }
  /// Accepts the last solve. `walls`: where the structure has its walls at t_{n+1}; empty: all stay.
  virtual void commit(const Placement& walls) = 0;

  /// Whether the fluid is at rest and none of these walls, with the speeds of their fastest points [m/s], comes near it in the
  /// next step. That is then a mere `wait`; walls that it does not have are no hindrance.
  virtual bool rests(std::span<const WallCoordinates> /*walls*/, const Eigen::VectorXd& /*speeds*/) { return false; }
  /// t_n <- t_n + dt, in place of begin, solve and commit. `walls`, `velocities`: of the structure at t_{n+1} and t_{n+1/2}.
  virtual void wait(double /*dt*/, const Placement& /*walls*/, const Velocities& /*velocities*/) {}

  virtual std::span<const InterfacePiece> pieces() const { return {}; }  ///< of the begun step
  virtual Eigen::VectorXd first_guess() const { return {}; }             ///< of `lagged`, after begin
  virtual const Linearised* linearised() const { return nullptr; }       ///< from begin to commit
  virtual double density() const = 0;                                    ///< [kg/m^3]
  virtual double roundoff() const = 0;                                   ///< of its positions [m]
  /// Seconds spent so far in each of its phases.
  virtual std::vector<std::pair<std::string, double>> phase_seconds() const { return {}; }
};

/// Impulses in, velocities out: s(I).
class StructurePart : public Participant {
 public:
  virtual std::string name() const = 0;                           ///< under which its time is booked
  virtual const std::vector<WallCoordinates>& walls() const = 0;  ///< in the order of their coordinates
  /// Of coordinates: lengths that make all velocities m/s.
  virtual const Eigen::VectorXd& scales() const = 0;
  virtual double length() const = 0;  ///< of its longest wall [m]
  /// Of the fastest point of each wall [m/s].
  virtual Eigen::VectorXd speeds(const Velocities& velocities) const = 0;
  virtual Velocities velocities() const = 0;  ///< that it came to t_n with

  /// Fixes the step: forces, joints and contacts are taken at t_n. Throws std::invalid_argument unless kick and dt are positive.
  virtual void begin(const Step& step) = 0;
  /// Of the begun step: the velocities are `free` until contacts open or close and impulses act.
  virtual Response response() const = 0;
  /// The velocities under an impulse, contacts included: the trial. Starts from t_n; an impulse that is not finite gives
  /// velocities that are not.
  virtual const Velocities& solve(const Impulse& impulse) = 0;
  /// A trial with velocities that somebody found from `response`.
  virtual const Velocities& adopt(const Velocities& velocities) = 0;
  /// Opens and closes contacts as the last trial asks for if this is the impulse on it. False: they were right.
  virtual bool update_contacts(const Impulse& /*impulse*/) { return false; }
  virtual Placement placement() const = 0;  ///< of its walls at t_{n+1}, after the last trial
  /// Tells it, before commit, how much of its walls the fluid of this step wets [m, m^2]: for forces of the air.
  virtual void see_wetted(const Eigen::VectorXd& /*measures*/) {}
  /// Whether the last trial may be committed.
  virtual Status acceptable() const { return {}; }
  /// Accepts the last trial.
  virtual void commit() = 0;
};

}  // namespace splashdown::coupling
