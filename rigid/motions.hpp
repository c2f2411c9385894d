// Velocities that bodies can have together, and how they answer to impulses. Internal to the rigid-body room.
//
//   E s = a                       held freedoms, fixed and prescribed bodies, joints
//   D s >= b                      contacts
//   M (s - s_before) = impulse + E^T l + D^T r,   r >= 0,   r (D s - b) = 0
//
// Solved in coordinates: s = s_0 + Z y with Z a basis of the motions that E leaves, and y in the directions W that
// the closed contacts leave. Which contacts are closed is found by the primal-dual active set method (Hintermueller,
// Ito, Kunisch 2002): a closed contact that pulls opens, an open one that would be crossed closes. It may run in
// circles; after a few changes only the first contact that is wrong changes (Murty 1974), which ends where contacts
// are independent of each other.
// Nothing divides by M: bodies may lack mass where something else, the water, has inertia for them.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace splashdown::rigid {

class Motions {
 public:
  struct Problem {
    Eigen::VectorXd before;      ///< s_before
    Eigen::VectorXd unit;        ///< lengths that make all velocities m/s: 1, or m/rad
    Eigen::MatrixXd equalities;  ///< E
    Eigen::VectorXd equal;       ///< a
    Eigen::MatrixXd contacts;    ///< D
    Eigen::VectorXd least;       ///< b
    double resolution = 0;       ///< of D s - b: smaller violations are roundoff [m/s]
    Eigen::MatrixXd inertia;     ///< M
    Eigen::VectorXd impulse;     ///< known already [N s]
  };
  Motions() = default;
  explicit Motions(const Problem& problem);

  const Eigen::MatrixXd& modes() const { return modes_; }            ///< Z
  const Eigen::MatrixXd& inertia() const { return inertia_; }        ///< Z^T M Z
  const Eigen::MatrixXd& directions() const { return directions_; }  ///< W
  /// Velocity under a further impulse; motions without inertia get none.
  Eigen::VectorXd velocity(const Eigen::VectorXd& impulse) const;
  /// Impulse on the motions that such a velocity does not account for: Z^T impulse - (Z^T M Z) y.
  Eigen::VectorXd unspent(const Eigen::VectorXd& velocity, const Eigen::VectorXd& impulse) const;
  /// Opens and closes contacts as velocity and impulse ask for. False: they were right.
  bool update_contacts(const Eigen::VectorXd& velocity, const Eigen::VectorXd& impulse);

 private:
  void restrict();
  Eigen::VectorXd amplitudes(const Eigen::VectorXd& velocity) const;

  Eigen::VectorXd unit_, origin_, known_;    // s_0; Z^T (impulse - M (s_0 - s_before))
  Eigen::MatrixXd modes_, basis_, inertia_;  // basis: Z in scaled velocities, orthonormal
  Eigen::MatrixXd contacts_;                 // D Z
  Eigen::VectorXd least_;                    // b - D s_0
  double resolution_ = 0;
  std::vector<char> closed_;
  int contact_changes_ = 0;  // how often contacts changed
  Eigen::VectorXd pushed_;   // amplitudes that closed contacts ask for
  Eigen::MatrixXd directions_;
};

}  // namespace splashdown::rigid
