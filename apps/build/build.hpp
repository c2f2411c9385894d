// Scene to World: the only place that chooses types.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "apps/build/hooks.hpp"
#include "apps/build/whole.hpp"
#include "apps/record/settings.hpp"
#include "apps/scene/scene.hpp"
#include "core/solids_view.hpp"
#include "coupling/schemes/stepper.hpp"
#include "fluid/ale/spec.hpp"
#include "fluid/pfem/fluid.hpp"
#include "fluid/pfem/mesh/sizes/size_sources.hpp"
#include "fluid/vortex/spec.hpp"
#include "rigid/bodies.hpp"

namespace splashdown::apps {

/// What a run drives and what its recorder looks at.
template <int d>
struct World {
  std::unique_ptr<coupling::Stepper> stepper;  ///< owns the parts
  const FluidView<d>* fluid = nullptr;         ///< null: no fluid in the scene
  const rigid::Bodies<d>* bodies = nullptr;    ///< null: no rigid bodies in the scene
  const SolidsView<d>* solids = nullptr;       ///< null: no elastic bodies in the scene
  std::unique_ptr<Whole<d>> whole = nullptr;   ///< how the scene is told; null: as it is simulated
};

/// Throws std::invalid_argument if the parts refuse what the scene asks for. `meanwhile`: FluidSpec::while_meshing.
template <int d>
World<d> build_world(const Scene& scene, std::function<void()> meanwhile = {}, Hooks<d> hooks = {});
/// Bodies with forces, joints and contacts.
template <int d>
std::unique_ptr<rigid::Bodies<d>> bodies_of(const Scene& scene);

/// Walls: one a body, in their order, then the tank if there is one.
template <int d>
fluid::FluidSpec<d> fluid_spec(const Scene& scene);
/// The wall that a body is to a fluid: rigid, or with the skin of its solid, which deforms.
template <int d>
WallSpec<d> wall_of(const Scene& scene, std::size_t body);
/// Of a fluid on a grid, with the same walls.
vortex::GridFlowSpec vortex_spec(const Scene& scene);
/// Of a fluid on a mesh that moves with bodies, with a wall each.
ale::AleFlowSpec ale_spec(const Scene& scene);
/// What the effects of a scene make.
template <int d>
struct Parts {
  std::vector<std::unique_ptr<fluid::Effect<d>>> effects;  ///< of the fluid
  std::vector<std::unique_ptr<rigid::Force<d>>> forces;    ///< on bodies
};
template <int d>
Parts<d> parts_of(const Scene& scene);
/// A place where a body's hull is curved.
template <int d>
struct HullBend {
  fluid::Vec<d> at;     ///< world frame, at t = 0
  double radius, size;  ///< of curvature; of the elements there [m]
};
template <int d>
std::vector<HullBend<d>> hull_bends(const Scene& scene, const Body& body);
/// Where elements are smaller than on the hull around it, at tight bends and corners: world frame, at t = 0.
template <int d>
std::vector<fluid::SizeSource<d>> hull_spots(const Scene& scene, const Body& body);
template <int d>
rigid::BodySpec<d> body_spec(const Body& body);
std::vector<rigid::JointSpec> joint_specs(const Scene& scene);
template <int d>
std::optional<rigid::ContactSpec<d>> contact_spec(const Scene& scene);
/// Of the body of a record of section loads.
template <int d>
MassDistribution<d> spread_mass(const Body& body, const SectionEntry& entry);
template <int d>
RecorderSettings<d> recorder_settings(const Scene& scene, const std::filesystem::path& directory);

}  // namespace splashdown::apps
