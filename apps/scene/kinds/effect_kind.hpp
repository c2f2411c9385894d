// What the program knows of an effect: its table, rules, parts, numbers and questions. One folder in apps/effects and one row in
// apps/effects/registry.cpp make an effect known to reader, schema, check, build, run and report.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/limit.hpp"
#include "apps/scene/outlook/advice.hpp"
#include "apps/scene/outlook/outlook.hpp"
#include "apps/scene/scales.hpp"
#include "apps/scene/scene.hpp"
#include "core/bodies_view.hpp"
#include "core/mirror.hpp"

namespace splashdown::fluid {
template <int d>
class Effect;
template <int d>
struct FluidSpec;
}  // namespace splashdown::fluid
namespace splashdown::rigid {
template <int d>
class Force;
struct JointSpec;
}  // namespace splashdown::rigid

namespace splashdown::apps {

class Problems;
class Reader;

/// What effects add to a simulation.
template <int d>
struct EffectParts {
  std::vector<std::unique_ptr<fluid::Effect<d>>>& fluid;  ///< terms of the fluid's equations
  std::vector<std::unique_ptr<rigid::Force<d>>>& forces;  ///< on bodies
};

/// What bodies are made from.
template <int d>
struct BodyParts {
  std::vector<BodySpec<d>>& specs;
  std::vector<std::unique_ptr<rigid::Force<d>>>& forces;  ///< of all effects
  std::vector<rigid::JointSpec>& joints;
};

/// What questions of `check` about an effect need to know besides its table.
struct AskedScene {
  const Scene& scene;
  std::optional<double> level;  ///< of still water [m]
  double pull = 0;              ///< downward component of gravity [m/s^2]
};

/// An element size at the free surface that an effect asks for.
struct WantedSize {
  double size;      ///< [m]
  std::string why;  ///< such as "40 elements on waves of 2 m"
};

/// A number that is known without the run, for probes.csv.
struct KnownSignal {
  std::string name;
  std::function<double(double)> value;  ///< at a time [s]
};

/// Where the table of an effect stands.
enum class TablePlace {
  scene,         ///< [NAME], read before the bodies
  after_bodies,  ///< [NAME] that may name bodies
  array,         ///< [[NAME]] after the bodies, read once for each element
  fluid,         ///< [fluid.NAME]
  body,          ///< [body.NAME]; read for the last of scene.bodies
  body_array     ///< [[body.NAME]], the same, read once for each element
};

/// An effect of the catalogue. Made once, without state.
class EffectKind {
 public:
  virtual ~EffectKind() = default;
  virtual std::string_view name() const = 0;                      ///< of its table
  virtual TablePlace place() const { return TablePlace::scene; }  ///< of its table
  virtual bool present(const Scene& scene) const = 0;             ///< the scene has the table
  /// Acts on bodies alone, or on any fluid: goes with each formulation.
  virtual bool knows_no_mesh() const { return false; }
  virtual void read(Reader& reader, Scene& scene) const = 0;                   ///< its table, which is there
  virtual void check(const Scene& /*scene*/, Problems& /*problems*/) const {}  ///< rules that join several keys
  /// Adds what follows from all keys of a scene in which nothing is wrong.
  virtual void complete(Scene& /*scene*/) const {}
  virtual void ask(const AskedScene& /*asked*/, std::vector<std::string>& /*questions*/) const {}
  /// Whether it matters in this scene, present or absent, by which numbers; nothing: not a word about it.
  virtual std::optional<EffectNote> note(const Scene& scene, const Scales& scales) const = 0;
  /// The same at length: numbers, expected changes with their source, and the keys that add it. Nothing: `note` is all there is.
  virtual std::optional<Advice> advise(const Outlook& /*look*/) const { return {}; }
  /// Elements at the free surface, where the scene leaves them to the program; nothing: no wish.
  virtual std::optional<WantedSize> surface_size(const Scene& /*scene*/) const { return {}; }
  /// Rows of probes.csv beside what is measured, such as the sea without bodies.
  virtual std::vector<KnownSignal> signals(const Scene& /*scene*/) const { return {}; }
  /// Numbers of a run that it adds, by name (scene/numbers.hpp).
  virtual std::vector<NamedNumber> numbers(const Scene& /*scene*/) const { return {}; }
  /// Changes what the fluid is made from; after its own regions and walls are in.
  virtual void prepare(const Scene& scene, fluid::FluidSpec<2>& spec) const = 0;
  virtual void prepare(const Scene& scene, fluid::FluidSpec<3>& spec) const = 0;
  /// Changes what the bodies are made from; called only where it is present, after `build` of all.
  virtual void prepare(const Scene& /*scene*/, const BodyParts<2>& /*parts*/) const {}
  virtual void prepare(const Scene& /*scene*/, const BodyParts<3>& /*parts*/) const {}
  /// The plane that ends what is simulated, if the effect is present and there is one.
  virtual std::optional<Mirror> mirror(const Scene& /*scene*/) const { return {}; }
  /// Why the effect, which is present, is not its own mirror image, as the end of a sentence about its table; nothing: it is.
  virtual std::optional<std::string> asymmetry(const Scene& /*scene*/, const Mirror& /*mirror*/) const {
    return "is not known to be its own mirror image";
  }
  /// Adds its parts; called only where it is present. Without a fluid in the scene parts of the fluid are dropped.
  virtual void build(const Scene& scene, const EffectParts<2>& parts) const = 0;
  virtual void build(const Scene& scene, const EffectParts<3>& parts) const = 0;
};

/// An effect whose table is a `Table` in Scene::effects. `Kind` may have build_in<d>, prepare_in<d>.
template <class Kind, class Table>
class EffectOf : public EffectKind {
 public:
  bool present(const Scene& scene) const override { return scene.effects.find<Table>() != nullptr; }
  void prepare(const Scene& scene, fluid::FluidSpec<2>& spec) const override {
    self().template prepare_in<2>(scene, spec);
  }
  void prepare(const Scene& scene, fluid::FluidSpec<3>& spec) const override {
    self().template prepare_in<3>(scene, spec);
  }
  void build(const Scene& scene, const EffectParts<2>& parts) const override {
    self().template build_in<2>(scene, parts);
  }
  void build(const Scene& scene, const EffectParts<3>& parts) const override {
    self().template build_in<3>(scene, parts);
  }

 protected:
  template <int d>
  void prepare_in(const Scene& /*scene*/, fluid::FluidSpec<d>& /*spec*/) const {}
  template <int d>
  void build_in(const Scene& /*scene*/, const EffectParts<d>& /*parts*/) const {}

 private:
  const Kind& self() const { return static_cast<const Kind&>(*this); }
};

/// All effects, in the order in which they are read, built and told (apps/effects/registry.cpp).
std::span<const EffectKind* const> effect_kinds();

}  // namespace splashdown::apps
