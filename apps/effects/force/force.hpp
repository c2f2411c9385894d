// [[body.force]]: thrust, a push, a crane: forces and moments that the scene gives.
#pragma once

#include "apps/scene/kinds/effect_kind.hpp"

namespace splashdown::apps {

struct ForceTable {
  std::size_t body = 0;
  std::string axes = "body";                ///< "body" | "world": what the components are along
  std::vector<std::vector<double>> force;   ///< rows of a time and components [s, N; 2D: N/m]
  std::vector<std::vector<double>> moment;  ///< the same about the centre of mass [s, N m; 2D: N]
  std::optional<Point> point;               ///< where it acts, shape's frame [m]; default: the centre of mass
};

struct ForceTables {
  std::vector<ForceTable> all;
};

class ForceKind final : public EffectOf<ForceKind, ForceTables> {
 public:
  std::string_view name() const override { return "force"; }
  bool knows_no_mesh() const override { return true; }
  TablePlace place() const override { return TablePlace::body_array; }
  void read(Reader& reader, Scene& scene) const override;
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
