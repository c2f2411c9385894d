#include "apps/build.hpp"

#include <algorithm>

#include "coupling/quasi_newton.hpp"
#include "coupling/steppers.hpp"

namespace splashdown::apps {
namespace {

using coupling::CouplingLimits;

std::unique_ptr<coupling::InterfaceTerm<2>> interface_term(const Coupling& coupling) {
  if (coupling.interface_term == "laplacian") return std::make_unique<coupling::LaplacianTerm<2>>();
  if (coupling.interface_term == "robin") return std::make_unique<coupling::RobinTerm<2>>();
  return std::make_unique<coupling::NoTerm<2>>();
}

std::unique_ptr<coupling::Accelerator> accelerator(const Coupling& coupling) {
  if (coupling.accelerator == "aitken") return std::make_unique<coupling::Aitken>(coupling.relaxation);
  if (coupling.accelerator == "anderson")
    return std::make_unique<coupling::Anderson>(coupling.relaxation, static_cast<std::size_t>(coupling.depth));
  if (coupling.accelerator == "broyden") return std::make_unique<coupling::Broyden>(coupling.relaxation);
  if (coupling.accelerator == "iqn_ils")
    return std::make_unique<coupling::IqnIls>(coupling.relaxation, static_cast<std::size_t>(coupling.reuse));
  if (coupling.accelerator == "probe") return std::make_unique<coupling::Probe>(coupling.relaxation);
  return std::make_unique<coupling::ConstantRelaxation>(coupling.relaxation);
}

CouplingLimits limits(const Coupling& coupling) {
  return {.tolerance = coupling.tolerance,
          .max_passes = coupling.max_passes,
          .fixed_passes = coupling.scheme == "staggered" ? (coupling.accelerator == "probe" ? 2 : 1) : 0};
}

/// Bodies that the fluid cannot move have nothing to agree about: one pass without a term.
Coupling one_way() { return {.scheme = "staggered", .interface_term = "none"}; }

std::unique_ptr<fluid::Fluid<2>> build_fluid(const Scene& scene) {
  return std::make_unique<fluid::Fluid<2>>(fluid_spec(scene), fluid_terms(scene));
}

std::unique_ptr<rigid::Bodies<2>> build_bodies(const Scene& scene) {
  std::vector<rigid::BodySpec<2>> specs;
  for (const auto& body : scene.bodies) specs.push_back(body_spec(body));
  return std::make_unique<rigid::Bodies<2>>(std::move(specs), body_forces(scene), joint_specs(scene),
                                            contact_spec(scene));
}

/// `Stepper` keeps its trial states.
template <class Stepper>
std::function<std::vector<rigid::Twist<2>>()> trial_velocities_of(const Stepper* stepper) {
  return [stepper] {
    std::vector<rigid::Twist<2>> velocities;
    for (const auto& state : stepper->trial()) velocities.push_back(state.velocity);
    return velocities;
  };
}

World<2> fluid_world(const Scene& scene) {
  World<2> world;
  auto stepper = std::make_unique<coupling::FluidOnly<2>>(build_fluid(scene));
  world.fluid = &stepper->fluid();
  world.stepper = std::move(stepper);
  return world;
}

World<2> bodies_world(const Scene& scene) {
  World<2> world;
  auto stepper = std::make_unique<coupling::BodiesOnly<2>>(build_bodies(scene), scene.time.dt_max);
  world.bodies = &stepper->bodies();
  world.trial_velocities = trial_velocities_of(stepper.get());
  world.stepper = std::move(stepper);
  return world;
}

std::unique_ptr<coupling::Coupled<2>> coupled_stepper(const Scene& scene) {
  const Coupling coupling = scene.coupling.value_or(one_way());
  if (coupling.interface_term == "rigid")
    return std::make_unique<coupling::Simultaneous<2>>(build_fluid(scene), build_bodies(scene), coupling.max_passes);
  return std::make_unique<coupling::Partitioned<2>>(build_fluid(scene), build_bodies(scene), interface_term(coupling),
                                                    accelerator(coupling), limits(coupling));
}

World<2> coupled_world(const Scene& scene) {
  World<2> world;
  auto stepper = coupled_stepper(scene);
  world.fluid = &stepper->fluid();
  world.bodies = &stepper->bodies();
  world.trial_velocities = trial_velocities_of(stepper.get());
  world.stepper = std::move(stepper);
  return world;
}

}  // namespace

World<2> build_world(const Scene& scene) {
  if (!scene.fluid) return bodies_world(scene);
  return scene.bodies.empty() ? fluid_world(scene) : coupled_world(scene);
}

}  // namespace splashdown::apps
