// A rigid wall inside the fluid: what it covers, the passes that make the fluid in it rigid, and what they cost in
// impulse.
//
//   f_k = -theta (u_k - N s),   u_{k+1} = u_k + P f_k,   f = sum f_k = f_0 + F s,   J = -rho int N^T f
//
// theta = chi, or lambda dt chi/(1 + lambda dt) with a finite rate (Angot, Bruneau & Fabrie, Numer. Math. 81, 1999).
// f is linear in the twist s, so that one set of passes with the fluid's velocity and one for each of three twists
// answers every s. With the last step's f as a prediction (half before the flow moves, half after, carried along with
// the body) few passes are enough.
#pragma once

#include <array>
#include <iosfwd>
#include <map>
#include <utility>
#include <vector>

#include "core/fluid_view.hpp"
#include "fluid/vortex/penalised/outline.hpp"
#include "fluid/vortex/poisson/box_projection.hpp"

namespace splashdown::vortex {

/// Projections of boxes of all sizes that have been asked for.
class Projections {
 public:
  /// That of a box of so many nodes.
  BoxProjection& of(int width, int height);

 private:
  std::map<std::pair<int, int>, BoxProjection> known_;
};

/// A field on the faces of a box.
struct BoxField {
  FaceBox box;
  FaceField field;
};

/// Impulse on a wall for its twist, about its reference point: I(s) = constant - answer s.
struct ImpulseLaw {
  Wrench<2> constant = Wrench<2>::Zero();
  Eigen::Matrix3d answer = Eigen::Matrix3d::Zero();  ///< symmetric: added mass as far as the passes see it
};

/// One wall: its cover, its forces of the last step and the passes of the one under way.
class PenalisedWall {
 public:
  /// `smoothing`: half width of chi's ramp, in squares; `stream`: velocity of the fluid inside at t = 0 [m/s].
  PenalisedWall(const Grid& grid, const WallSpec<2>& spec, double smoothing, const Vec<2>& stream);

  /// Adds half of the last step's forces to the vorticity, for a step that is `ratio` times as long. What its box had before:
  NodeField predict_before(NodeField& omega, double ratio) const;
  /// Puts that back, bit for bit.
  void forget_prediction(const NodeField& without, NodeField& omega) const;
  /// Covers the grid at a pose, and adds the other half where the wall is now.
  void cover_at(const Isometry<2>& pose, NodeField& omega, double ratio);
  /// Whether its box, with the nodes that the kernels reach, lies in the grid.
  bool is_on_grid() const;
  /// The passes from this velocity. `share`: theta over chi.
  void make_rigid(const FaceField& velocity, double share, int passes, Projections& projections);
  /// Before passes of all walls together (pass_from): nothing has been found.
  void begin_passes();
  /// One of them, for what nobody moves (mode -1) or a unit twist of `mover`, another wall or this one: forces from a
  /// velocity of the whole grid are added to what was found, and their curl to a vorticity.
  void pass_from(const FaceField& velocity, double share, std::size_t mover, int mode, bool is_mover, NodeField& curl);
  /// Impulse on this wall for the twist of another, I = -answer s, about this one's reference point; zero but after joint passes.
  Eigen::Matrix3d answer_to(std::size_t mover, double density) const;
  /// Another wall has this twist at the end of the step.
  void settle_answer_to(std::size_t mover, const Twist<2>& twist);
  /// int f and int r x f of the step under way, for a twist that it ends with; what passes of this step found, and all.
  std::pair<Wrench<2>, Wrench<2>> sums(const Twist<2>& twist, double ratio) const;
  /// What the passes found, with what fills the wall: `kick` [s], gravity [m/s^2].
  ImpulseLaw law(double density, double kick, double ratio, const Vec<2>& gravity) const;
  /// Added mass by conjugate gradients to 1e-6: theta P theta f = theta N a.
  Eigen::Matrix3d added_mass(double density, Projections& projections) const;
  /// Forces of the step under way per kick [m/s^2], for a twist that it ends with: those of the passes and their
  /// prediction.
  void add_forces(const Twist<2>& twist, double kick, double ratio, FaceField& forces) const;
  /// The step ends with this twist: the vorticity gets curl f. `predicts`: f is a prediction of the next step's,
  /// which that of an impact is not.
  void settle(const Twist<2>& twist, NodeField& omega, bool predicts);
  /// Where both cover more than a whole face, each gets its share.
  void divide_with(PenalisedWall& other);

  /// Of its outline, in its own frame.
  const OutlineMoments& moments() const { return moments_; }
  /// What it covers in the step under way.
  const BoxField& chi() const { return chi_; }
  /// Twist of the fluid inside at t_{n-1/2}.
  const Twist<2>& filling() const { return filling_; }
  /// Writes the state at t_n, bit for bit.
  void save(std::ostream& out) const;
  /// Reads it; std::runtime_error for what does not fit the grid.
  void load(std::istream& in);

 private:
  template <class Visit>
  void visit(const BoxField& on, Visit visit) const;
  void add_curl_of(const BoxField& f, double factor, NodeField& omega) const;
  Wrench<2> impulse_of(const BoxField& f, const Vec<2>& about) const;
  void carry(double ratio);

  Grid grid_;
  Surface<2> outline_;
  OutlineMoments moments_;
  double width_;  // of the smoothing [m]
  // At t_n.
  BoxField force_;      // [m/s]: of the last step
  Isometry<2> placed_;  // where it was covered then
  Twist<2> filling_;
  // Of the step under way.
  BoxField chi_, predicted_, found_;
  std::array<FaceField, 3> answers_;
  std::map<std::size_t, std::array<FaceField, 3>> answers_to_;  // other walls' unit twists
  Isometry<2> pose_;
  bool is_covered_ = false;
};

}  // namespace splashdown::vortex
