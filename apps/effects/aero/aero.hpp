// [body.aero]: loads of the air on a body, by coefficients.
#pragma once

#include "apps/scene/kinds/effect_kind.hpp"

namespace splashdown::apps {

/// Rows of an angle [deg] and a coefficient; one: a constant, none: 0.
using Coefficient = std::vector<std::vector<double>>;

struct AeroTable {
  std::size_t body = 0;
  double density = 1.225;                      ///< of the air [kg/m^3]; standard atmosphere at sea level
  double area = 0;                             ///< that coefficients refer to [m^2; 2D: a length, m]
  std::optional<double> length;                ///< that pitching moments refer to [m]
  std::optional<double> span;                  ///< that moments of roll and yaw refer to [m]
  Point nose = Point::UnitX();                 ///< forward, shape's frame
  Point up = Point::UnitY();                   ///< shape's frame
  std::optional<Point> point;                  ///< where the forces act, shape's frame [m]; default: the centre of mass
  Coefficient drag, lift, moment;              ///< over the angle of attack
  Coefficient side, roll, yaw, sideslip_drag;  ///< over the angle of sideslip
  double roll_damping = 0, pitch_damping = 0, yaw_damping = 0;
};

struct AeroTables {
  std::vector<AeroTable> of_bodies;
};

class AeroKind final : public EffectOf<AeroKind, AeroTables> {
 public:
  std::string_view name() const override { return "aero"; }
  TablePlace place() const override { return TablePlace::body; }
  void read(Reader& reader, Scene& scene) const override;
  void ask(const AskedScene& asked, std::vector<std::string>& questions) const override;
  std::optional<std::string> asymmetry(const Scene& scene, const Mirror& mirror) const override;
  std::optional<EffectNote> note(const Scene& scene, const Scales& scales) const override;

 private:
  friend EffectOf;
  template <int d>
  std::optional<std::string> asymmetry_in(const Scene& scene, const Mirror& mirror) const;
  template <int d>
  void build_in(const Scene& scene, const EffectParts<d>& parts) const;
};

}  // namespace splashdown::apps
