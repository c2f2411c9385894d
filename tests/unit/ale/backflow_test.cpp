// Flow that comes back through an open side brings no energy along (Braack & Mucha 2014).
#include <gtest/gtest.h>

#include <algorithm>

#include "flows.hpp"

namespace splashdown::ale::backflow_test {
namespace {

/// Of a stream function that falls off as a Gaussian from a centre; `fastest`: its greatest speed.
Vec<2> vortex(const Vec<2>& x, const Vec<2>& centre, double radius, double fastest) {
  const Vec<2> r = (x - centre) / radius;
  return fastest * std::exp(0.5 - 0.5 * r.squaredNorm()) * Vec<2>(-r.y(), r.x());
}

AleFlowSpec open_box(double viscosity) {
  AleFlowSpec spec{.density = 2, .viscosity = viscosity, .min = {0, -1}, .max = {2, 1}};
  spec.sides = {BoundaryKind::no_slip, BoundaryKind::outflow, BoundaryKind::no_slip, BoundaryKind::no_slip};
  spec.far = 0.2;
  return spec;
}

// Half of it lies outside: as much comes in as goes out. Walls stand, so that the energy can but fall.
TEST(AleFlow, loses_energy_where_a_vortex_lies_across_an_open_side) {
  for (const double viscosity : {2e-2, 2e-4}) {
    auto spec = open_box(viscosity);
    spec.start = [](const Vec<2>& x, double) { return vortex(x, {1.9, 0}, 0.2, 1); };
    AleFlow flow(spec);
    double before = 0, energy = flow.ledger().kinetic_energy, work = 0;
    const double first = energy;
    for (int k = 0; k < 80; ++k) {
      scenes::step(flow, 0.05, before);
      const auto& ledger = flow.ledger();
      EXPECT_LT(ledger.kinetic_energy, energy + 1e-3 * first) << viscosity << " " << k;
      EXPECT_LT(ledger.work_of_effects, work + 1e-3 * first) << viscosity << " " << k;
      energy = ledger.kinetic_energy;
      work = ledger.work_of_effects;
    }
    EXPECT_LT(energy, 0.5 * first) << viscosity;
  }
}

// A vortex three times as fast as the stream that carries it out.
TEST(AleFlow, lets_a_vortex_out) {
  const Vec<2> stream(1, 0);
  auto spec = open_box(1e-3);
  spec.sides = {BoundaryKind::inflow, BoundaryKind::outflow, BoundaryKind::slip, BoundaryKind::slip};
  spec.inflow = [&](const Vec<2>&, double) { return stream; };
  spec.start = [&](const Vec<2>& x, double) { return Vec<2>(stream + vortex(x, {1.2, 0}, 0.15, 3)); };
  spec.far = 0.15;
  AleFlow flow(spec);
  const auto disturbance = [&] {
    const double rms =
        scenes::error(flow.mesh(), flow.places(), flow.velocity(), [&](const Vec<2>&) { return stream; });
    return rms * rms;
  };
  const double first = disturbance();
  double before = 0, most = 0;
  while (flow.time() < 4) {
    scenes::step(flow, 0.04, before);
    most = std::max(most, disturbance());
  }
  EXPECT_LT(most, 1.2 * first);
  EXPECT_LT(disturbance(), 0.02 * first);
}

}  // namespace
}  // namespace splashdown::ale::backflow_test
