// The balance of energy of a flow and the bodies in it.
#include <gtest/gtest.h>

#include "bodies_in_flow.hpp"

namespace splashdown::ale::energy_test {
namespace {

/// What the ledger cannot explain but by viscosity, since the start.
double unexplained(const Ledger& ledger) {
  return ledger.kinetic_energy + ledger.potential_energy + ledger.work_on_walls - ledger.work_of_effects;
}

/// 2 mu int eps(u) : eps(u): equations without inertia and pressure, tested with u [W/m].
double dissipation(const AleFlow& flow, const Nodes& u) {
  FlowEquations viscous(flow.mesh(), 0, flow.spec().viscosity, {});
  Unknowns at = Unknowns::Zero(viscous.size());
  at.head(u.size()) = u.reshaped();
  Eigen::VectorXd forces;
  viscous.residual({.x = flow.places(),
                    .x_after = flow.places(),
                    .before = u,
                    .mesh_velocity = Nodes::Zero(2, u.cols()),
                    .theta = 1},
                   at, forces);
  return forces.head(u.size()).dot(u.reshaped());
}

// On a mesh that stands the midpoint rule balances to roundoff but for rho int u^2/2 div u: elements have a divergence.
TEST(AleEnergy, balances_between_sides_that_let_through) {
  AleFlowSpec spec{.density = 2, .viscosity = 0.05, .min = {-1, -0.5}, .max = {2, 0.5}};
  spec.sides = {BoundaryKind::inflow, BoundaryKind::outflow, BoundaryKind::no_slip, BoundaryKind::slip};
  spec.inflow = [](const Vec<2>& x, double t) -> Vec<2> { return {t * (0.5 + x.y()) * (1.5 - x.y()), 0}; };
  spec.far = 0.1;
  spec.scheme.damped_steps = 0;
  spec.newton.tolerance = 1e-11;
  spec.walls = {{.name = "body", .surface = scenes::circle(0.2), .pose = scenes::at(0, 0), .size = 0.05}};
  AleFlow flow(spec);
  const FlowEquations equations(flow.mesh(), 1, 1, {});
  double before = 0, gone = 0, bound = 0;
  for (int k = 0; k < 10; ++k) {
    const Nodes v = flow.velocity();
    const double kick = 0.5 * (before + 0.1);
    scenes::step(flow, 0.1, before);
    const Nodes u = 0.5 * (v + flow.velocity());
    gone += kick * dissipation(flow, u);
    bound += kick * 0.5 * spec.density * u.colwise().squaredNorm().maxCoeff() *
             std::sqrt(flow.ledger().volume * equations.divergence(flow.places(), u));
  }
  const double work = flow.ledger().work_of_effects;
  EXPECT_GT(gone, 0.01 * work);
  EXPECT_LT(bound, 0.05 * work);
  EXPECT_LT(std::abs(unexplained(flow.ledger()) + gone), bound);
}

/// What appears from nowhere while a body rises or sinks, over what its weight has given; dt: of a step [s].
double gain_of_motion(double density, double dt) {
  auto made = scenes::coupled({.outline = scenes::box(0.8, 0.4),
                               .area = 0.32,
                               .polar = 0.32 * 0.8 / 12,
                               .density = density,
                               .angle = 0.4,
                               .viscosity = 1e-3});
  double most = 0, lost = 0, from = unexplained(made.fluid->ledger());
  for (double t = 0; t < 0.6; t += dt) {
    made.step(dt);
    const double now = unexplained(made.fluid->ledger());
    most = std::max(most, now - from - lost);
    lost = std::min(lost, now - from);
  }
  return most / std::abs(made.fluid->ledger().work_on_walls);
}

// The mesh moves: the rule's order is left of its errors, and what viscosity takes hides a part of them.
TEST(AleEnergy, of_bodies_that_rise_and_sink_comes_from_gravity) {
  for (const double density : {0.01, 3.}) {
    const double coarse = gain_of_motion(density, 0.05), fine = gain_of_motion(density, 0.025);
    EXPECT_LT(coarse, 0.02) << density;
    EXPECT_LT(fine, std::max(0.3 * coarse, 1e-4)) << density;
  }
}

}  // namespace
}  // namespace splashdown::ale::energy_test
