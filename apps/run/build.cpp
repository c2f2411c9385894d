#include "apps/run/build.hpp"

#include <algorithm>

#include "coupling/accelerators/quasi_newton.hpp"
#include "coupling/schemes/steppers.hpp"

namespace splashdown::apps {
namespace {

using coupling::CouplingLimits;

template <int d>
std::unique_ptr<coupling::InterfaceTerm<d>> interface_term(const Coupling& coupling) {
  if (coupling.interface_term == "laplacian") return std::make_unique<coupling::LaplacianTerm<d>>();
  if (coupling.interface_term == "robin") return std::make_unique<coupling::RobinTerm<d>>();
  return std::make_unique<coupling::NoTerm<d>>();
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

template <int d>
std::unique_ptr<fluid::Fluid<d>> build_fluid(const Scene& scene) {
  return std::make_unique<fluid::Fluid<d>>(fluid_spec<d>(scene), fluid_terms<d>(scene));
}

template <int d>
std::unique_ptr<rigid::Bodies<d>> build_bodies(const Scene& scene) {
  std::vector<rigid::BodySpec<d>> specs;
  for (const auto& body : scene.bodies) specs.push_back(body_spec<d>(body));
  return std::make_unique<rigid::Bodies<d>>(std::move(specs), body_forces<d>(scene), joint_specs(scene),
                                            contact_spec<d>(scene));
}

/// `Stepper` keeps its trial states.
template <int d, class Stepper>
std::function<std::vector<rigid::Twist<d>>()> trial_velocities_of(const Stepper* stepper) {
  return [stepper] {
    std::vector<rigid::Twist<d>> velocities;
    for (const auto& state : stepper->trial()) velocities.push_back(state.velocity);
    return velocities;
  };
}

template <int d>
World<d> fluid_world(const Scene& scene) {
  World<d> world;
  auto stepper = std::make_unique<coupling::FluidOnly<d>>(build_fluid<d>(scene));
  world.fluid = &stepper->fluid();
  world.stepper = std::move(stepper);
  return world;
}

template <int d>
World<d> bodies_world(const Scene& scene) {
  World<d> world;
  auto stepper = std::make_unique<coupling::BodiesOnly<d>>(build_bodies<d>(scene), scene.time.dt_max);
  world.bodies = &stepper->bodies();
  world.trial_velocities = trial_velocities_of<d>(stepper.get());
  world.stepper = std::move(stepper);
  return world;
}

template <int d>
std::unique_ptr<coupling::Coupled<d>> coupled_stepper(const Scene& scene) {
  const Coupling coupling = scene.coupling.value_or(one_way());
  if (coupling.interface_term == "rigid")
    return std::make_unique<coupling::Simultaneous<d>>(build_fluid<d>(scene), build_bodies<d>(scene),
                                                       coupling.max_passes);
  return std::make_unique<coupling::Partitioned<d>>(build_fluid<d>(scene), build_bodies<d>(scene),
                                                    interface_term<d>(coupling), accelerator(coupling),
                                                    limits(coupling));
}

template <int d>
World<d> coupled_world(const Scene& scene) {
  World<d> world;
  auto stepper = coupled_stepper<d>(scene);
  world.fluid = &stepper->fluid();
  world.bodies = &stepper->bodies();
  world.trial_velocities = trial_velocities_of<d>(stepper.get());
  world.stepper = std::move(stepper);
  return world;
}

}  // namespace

template <int d>
World<d> build_world(const Scene& scene) {
  if (!scene.fluid) return bodies_world<d>(scene);
  return scene.bodies.empty() ? fluid_world<d>(scene) : coupled_world<d>(scene);
}

template World<2> build_world<2>(const Scene&);
template World<3> build_world<3>(const Scene&);

}  // namespace splashdown::apps
