// Lines: what pulls a body towards another one or a place, and never pushes.
//
//   T = max(0, k (l - L) + c dl/dt),  l > L          a straight one without weight; k = EA/L
//   T from H, V of lines/catenary.hpp                 a catenary, quasi-static
//   m_c du/dt = m_c g - (rho/2) C_dA(t) |u| u + T n   a canopy at the far end, air at rest
//
// All are implicit (pull.hpp): no step is too long, however stiff a line is. A catenary's force is linearised at the middle of
// the step before and, where it stiffens, by its secant to where the body is carried. The canopy is a point; its velocity at the
// end of a step is eliminated from the line's equation, its drag linear in that with the speed that it had: first order in time.
// Drag area grows as the square of time while a canopy opens (Knacke, Parachute Recovery Systems Design Manual, 1992, section
// 5.4).
#pragma once

#include <optional>
#include <string>

#include "rigid/forces/force.hpp"
#include "rigid/lines/catenary.hpp"

namespace splashdown::rigid {

/// A place of a body, or of the world.
template <int d>
struct LineEnd {
  std::optional<std::size_t> body = {};  ///< index; none: the world
  Vec<d> point = Vec<d>::Zero();         ///< in its frame, whose origin is the centre of mass, or the world's [m]
};

/// A canopy on the far end of a line.
template <int d>
struct Canopy {
  double mass = 0;                         ///< [kg; 2D: kg/m]
  double drag_area = 0;                    ///< C_d A when it is open [m^2; 2D: m]
  double start = 0;                        ///< when it begins to open [s]
  double inflation = 0;                    ///< how long it opens [s]
  double air_density = 1.225;              ///< [kg/m^3]
  Vec<d> gravity = Vec<d>::Zero();         ///< [m/s^2]
  std::optional<double> water_level = {};  ///< on which it stays lying [m]
};

/// When a line lets go for good; the first of these.
struct LineRelease {
  std::optional<double> time = {};       ///< [s]
  std::optional<double> load = {};       ///< mean tension over a kick above this [N; 2D: N/m]
  std::optional<std::size_t> wets = {};  ///< this body's hull touches water
};

/// What a line is made from.
template <int d>
struct LineSpec {
  std::string name;     ///< of the scene
  LineEnd<d> from;      ///< of a body
  LineEnd<d> to;        ///< of another one or the world; of a canopy where it is at t = 0, world frame
  double length = 0;    ///< slack, L [m]
  Stretch spring = {};  ///< of a straight line
  std::optional<CatenarySpec> catenary = {};  ///< instead of the spring; `to` is its anchor
  std::optional<Canopy<d>> canopy = {};       ///< at its far end
  LineRelease release = {};                   ///< when it lets go
};

/// Throws std::invalid_argument naming line, rule and value for a line that cannot be, among so many bodies.
template <int d>
void check(const LineSpec<d>& line, std::size_t bodies);

/// A line and what became of it.
template <int d>
class Line final : public Force<d> {
 public:
  /// Throws like `check` where no number of bodies is needed.
  explicit Line(LineSpec<d> spec);
  std::string name() const override { return spec_.name; }
  void add(const BodiesAt<d>& at, std::span<Wrench<d>> wrenches) const override;
  void pull(const BodiesAt<d>& at, std::vector<Pull<d>>& pulls) const override;
  void commit(const BodiesAt<d>& at) override;
  /// tension: mean over the kick [N; 2D: N/m]; length between its ends [m]; of a catenary on_floor [m] and anchor_tension at t_n;
  /// of a canopy its place [m] and drag area.
  std::vector<Diagnostic> diagnostics(const BodiesAt<d>& at) const override;
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;

  /// Mean over the kick of the step that was tried; 0 without one [N; 2D: N/m].
  double tension(const BodiesAt<d>& at) const;
  /// Whether it has been let go.
  bool released() const { return released_; }
  const Vec<d>& canopy_place() const { return place_; }        ///< at t_n, world frame [m]
  const Vec<d>& canopy_velocity() const { return velocity_; }  ///< at t_{n-1/2} [m/s]

 private:
  struct Ends;
  struct FreeCanopy;
  bool holds(const BodiesAt<d>& at) const;
  Ends ends(const BodiesAt<d>& at) const;
  FreeCanopy free_canopy(const BodiesAt<d>& at) const;
  std::vector<Pull<d>> pulls(const BodiesAt<d>& at) const;
  double drag_area(double time) const;

  LineSpec<d> spec_;
  bool released_ = false;
  bool flies_ = false;  // the canopy has a velocity of its own; before, that of what it is tied to
  Vec<d> place_, velocity_;
};

extern template class Line<2>;
extern template class Line<3>;

}  // namespace splashdown::rigid
