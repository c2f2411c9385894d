// Velocities that bodies can have together under joints and contacts, and how they answer to impulses. Internal to the
// rigid-body room.
//
//   E s = a                       held freedoms, fixed and prescribed bodies, joints
//   D s >= b                      contacts
//   M (s - s_before) = impulse + E^T l + D^T r + T^T t,   r >= 0,   r (D s - b) = 0
//   D s + e >= b,  K e = r        contacts that yield: e is their rate of yielding
//   |t| <= mu r,   T s = 0 or t = -mu r T s / |T s|   at each contact that rubs (Coulomb)
//
// Solved in coordinates: s = s_0 + Z y with Z a basis of the velocities that E leaves, and y in the directions W that
// the closed contacts leave. Which contacts are closed is found by the primal-dual active set method (Hintermueller,
// Ito, Kunisch 2002): a closed contact that pulls opens, an open one that would be crossed closes. It may run in
// circles; after a few changes only the first contact that is wrong changes (Murty 1974), which ends where contacts
// are independent of each other. Rates of yielding are further coordinates y without velocities of their own, so that M stays
// what it is whatever is closed.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace splashdown::rigid {

/// Conditions and velocities this much smaller than others are roundoff.
inline constexpr double negligible = 1e-10;

/// A closed contact that rubs sticks, T s = 0, while that takes no more than mu r. One that slides along n, |n| = 1, pushes along
/// D - mu n T: Newton's law is asked for in the directions W' along which that does no work, W'^T (M y - ...) = 0. It sticks
/// if its friction would drive it the other way, or if it pulls, which friction can do (Painleve 1895). Nothing divides by M:
/// bodies may lack mass where something else, the water, has inertia for them.
/// Constraints of one step on the velocities s of all bodies, one below the other.
class ConstraintSolver {
 public:
  /// What a step asks; matrices have a row a condition.
  struct Problem {
    Eigen::VectorXd before;      ///< s_before
    Eigen::VectorXd unit;        ///< lengths that make all velocities m/s: 1, or m/rad
    Eigen::MatrixXd equalities;  ///< E
    Eigen::VectorXd equal;       ///< a
    Eigen::MatrixXd contacts;    ///< D
    Eigen::VectorXd least;       ///< b
    double resolution = 0;       ///< of D s - b: smaller violations are roundoff [m/s]
    Eigen::MatrixXd tangents;    ///< T: as many rows for each of the first `rubbing` contacts
    int rubbing = 0;
    Eigen::VectorXd yielding;  ///< K > 0 of the last contacts, which yield [kg]; empty: none does
    double friction = 0;       ///< mu
    Eigen::MatrixXd inertia;   ///< M
    Eigen::VectorXd impulse;   ///< known already [N s]
  };
  ConstraintSolver() = default;
  /// Finds s_0 and Z; contacts are open. A contradiction between equalities is met in the least-squares sense.
  explicit ConstraintSolver(const Problem& problem);

  const Eigen::MatrixXd& modes() const { return modes_; }            ///< Z
  const Eigen::MatrixXd& inertia() const { return inertia_; }        ///< Z^T M Z
  const Eigen::MatrixXd& directions() const { return directions_; }  ///< W
  const Eigen::MatrixXd& workless() const { return workless_; }      ///< W', W unless something slides and rubs
  /// Velocity under a further impulse; modes without inertia get none.
  Eigen::VectorXd velocity(const Eigen::VectorXd& impulse) const;
  /// Impulse on the modes that such a velocity does not account for: Z^T impulse - (Z^T M Z) y.
  Eigen::VectorXd unspent(const Eigen::VectorXd& velocity, const Eigen::VectorXd& impulse) const;
  /// Opens and closes contacts as velocity and impulse ask for. False: they were right.
  bool update_contacts(const Eigen::VectorXd& velocity, const Eigen::VectorXd& impulse);
  /// Velocity under a further impulse, contacts opening and closing as they ask for; none if that does not end.
  std::optional<Eigen::VectorXd> settled(const Eigen::VectorXd& impulse);
  /// What closed contacts ask for beyond s_0: the slowest velocities that meet them.
  Eigen::VectorXd asked() const { return modes_ * rigid_pushed_; }
  /// Its size over the largest rate of these contacts, and of those that stick. A wedge of angle a between two of them makes
  /// it 1/a; a lever, the ratio of its arms. Contacts that yield ask for nothing.
  double leverage() const { return rigid_pushed_.norm() / (fastest_asked_ + resolution_); }
  bool closed(Eigen::Index contact) const {
    return closed_[static_cast<std::size_t>(contact)] != 0;
  }                                                  ///< at the moment
  double resolution() const { return resolution_; }  ///< of D s - b [m/s]
  /// Contacts as they are now are a guess: how often they changed until here does not count.
  void forget_changes() { changes_ = 0, smooth_ = false; }

 private:
  void restrict();
  void find_leverage(const Eigen::VectorXd& rates);
  Eigen::Index yielding() const { return modes_.cols() - basis_.cols(); }  // how many yield
  Eigen::MatrixXd held() const;                        // rows of closed contacts, then of those that stick
  Eigen::MatrixXd rubbed(Eigen::MatrixXd held) const;  // with the friction of those that slide
  /// Impulses on what was held, and below which impulses and velocities are roundoff.
  struct Found;
  bool open_and_close(const Eigen::VectorXd& rate, const Eigen::MatrixXd& slide, const Found& found);
  bool stick_and_slide(const Eigen::MatrixXd& slide, const Found& found);
  Eigen::VectorXd amplitudes(const Eigen::VectorXd& velocity) const;

  Eigen::VectorXd unit_, origin_, known_;    // s_0; Z^T (impulse - M (s_0 - s_before))
  Eigen::MatrixXd modes_, basis_, inertia_;  // basis: Z in scaled velocities, orthonormal
  Eigen::MatrixXd contacts_;                 // D Z
  Eigen::VectorXd least_;                    // b - D s_0
  double resolution_ = 0;
  std::vector<char> closed_;
  int changes_ = 0;
  Eigen::MatrixXd tangents_;  // T Z
  Eigen::VectorXd along_;     // -T s_0
  double friction_ = 0;
  std::vector<char> sticks_;      // of the contacts that rub, while closed
  Eigen::MatrixXd ways_;          // n of those that slide, a column each; 0 of others
  bool smooth_ = false;           // no end was found with friction
  Eigen::VectorXd pushed_;        // amplitudes that closed contacts ask for
  Eigen::VectorXd rigid_pushed_;  // those that do not yield alone
  double fastest_asked_ = 0;      // of their rates, and of those that stick
  Eigen::MatrixXd directions_, workless_;
  Eigen::MatrixXd pushing_;  // rows along which closed contacts push, then those that stick
};

}  // namespace splashdown::rigid
