// [[line]]: ropes, risers of parachutes and mooring lines: they pull and never push.
#pragma once

#include "apps/scene/kinds/effect_kind.hpp"

namespace splashdown::apps {

/// A chain or rope with weight between its body and its anchor.
struct CatenaryEntry {
  double weight = 0;                ///< a metre, under water [N/m; 2D: for each metre of depth]
  std::string floor = "at_anchor";  ///< "at_anchor": the anchor stands on a floor that carries the line | "none"
  double friction = 0;              ///< of the floor
};

/// What a parachute is made from.
struct CanopyEntry {
  Point position = Point::Zero();  ///< at t = 0 [m]
  double mass = 0;                 ///< [kg, kg/m]
  double drag_area = 0;            ///< drag coefficient times area, open [m^2, m]
  double start = 0;                ///< when it begins to open [s]
  double inflation = 0;            ///< how long it opens [s]
  double air_density = 1.225;      ///< [kg/m^3]; at sea level, 15 C
};

/// When a line lets go, the first of them; all absent: never.
struct ReleaseEntry {
  std::optional<double> time;       ///< [s]
  std::optional<double> load;       ///< tension above this [N, N/m]
  std::optional<std::size_t> wets;  ///< this body touches water
};

struct LineEntry {
  std::string name;
  std::size_t body = 0;
  Point point = Point::Zero();            ///< where it is tied, in the shape's frame [m]
  std::optional<std::size_t> other;       ///< its far end is on this body ...
  Point other_point = Point::Zero();      ///< ... here, in the shape's frame [m]
  std::optional<Point> anchor;            ///< or at a place of the world [m]
  std::optional<CanopyEntry> canopy;      ///< or a parachute
  double length = 0;                      ///< slack [m]
  std::optional<double> stiffness;        ///< [N/m; 2D: N/m^2]
  std::optional<double> axial_stiffness;  ///< EA [N; 2D: N/m]
  double damping = 0;                     ///< [N s/m; 2D: N s/m^2]
  std::optional<CatenaryEntry> catenary;  ///< absent: straight, without weight
  ReleaseEntry release;
  std::string path;  ///< of its table, for messages
};

/// The lines of a scene.
struct Lines {
  std::vector<LineEntry> all;
};

class LinesKind final : public EffectOf<LinesKind, Lines> {
 public:
  std::string_view name() const override { return "line"; }
  bool knows_no_mesh() const override { return true; }
  TablePlace place() const override { return TablePlace::array; }
  void read(Reader& reader, Scene& scene) const override;
  void check(const Scene& scene, Problems& problems) const override;
  void ask(const AskedScene& asked, std::vector<std::string>& questions) const override;
  std::optional<EffectNote> note(const Scene& scene, const Scales& scales) const override;
  std::optional<std::string> asymmetry(const Scene& scene, const Mirror& mirror) const override;

 private:
  friend EffectOf;
  template <int d>
  void build_in(const Scene& scene, const EffectParts<d>& parts) const;
};

/// Where both ends are at t = 0, world frame [m].
struct LineEnds {
  Point from, to;
  double apart() const { return (from - to).norm(); }
};
LineEnds ends_at_start(const Scene& scene, const LineEntry& line);
/// k, or EA/L [N/m; 2D: N/m^2].
double stiffness_of(const LineEntry& line);

}  // namespace splashdown::apps
