#include "apps/build/build.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "apps/build/formulations.hpp"
#include "apps/effects/elastic/solid.hpp"
#include "apps/scene/kinds/coupling_kinds.hpp"
#include "apps/scene/kinds/effect_kind.hpp"
#include "apps/scene/mirror.hpp"
#include "coupling/accelerators/quasi_newton.hpp"
#include "coupling/composite.hpp"
#include "coupling/schemes/steppers.hpp"
#include "elastic/participant.hpp"
#include "fluid/ale/participant.hpp"
#include "fluid/pfem/participant.hpp"
#include "fluid/vortex/participant.hpp"
#include "rigid/participant.hpp"

namespace splashdown::apps {
namespace {

using coupling::CouplingLimits;

CouplingLimits limits(const Coupling& coupling) {
  return {.tolerance = coupling.tolerance,
          .max_passes = coupling.max_passes,
          .fixed_passes =
              coupling.scheme == "staggered" ? named(accelerator_kinds(), coupling.accelerator).staggered_passes : 0};
}

/// Bodies that the fluid cannot move have nothing to agree about: one pass without a term.
Coupling one_way() { return {.scheme = "staggered", .interface_term = "none"}; }

/// A part for the stepper, and the fluid in it for who looks at it.
template <int d>
std::unique_ptr<coupling::FluidPart> build_fluid(const Scene& scene,
                                                 std::vector<std::unique_ptr<fluid::Effect<d>>> effects,
                                                 std::function<void()> meanwhile, World<d>& world) {
  auto spec = fluid_spec<d>(scene);
  spec.while_meshing = std::move(meanwhile);
  auto part = std::make_unique<fluid::Participant<d>>(
      std::make_unique<fluid::Fluid<d>>(std::move(spec), std::move(effects), formulation<d>(*scene.fluid)));
  world.fluid = &part->fluid();
  return part;
}

/// The same of a fluid on a grid, which is plane.
template <int d>
std::unique_ptr<coupling::FluidPart> build_vortex(const Scene& scene, World<d>& world) {
  if constexpr (d == 2) {
    auto part = std::make_unique<vortex::Participant>(std::make_unique<vortex::GridFlow>(vortex_spec(scene)));
    world.fluid = &part->fluid();
    return part;
  } else {
    throw std::invalid_argument("fluid.formulation: \"vortex\" is plane");
  }
}

/// The same of a fluid on a mesh that moves with bodies.
template <int d>
std::unique_ptr<coupling::FluidPart> build_ale(const Scene& scene, World<d>& world) {
  if constexpr (d == 2) {
    auto part = std::make_unique<ale::Participant>(std::make_unique<ale::AleFlow>(
        ale::adapted(ale_spec(scene), scene.ale->adapt, scene.time.dt_max, scene.ale->ramp)));
    world.fluid = &part->fluid();
    return part;
  } else {
    throw std::invalid_argument("fluid.formulation: \"ale\" is plane");
  }
}

template <int d>
void prescribe(const std::string& name, const std::function<rigid::Isometry<d>(double)>& path,
               std::vector<rigid::BodySpec<d>>& specs) {
  const auto body = std::ranges::find(specs, name, &rigid::BodySpec<d>::name);
  if (body == specs.end() || body->motion != BodyMotion::prescribed)
    throw std::invalid_argument("path: no body named '" + name + "' has motion = \"prescribed\"");
  const double reach = body->surface.vertices.colwise().norm().maxCoeff(), roundoff = 1e-9;
  const auto begin = path(0);
  if ((begin.matrix() - body->pose.matrix()).cwiseAbs().maxCoeff() > roundoff * std::max(1., reach))
    throw std::invalid_argument("path: at t = 0 it must have '" + name + "' where the scene puts it");
  body->path = path;
}

template <int d>
std::unique_ptr<rigid::Bodies<d>> bodies_with(const Scene& scene, std::vector<std::unique_ptr<rigid::Force<d>>> forces,
                                              const Hooks<d>& hooks = {}) {
  std::vector<rigid::BodySpec<d>> specs;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (!deforms(scene, i)) specs.push_back(body_spec<d>(scene.bodies[i]));
  for (const auto& [name, path] : hooks.paths) prescribe<d>(name, path, specs);
  auto joints = joint_specs(scene);
  for (const auto* kind : effect_kinds())
    if (kind->present(scene)) kind->prepare(scene, BodyParts<d>{specs, forces, joints});
  return std::make_unique<rigid::Bodies<d>>(std::move(specs), std::move(forces), std::move(joints),
                                            contact_spec<d>(scene));
}

template <int d>
std::unique_ptr<coupling::StructurePart> build_bodies(std::unique_ptr<rigid::Bodies<d>> bodies, World<d>& world) {
  auto part = std::make_unique<rigid::Participant<d>>(std::move(bodies));
  world.bodies = &part->bodies();
  return part;
}

/// Bodies that deform: they stand behind the rigid ones.
template <int d>
std::unique_ptr<coupling::StructurePart> build_solids(const Scene& scene, World<d>& world) {
  auto specs = solid_specs<d>(scene);
  const auto& tables = scene.effects.find<ElasticTables>()->of_bodies;
  for (std::size_t i = 0; i < specs.size(); ++i) specs[i].body = body_spec<d>(scene.bodies[tables[i].body]);
  auto part = std::make_unique<elastic::Participant<d>>(std::move(specs));
  world.solids = part.get();
  return part;
}

/// All bodies: rigid ones, elastic ones, or both as one structure.
template <int d>
std::unique_ptr<coupling::StructurePart> build_structure(const Scene& scene,
                                                         std::vector<std::unique_ptr<rigid::Force<d>>> forces,
                                                         const Hooks<d>& hooks, World<d>& world) {
  const auto* tables = scene.effects.find<ElasticTables>();
  const bool all_deform = tables && tables->of_bodies.size() == scene.bodies.size();
  std::vector<std::unique_ptr<coupling::StructurePart>> parts;
  if (!all_deform) parts.push_back(build_bodies<d>(bodies_with<d>(scene, std::move(forces), hooks), world));
  if (tables) parts.push_back(build_solids<d>(scene, world));
  if (parts.size() == 1) return std::move(parts.front());
  return std::make_unique<coupling::Composite>(std::move(parts));
}

/// Added masses are of a step under way.
bool may_wait(const Scene& scene) {
  return std::ranges::none_of(scene.records,
                              [](const auto& record) { return std::holds_alternative<AddedMassEntry>(record); });
}

std::unique_ptr<coupling::Coupled> coupled_stepper(const Coupling& coupling, std::unique_ptr<coupling::FluidPart> fluid,
                                                   std::unique_ptr<coupling::StructurePart> bodies) {
  const auto& term = named(interface_kinds(), coupling.interface_term);
  if (!term.make)
    return std::make_unique<coupling::Simultaneous>(std::move(fluid), std::move(bodies), coupling.max_passes);
  return std::make_unique<coupling::Partitioned>(std::move(fluid), std::move(bodies), term.make(),
                                                 named(accelerator_kinds(), coupling.accelerator).make(coupling),
                                                 limits(coupling));
}

}  // namespace

template <int d>
std::unique_ptr<rigid::Bodies<d>> bodies_of(const Scene& scene) {
  return bodies_with<d>(scene, std::move(parts_of<d>(scene).forces));
}

template <int d>
World<d> build_world(const Scene& scene, std::function<void()> meanwhile, Hooks<d> hooks) {
  World<d> world;
  auto parts = parts_of<d>(scene);
  std::ranges::move(hooks.forces, std::back_inserter(parts.forces));
  auto fluid = scene.fluid    ? build_fluid<d>(scene, std::move(parts.effects), std::move(meanwhile), world)
               : scene.vortex ? build_vortex<d>(scene, world)
               : scene.ale    ? build_ale<d>(scene, world)
                              : nullptr;
  auto bodies =
      fluid && scene.bodies.empty() ? nullptr : build_structure<d>(scene, std::move(parts.forces), hooks, world);
  if (!fluid)
    world.stepper = std::make_unique<coupling::StructureOnly>(std::move(bodies), scene.time.dt_max);
  else if (!bodies)
    world.stepper = std::make_unique<coupling::FluidOnly>(std::move(fluid));
  else {
    auto both = coupled_stepper(scene.coupling.value_or(one_way()), std::move(fluid), std::move(bodies));
    if (may_wait(scene)) both->let_fluid_wait();
    world.stepper = std::move(both);
  }
  if (const auto mirror = mirror_of(scene); mirror && world.fluid)
    world.whole = std::make_unique<Whole<d>>(*mirror, *world.fluid, world.bodies);
  return world;
}

template World<2> build_world<2>(const Scene&, std::function<void()>, Hooks<2>);
template World<3> build_world<3>(const Scene&, std::function<void()>, Hooks<3>);
template std::unique_ptr<rigid::Bodies<2>> bodies_of<2>(const Scene&);
template std::unique_ptr<rigid::Bodies<3>> bodies_of<3>(const Scene&);

}  // namespace splashdown::apps
