// Drops and jets that meet in free flight, a few members of a class of random ones: nothing but themselves acts on
// them.
#include <gtest/gtest.h>

#include "tests/stability/ensemble/random.hpp"
#include "tests/unit/coupling/scenes.hpp"

namespace splashdown {
namespace {

using Vec = Eigen::Vector2d;
using coupling::scenes::water;

struct Books {
  Vec momentum = Vec::Zero();
  double amount = 0, energy = 0, volume = 0;
};

// Of all nodes, drops included, at the half step that the velocities belong to.
Books books_of(const fluid::Fluid<2>& f) {
  Books b;
  for (std::size_t i = 0; i < f.nodes().size(); ++i) {
    const double mass = water * f.nodes().volume[i];
    const Vec& v = f.nodes().v[i];
    b.momentum += mass * v;
    b.amount += mass * v.norm();
    b.energy += 0.5 * mass * v.squaredNorm();
    b.volume += f.nodes().volume[i];
  }
  return b;
}

class Meeting : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Meeting, of_two_drops_keeps_momentum_and_makes_no_energy) {
  ensemble::Random random("meeting", GetParam());
  const double h = random.log_uniform(1e-3, 0.1), V = random.log_uniform(1, 100);
  const double elements = random.log_uniform(3, 500), radius = std::sqrt(elements * 0.433 * h * h / std::numbers::pi);
  const double offset = random.uniform(0, 1.5) * radius;
  fluid::FluidSpec<2> spec;
  spec.density = water;
  spec.size = {.surface = h, .far = 2 * h, .growth = 0.2};
  spec.step.dt_max = h / V;
  for (const double side : {-1.0, 1.0}) {
    const Vec centre(0.5 * side * offset, side * (radius + 0.25 * h));
    spec.liquids.push_back(
        {fluid::scenes::ellipse(radius, radius, 64, centre), [=](const Vec&) { return Vec(0, -side * V); }});
  }
  coupling::scenes::Watched<2> stepper(std::make_unique<fluid::Fluid<2>>(spec, fluid::scenes::no_effects()));
  double dt = 0.01 * h / V;
  std::optional<Books> first;
  const double end = 4 * radius / V;
  while (stepper.time() < end) {
    dt = std::min(stepper.stable_dt(), 1.5 * dt);
    ASSERT_TRUE(coupling::scenes::attempt_halving(stepper, dt, 20).ok()) << stepper.time();
    stepper.commit();
    const Books now = books_of(stepper.fluid());
    if (!first) first = now;
    // Roundoff of a sum over a thousand steps of a thousand nodes is 1e-13 of the amounts.
    ASSERT_LE((now.momentum - first->momentum).norm(), 1e-10 * first->amount) << "at " << stepper.time() / end;
    ASSERT_LE(now.energy, first->energy * (1 + 1e-3)) << "at " << stepper.time() / end;
    ASSERT_LE(std::abs(now.volume - first->volume), 5e-3 * first->volume) << "at " << stepper.time() / end;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Meeting, testing::Range<std::uint64_t>(1, 9));

// A drop on a plate turns into sheets that are thinned to nothing: what they lose of their volume comes back, and their
// fronts, which carry no pressure, bring no energy.
TEST(Drop, that_meets_a_plate_keeps_its_volume_and_makes_no_energy) {
  const double radius = 0.1, h = radius / 6, V = 20;
  fluid::FluidSpec<2> spec;
  spec.density = water;
  spec.size = {.surface = h, .far = 2 * h, .growth = 0.2};
  spec.step.dt_max = h / V;
  const auto tank = fluid::scenes::rectangle({-8 * radius, 0}, {8 * radius, 8 * radius});
  spec.walls.push_back(fluid::scenes::wall("tank", fluid::scenes::turned_inside_out(tank), 2 * h));
  spec.liquids.push_back(
      {fluid::scenes::ellipse(radius, radius, 64, Vec(0, radius + 0.5 * h)), [=](const Vec&) { return Vec(0, -V); }});
  coupling::scenes::Watched<2> stepper(std::make_unique<fluid::Fluid<2>>(spec, fluid::scenes::no_effects()));
  double dt = 0.01 * h / V;
  const double initial = stepper.fluid().ledger().volume, energy = 0.5 * water * initial * V * V;
  const double end = 4 * radius / V;
  while (stepper.time() < end) {
    dt = std::min(stepper.stable_dt(), 1.5 * dt);
    ASSERT_TRUE(coupling::scenes::attempt_halving(stepper, dt, 20).ok()) << stepper.time();
    stepper.commit();
    const auto& ledger = stepper.fluid().ledger();
    // Bounds as those of the meeting drops.
    ASSERT_LE(ledger.kinetic_energy, energy * (1 + 1e-3)) << "at " << stepper.time() / end;
    ASSERT_LE(std::abs(ledger.volume + ledger.spray - initial), 5e-3 * initial) << "at " << stepper.time() / end;
  }
  EXPECT_GT(std::abs(stepper.fluid().ledger().returned), 5e-3 * initial) << "nothing was lost: this tests nothing";
}

// Half a dozen elements at many times the speed of the water they fall into: what joins them becomes theirs with its own
// velocity, not with the drop's.
TEST(Drop, that_falls_into_a_pool_lends_it_no_energy) {
  const double radius = 0.02, h = 0.02, V = 20;
  fluid::FluidSpec<2> spec;
  spec.density = water;
  spec.size = {.surface = h, .far = 2 * h, .growth = 0.2};
  spec.step.dt_max = h / V;
  const auto tank = fluid::scenes::rectangle({-0.3, -0.2}, {0.3, 0.4});
  spec.walls.push_back(fluid::scenes::wall("tank", fluid::scenes::turned_inside_out(tank), 2 * h));
  spec.liquids.push_back({fluid::scenes::rectangle({-0.3, -0.2}, {0.3, 0}), {}});
  spec.liquids.push_back({fluid::scenes::ellipse(radius, radius, 32, Vec(0, radius + 0.5 * h)),
                          [=](const Vec&) { return Vec(0.5 * V, -V); }});
  coupling::scenes::Watched<2> stepper(std::make_unique<fluid::Fluid<2>>(spec, fluid::scenes::no_effects()));
  double dt = 0.01 * h / V;
  std::optional<double> energy;
  const double end = 8 * radius / V;
  while (stepper.time() < end) {
    dt = std::min(stepper.stable_dt(), 1.5 * dt);
    ASSERT_TRUE(coupling::scenes::attempt_halving(stepper, dt, 20).ok()) << stepper.time();
    stepper.commit();
    const double now = stepper.fluid().ledger().kinetic_energy;
    if (!energy) energy = now;
    ASSERT_LE(now, *energy * (1 + 1e-3)) << "at " << stepper.time() / end;
  }
  EXPECT_LT(stepper.fluid().ledger().kinetic_energy, 0.9 * *energy) << "it did not get there";
}

}  // namespace
}  // namespace splashdown
