// [symmetry]: a scene that is its own mirror image is simulated on one side of the mirror.
#pragma once

#include "apps/scene/kinds/effect_kind.hpp"

namespace splashdown::apps {

/// The scene and what is told of it are those of the whole; bodies that straddle the plane are cut.
struct Symmetry {
  std::string normal = "y";  ///< axis across the plane: "x", in space "x" | "y"
  double at = 0;             ///< where the plane meets that axis [m]

  Mirror mirror() const { return {normal == "x" ? 0 : 1, at}; }
};

class SymmetryKind final : public EffectOf<SymmetryKind, Symmetry> {
 public:
  std::string_view name() const override { return "symmetry"; }
  void read(Reader& reader, Scene& scene) const override;
  void check(const Scene& scene, Problems& problems) const override;
  std::optional<EffectNote> note(const Scene& scene, const Scales& scales) const override;
  std::optional<Mirror> mirror(const Scene& scene) const override;
  std::optional<std::string> asymmetry(const Scene&, const Mirror&) const override { return {}; }
  void prepare(const Scene& scene, const BodyParts<2>& parts) const override;
  void prepare(const Scene& scene, const BodyParts<3>& parts) const override;
  using EffectOf::prepare;

 private:
  friend EffectOf;
  template <int d>
  void prepare_in(const Scene& scene, fluid::FluidSpec<d>& spec) const;
};

/// What of a scene is not its own mirror image: key, rule and cure.
struct Asymmetric {
  std::string key, rule, cure;
};
template <int d>
std::vector<Asymmetric> asymmetries(const Scene& scene, const Mirror& mirror);

/// The vertical plane through the middle of the tank about which a scene without [symmetry] is its own mirror image.
std::optional<Mirror> mirror_of_whole(const Scene& scene);

}  // namespace splashdown::apps
